#include "join_touching_pieces.h"

#include <algorithm>
#include <array>

#include "../mesh/edge_table.h"
#include "pieces.h"

namespace mspskel::detail {
namespace {

struct Contact {
  Index piece, other;
  double length;
  std::array<Index, 2> halfedges;  // one of each piece, both from the smaller end of the edge to the larger

  // Of two pieces, the longest first.
  bool operator<(const Contact& o) const {
    return piece != o.piece     ? piece < o.piece
           : other != o.other   ? other < o.other
           : length != o.length ? length > o.length
                                : halfedges < o.halfedges;
  }
};

// Each contact twice, as either piece sees it.
std::vector<Contact> contacts_of(const std::vector<Vector3>& points, const FaceSet& faces,
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
        const double length = (points[a] - points[b]).norm();
        contacts.push_back({p, q, length, forward});
        contacts.push_back({q, p, length, {forward[1], forward[0]}});
      });
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

}  // namespace

Index join_touching_pieces(const std::vector<Vector3>& points, const FaceSet& faces, Index wall_count,
                           double share, std::vector<Index>& twin) {
  const std::vector<Index> piece_of = pieces_of_faces(faces, twin);
  const std::vector<Contact> contacts = contacts_of(points, faces, twin, piece_of);
  if (contacts.empty()) return 0;
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
    std::swap(twin[h], twin[g]);
    twin[twin[h]] = h;
    twin[twin[g]] = g;
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
