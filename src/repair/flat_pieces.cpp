#include "flat_pieces.h"

#include <algorithm>

#include "../mesh/edge_table.h"
#include "disjoint_sets.h"

namespace mspskel::detail {
namespace {

// Two pyramids on triangle t, a tip each.
void add_pyramids(const FaceSet& triangles, Index t, std::vector<Vector3>& points, FaceSet& faces,
                  std::vector<Index>& twin) {
  constexpr double kHeight = 0.1;
  const Index* corner = &triangles.corners[3 * t];
  double shortest = (points[corner[0]] - points[corner[2]]).norm();
  for (const int i : {0, 1})
    shortest = std::min(shortest, (points[corner[i]] - points[corner[i + 1]]).norm());
  Vector3 normal = area_vector(points, triangles, t).stableNormalized();
  if (normal.isZero()) normal = (points[corner[1]] - points[corner[0]]).unitOrthogonal();  // a line
  const Vector3 centre = (points[corner[0]] + points[corner[1]] + points[corner[2]]) / 3;
  const auto first = static_cast<Index>(faces.corners.size());
  for (const double side : {1.0, -1.0}) {
    const auto tip = static_cast<Index>(points.size());
    points.push_back(centre + side * kHeight * shortest * normal);
    for (int i = 0; i < 3; ++i) {
      const Index a = corner[i], b = corner[(i + 1) % 3];
      side > 0 ? faces.add(a, b, tip, triangles.polygon[t]) : faces.add(b, a, tip, triangles.polygon[t]);
    }
  }
  twin.resize(faces.corners.size(), kNone);
  const auto pair = [&](Index one, Index other) {
    twin[one] = other;
    twin[other] = one;
  };
  for (int i = 0; i < 3; ++i) {
    const Index front = first + 3 * i, back = front + 9;
    const Index next_front = first + 3 * ((i + 1) % 3), next_back = next_front + 9;
    pair(front, back);
    pair(front + 1, next_front + 2);
    pair(back + 2, next_back + 1);
  }
}

}  // namespace

void bridge_edge(Index h, Index g, std::vector<Index>& twin) {
  std::swap(twin[h], twin[g]);
  twin[twin[h]] = h;
  twin[twin[g]] = g;
}

void add_flat_pieces(const FaceSet& cancelled, std::vector<Vector3>& points, FaceSet& faces,
                     std::vector<Index>& twin) {
  const Index first = faces.count();
  for (Index t = 0; t < cancelled.count(); ++t) add_pyramids(cancelled, t, points, faces, twin);
  // The half-edge along edge h of the triangles that runs from a.
  const auto from = [&](Index h, Index a) {
    const Index front = 3 * (first + 6 * (h / 3) + h % 3);
    return faces.origin(front) == a ? front : front + 9;
  };
  DisjointSets pieces(cancelled.count());
  EdgeTable(static_cast<Index>(points.size()), cancelled.corners)
      .each_edge([&](Index a, Index, const HalfedgeEnd* begin, const HalfedgeEnd* end) {
        for (const HalfedgeEnd* e = begin + 1; e != end; ++e)
          if (pieces.unite(begin->halfedge / 3, e->halfedge / 3))
            bridge_edge(from(begin->halfedge, a), from(e->halfedge, a), twin);
      });
}

}  // namespace mspskel::detail
