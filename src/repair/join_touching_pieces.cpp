#include "join_touching_pieces.h"

#include <algorithm>
#include <array>

#include "../mesh/edge_table.h"
#include "pieces.h"

namespace mspskel::detail {
namespace {

struct Contact {
  Index piece, other;
  double length;  // of the edge; negative where the pieces touch in a point: how far the half-edges' ends are apart
  std::array<Index, 2> halfedges;  // one of each piece, both from the smaller end of the edge or from the point

  bool in_edge() const { return length > 0; }

  // Of two pieces, the longest first.
  bool operator<(const Contact& o) const {
    return piece != o.piece     ? piece < o.piece
           : other != o.other   ? other < o.other
           : length != o.length ? length > o.length
                                : halfedges < o.halfedges;
  }
};

// Each contact twice, as either piece sees it.
void add_both(Index p, Index q, double length, Index of_p, Index of_q, std::vector<Contact>& contacts) {
  contacts.push_back({p, q, length, {of_p, of_q}});
  contacts.push_back({q, p, length, {of_q, of_p}});
}

std::vector<Contact> contacts_in_edges(const std::vector<Vector3>& points, const FaceSet& faces,
                                 const std::vector<Index>& twin, const std::vector<Index>& piece_of) {
  std::vector<Contact> contacts;
  EdgeTable(static_cast<Index>(points.size()), faces.corners)
      .each_edge([&](Index a, Index b, const HalfedgeEnd* first, const HalfedgeEnd* last) {
        if (last - first != 4) return;
        std::array<Index, 2> forward{kNone, kNone};
        int count = 0;
        for (const HalfedgeEnd* e = first; e != last; ++e)
          if (faces.origin(e->halfedge) == a && twin[e->halfedge] != kNone && count < 2)
            forward[count++] = e->halfedge;
        if (count != 2) return;
        const auto matched_here = [&](Index h) {
          return std::any_of(first, last, [&](const HalfedgeEnd& e) { return e.halfedge == twin[h]; });
        };
        if (!matched_here(forward[0]) || !matched_here(forward[1])) return;
        const Index p = piece_of[forward[0] / 3], q = piece_of[forward[1] / 3];
        if (p == q) return;
        add_both(p, q, (points[a] - points[b]).norm(), forward[0], forward[1], contacts);
      });
  return contacts;
}

// A half-edge by where it begins.
struct Beginning {
  Index point, piece, halfedge;
  bool operator<(const Beginning& o) const {
    return point != o.point   ? point < o.point
           : piece != o.piece ? piece < o.piece
                              : halfedge < o.halfedge;
  }
};

class PointContacts {
 public:
  PointContacts(const std::vector<Vector3>& points, const FaceSet& faces, const std::vector<Index>& twin,
                const std::vector<Index>& piece_of)
      : points_(points), faces_(faces) {
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
      if (twin[h] != kNone) all_.push_back({faces.origin(h), piece_of[h / 3], h});
    std::sort(all_.begin(), all_.end());
  }

  // Of the largest piece at each point with every other one there.
  template <class Extent>
  void add(Extent extent, std::vector<Contact>& contacts) const {
    for (std::size_t i = 0, j; i < all_.size(); i = j) {
      for (j = i + 1; j < all_.size() && all_[j].point == all_[i].point;) ++j;
      if (all_[i].piece == all_[j - 1].piece) continue;
      std::vector<std::size_t> begin{i};  // of each piece's half-edges
      for (std::size_t k = i + 1; k < j; ++k)
        if (all_[k].piece != all_[k - 1].piece) begin.push_back(k);
      begin.push_back(j);
      std::size_t largest = 0;
      for (std::size_t p = 1; p + 1 < begin.size(); ++p)
        if (extent(all_[begin[p]].piece) > extent(all_[begin[largest]].piece)) largest = p;
      for (std::size_t p = 0; p + 1 < begin.size(); ++p)
        if (p != largest)
          add_nearest(begin[largest], begin[largest + 1], begin[p], begin[p + 1], contacts);
    }
  }

