#include "join_touching_pieces.h"

#include <algorithm>
#include <array>

#include "../mesh/edge_table.h"
#include "flat_pieces.h"
#include "pieces.h"

namespace mspskel::detail {
namespace {

struct Contact {
  Index piece, other;
  double length;                   // of the edge
  std::array<Index, 2> halfedges;  // one of each piece, the same way along the edge

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

// Of the flat pieces, from face `first_flat` on, with the solids along edges of their triangles.
void add_contacts_of_flats(const std::vector<Ends>& beside, Index first_flat,
                           const std::vector<Vector3>& points, const FaceSet& faces,
                           const std::vector<Index>& piece_of, std::vector<Contact>& contacts) {
  for (Index f = first_flat; f < faces.count(); f += 6)
    for (const Index h : {3 * f, 3 * f + 3, 3 * f + 6}) {
      const Index from = faces.origin(h), to = faces.target(h);
      for (auto p = std::lower_bound(beside.begin(), beside.end(), Ends{from, to, 0});
           p != beside.end() && p->from == from && p->to == to; ++p)
        add_both(piece_of[p->halfedge / 3], piece_of[f], (points[from] - points[to]).norm(), p->halfedge, h,
                 contacts);
    }
}

// Whether the solid ends at half-edge h in an edge where its two faces are at an acute angle, and the face of
// half-edge g, along the same edge, lies beyond it.
bool goes_on(const std::vector<Vector3>& points, const FaceSet& faces, const std::vector<Index>& twin,
             Index h, Index g) {
  const Vector3& base = points[faces.origin(h)];
  const Vector3 along = (points[faces.target(h)] - base).stableNormalized();
  const auto away = [&](Index k) {  // from the edge, in the plane of the half-edge's face
    const Vector3 way = points[faces.corners[FaceSet::prev(k)]] - base;
    return (way - way.dot(along) * along).stableNormalized();
  };
  constexpr double kRight = 1e-9;
  const Vector3 one = away(h), other = away(twin[h]);
  const bool convex = area_vector(points, faces, h / 3).dot(other) < 0;
  return convex && one.dot(other) > kRight && away(g).dot(one + other) < 0;
}

// Leaves out the faces from `first` on of pieces that did not join any.
void drop_left(Index first, const std::vector<char>& joined, const std::vector<Index>& piece_of,
               FaceSet& faces, std::vector<Index>& twin) {
  std::vector<char> keep(faces.count(), 1);
  std::vector<Index> place(faces.count());
  Index kept = 0;
  for (Index f = 0; f < faces.count(); ++f) {
    keep[f] = f < first || joined[piece_of[f]];
    place[f] = keep[f] ? kept++ : kNone;
  }
  std::vector<Index> twins;
  for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
    if (keep[h / 3]) twins.push_back(twin[h] == kNone ? kNone : 3 * place[twin[h] / 3] + twin[h] % 3);
  faces = kept_faces(faces, keep);
  twin = std::move(twins);
}

}  // namespace

JoinedPieces join_touching_pieces(const FaceSet& cancelled, double share, std::vector<Vector3>& points,
                                  FaceSet& faces, std::vector<Index>& twin) {
  const std::vector<Ends> beside = beside_cancelled(cancelled, faces, twin, points.size());
  std::vector<Contact> contacts;
  add_contacts_in_edges(points, faces, twin, pieces_of_faces(faces, twin), contacts);
  const Index first_flat = faces.count();
  if (!beside.empty()) add_flat_pieces(cancelled, points, faces, twin);
  const std::vector<Index> piece_of = pieces_of_faces(faces, twin);
  add_contacts_of_flats(beside, first_flat, points, faces, piece_of, contacts);
  JoinedPieces result;
  if (contacts.empty()) return result;
  std::sort(contacts.begin(), contacts.end());
  const std::vector<Piece> pieces = measure_pieces(points, faces, piece_of);
  const auto is_flat = [&](Index piece) { return piece >= first_flat; };
  const auto contacts_of = [&](Index piece) {
    return std::equal_range(contacts.begin(), contacts.end(), Contact{piece, 0, 0, {}},
                            [](const Contact& a, const Contact& b) { return a.piece < b.piece; });
  };
  std::vector<Index> order;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (i == 0 || contacts[i].piece != contacts[i - 1].piece)
      if (const Index piece = contacts[i].piece; !is_flat(piece) && has_volume(pieces[piece]))
        order.push_back(piece);
  std::sort(order.begin(), order.end(), [&](Index p, Index q) {
    return pieces[p].extent != pieces[q].extent ? pieces[p].extent > pieces[q].extent : p < q;
  });
  std::vector<char> joined(faces.count(), 0);
  const auto may_join = [&](Index piece, double extent) {
    return !joined[piece] && pieces[piece].extent < share * extent &&
           (is_flat(piece) || has_volume(pieces[piece]));
  };
  const auto leads_on = [&](Index flat, double extent) {
    const auto [first, last] = contacts_of(flat);
    return std::any_of(first, last, [&](const Contact& c) { return may_join(c.other, extent); });
  };
  for (const Index largest : order) {
    if (joined[largest]) continue;
    joined[largest] = 1;
    const double extent = pieces[largest].extent;
    std::vector<Index> whole{largest};
    for (std::size_t i = 0; i < whole.size(); ++i) {
      const auto [first, last] = contacts_of(whole[i]);
      for (auto c = first; c != last; ++c) {
        if (!may_join(c->other, extent)) continue;
        const auto [h, g] = c->halfedges;
        if (is_flat(c->other) && !leads_on(c->other, extent) && !goes_on(points, faces, twin, h, g)) continue;
        joined[c->other] = 1;
        bridge_edge(h, g, twin);
        whole.push_back(c->other);
        is_flat(c->other) ? result.flat_triangles += pieces[c->other].faces / 6 : ++result.solid;
      }
    }
  }
  drop_left(first_flat, joined, piece_of, faces, twin);
  return result;
}

}  // namespace mspskel::detail
