// A closed contour in which a plane cuts the surface, as a walk across half-edges.
#pragma once

#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {

// The points x with normal · x = offset. The positive side is normal · x >= offset.
struct Plane {
  Vector3 normal = Vector3::UnitZ();  // unit
  double offset = 0.0;

  double signed_distance(const Vector3& x) const { return normal.dot(x) - offset; }
};

// Crossing i lies on the edge of half-edge h = halfedge[i], which runs from the negative side (its origin) to
// the positive side (its target): point[i] = position[origin] + weight[i] · (position[target] −
// position[origin]). Consecutive crossings, the last and the first too, share a face. Each edge is crossed at
// most once, so label(h) = +1 on these half-edges and −1 on their twins is an integer cocycle of the surface.
struct Contour {
  std::vector<Index> halfedge;
  std::vector<double> weight;
  std::vector<Vector3> point;
  double perimeter = 0.0;
  // Oriented by the surface: positive if the outward normals along the contour point away from the region
  // that it encloses, so that it bounds material; negative round a hole.
  double area = 0.0;
};

}  // namespace mspskel