 private:
  // The half-edges of two pieces whose ends are nearest to each other, of not too many.
  void add_nearest(std::size_t p, std::size_t p_end, std::size_t q, std::size_t q_end,
                   std::vector<Contact>& contacts) const {
    constexpr std::size_t kMost = 32;
    Index of_p = kNone, of_q = kNone;
    double least = 0;
    for (std::size_t i = p; i < p_end; i += 1 + (p_end - p) / kMost)
      for (std::size_t j = q; j < q_end; j += 1 + (q_end - q) / kMost) {
        const double distance =
            (points_[faces_.target(all_[i].halfedge)] - points_[faces_.target(all_[j].halfedge)]).norm();
        if (!(distance > 0) || (of_p != kNone && distance >= least)) continue;
        least = distance;
        of_p = all_[i].halfedge;
        of_q = all_[j].halfedge;
      }
    if (of_p != kNone) add_both(all_[p].piece, all_[q].piece, -least, of_p, of_q, contacts);
  }

  const std::vector<Vector3>& points_;
  const FaceSet& faces_;
  std::vector<Beginning> all_;
};

void bridge_edge(Index h, Index g, std::vector<Index>& twin) {
  std::swap(twin[h], twin[g]);
  twin[twin[h]] = h;
  twin[twin[g]] = g;
}

void bridge_point(Index h, Index g, FaceSet& faces, std::vector<Index>& twin) {
  const Index v = faces.origin(h), a = faces.target(h), b = faces.target(g);
  const auto front = static_cast<Index>(faces.corners.size()), back = front + 3;
  faces.add(v, a, b, kNone);
  faces.add(v, b, a, kNone);
  twin.resize(faces.corners.size(), kNone);
  const auto pair = [&](Index one, Index other) {
    twin[one] = other;
    twin[other] = one;
  };
  pair(front, twin[h]);
  pair(back + 2, h);
  pair(back, twin[g]);
  pair(front + 2, g);
  pair(front + 1, back + 1);
}

}  // namespace

Index join_touching_pieces(const std::vector<Vector3>& points, FaceSet& faces, Index wall_count, double share,
                           std::vector<Index>& twin) {
  const std::vector<Index> piece_of = pieces_of_faces(faces, twin);
  const std::vector<Piece> pieces = measure_pieces(points, faces, wall_count, piece_of);
  std::vector<Contact> contacts = contacts_in_edges(points, faces, twin, piece_of);
  PointContacts(points, faces, twin, piece_of).add([&](Index piece) { return pieces[piece].extent; }, contacts);
  if (contacts.empty()) return 0;
  std::sort(contacts.begin(), contacts.end());
  std::vector<Index> order;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (i == 0 || contacts[i].piece != contacts[i - 1].piece) order.push_back(contacts[i].piece);
  std::sort(order.begin(), order.end(), [&](Index p, Index q) {
    return pieces[p].extent != pieces[q].extent ? pieces[p].extent > pieces[q].extent : p < q;
  });
  std::vector<char> joined(pieces.size(), 0);
  Index count = 0;
  const auto join = [&](const Contact& contact, double extent, std::vector<Index>& whole) {
    const Piece& other = pieces[contact.other];
    if (joined[contact.other] || !(other.extent < share * extent) || !has_volume(other)) return;
    // A cavity that touches the outer wall stays one.
    if (!contact.in_edge() && (other.volume > 0) != (pieces[contact.piece].volume > 0)) return;
    joined[contact.other] = 1;
    const auto [h, g] = contact.halfedges;
    if (contact.in_edge())
      bridge_edge(h, g, twin);
    else
      bridge_point(h, g, faces, twin);
    whole.push_back(contact.other);
    ++count;
  };
  for (const Index largest : order) {
    if (joined[largest] || !has_volume(pieces[largest])) continue;
    joined[largest] = 1;
    std::vector<Index> whole{largest};
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const auto first = std::lower_bound(contacts.begin(), contacts.end(), whole[i],
                                          [](const Contact& c, Index piece) { return c.piece < piece; });
      for (auto c = first; c != contacts.end() && c->piece == whole[i]; ++c)
        join(*c, pieces[largest].extent, whole);
    }
  }
  return count;
}

}  // namespace mspskel::detail
