#include "join_touching_pieces.h"

#include <algorithm>
#include <array>

#include "../mesh/edge_table.h"
#include "pieces.h"

namespace mspskel::detail {
namespace {

struct Contact {
  Index piece, other;
  double length;                   // of the edge; 0: in a point
  std::array<Index, 2> halfedges;  // one of each piece, from the smaller end of the edge, or from the point

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

void add_contacts_in_edges(const std::vector<Vector3>& points, const FaceSet& faces,
                           const std::vector<Index>& twin, const std::vector<Index>& piece_of,
                           std::vector<Contact>& contacts) {
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
}

// A half-edge by its ends.
struct Ends {
  Index from, to, halfedge;
  bool operator<(const Ends& o) const {
    return from != o.from ? from < o.from : to != o.to ? to < o.to : halfedge < o.halfedge;
  }
};

// The half-edges along the edges of the cancelled triangles, whose faces stand across the same edge.
std::vector<Ends> beside_cancelled(const FaceSet& cancelled, const FaceSet& faces,
                                   const std::vector<Index>& twin, std::size_t point_count) {
  std::vector<char> is_corner(point_count, 0);
  for (const Index v : cancelled.corners) is_corner[v] = 1;
  std::vector<Ends> beside;
  for (Index h = 0; h < static_cast<Index>(twin.size()); ++h) {
    const Index from = faces.origin(h), to = faces.target(h), g = twin[h];
    if (g != kNone && is_corner[from] && is_corner[to] && faces.origin(g) == to && faces.target(g) == from)
      beside.push_back({from, to, h});
  }
  std::sort(beside.begin(), beside.end());
  return beside;
}

void add_contacts_of_cancelled(const FaceSet& cancelled, const FaceSet& faces, const std::vector<Index>& twin,
                               std::size_t point_count, const std::vector<Index>& piece_of,
                               std::vector<Contact>& contacts) {
  const std::vector<Ends> beside = beside_cancelled(cancelled, faces, twin, point_count);
  const auto first_along = [&](Index from, Index to) {
    return std::lower_bound(beside.begin(), beside.end(), Ends{from, to, 0});
  };
  for (Index c = 0; c < static_cast<Index>(cancelled.corners.size()); ++c) {
    const Index v = cancelled.corners[c], a = cancelled.corners[FaceSet::next(c)],
                b = cancelled.corners[FaceSet::prev(c)];
    for (auto p = first_along(v, a); p != beside.end() && p->from == v && p->to == a; ++p)
      for (auto q = first_along(v, b); q != beside.end() && q->from == v && q->to == b; ++q)
        if (piece_of[p->halfedge / 3] != piece_of[q->halfedge / 3])
          add_both(piece_of[p->halfedge / 3], piece_of[q->halfedge / 3], 0, p->halfedge, q->halfedge,
                   contacts);
  }
}

void bridge_edge(Index h, Index g, std::vector<Index>& twin) {
  std::swap(twin[h], twin[g]);
  twin[twin[h]] = h;
  twin[twin[g]] = g;
}

// Puts two opposite triangles between two half-edges from one point.
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

Index join_touching_pieces(const std::vector<Vector3>& points, const FaceSet& cancelled, Index wall_count,
                           double share, FaceSet& faces, std::vector<Index>& twin) {
  const std::vector<Index> piece_of = pieces_of_faces(faces, twin);
  std::vector<Contact> contacts;
  add_contacts_in_edges(points, faces, twin, piece_of, contacts);
  add_contacts_of_cancelled(cancelled, faces, twin, points.size(), piece_of, contacts);
  if (contacts.empty()) return 0;
  std::sort(contacts.begin(), contacts.end());
  const std::vector<Piece> pieces = measure_pieces(points, faces, wall_count, piece_of);
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
    joined[contact.other] = 1;
    const auto [h, g] = contact.halfedges;
    if (contact.length > 0)
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
