#pragma once

#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Triangles that share points, three corners each, and the polygon of the input that each comes from.
struct FaceSet {
  std::vector<Index> corners;
  std::vector<Index> polygon;  // kNone for triangles that were added

  Index count() const { return static_cast<Index>(polygon.size()); }
  void add(Index a, Index b, Index c, Index from) {
    corners.insert(corners.end(), {a, b, c});
    polygon.push_back(from);
  }
  // Half-edges 3f, 3f+1, 3f+2 run round triangle f, half-edge h from corners[h].
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index origin(Index h) const { return corners[h]; }
  Index target(Index h) const { return corners[next(h)]; }
};

// Twice the area, along the normal.
inline Vector3 area_vector(const std::vector<Vector3>& points, const FaceSet& faces, Index f) {
  const Vector3& a = points[faces.corners[3 * f]];
  return (points[faces.corners[3 * f + 1]] - a).cross(points[faces.corners[3 * f + 2]] - a);
}

// The triangles f with keep[f], in their order.
inline FaceSet kept_faces(const FaceSet& faces, const std::vector<char>& keep) {
  FaceSet kept;
  for (Index f = 0; f < faces.count(); ++f)
    if (keep[f])
      kept.add(faces.corners[3 * f], faces.corners[3 * f + 1], faces.corners[3 * f + 2], faces.polygon[f]);
  return kept;
}

}  // namespace mspskel::detail
