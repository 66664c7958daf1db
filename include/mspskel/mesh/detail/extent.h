// How large a set of points is.
#pragma once

#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

// The extent of the points by a double sweep: the vertex farthest from the centroid, then the one farthest
// from that. It turns with the model, unlike a bounding box, and is at least half the largest distance
// between two vertices.
inline double extent(const std::vector<Vector3>& points, const Vector3& centroid) {
  const auto farthest = [&](const Vector3& from) {
    Vector3 result = from;
    double most = -1;
    for (const Vector3& p : points)
      if (const double square = (p - from).squaredNorm(); square > most) most = square, result = p;
    return result;
  };
  const Vector3 end = farthest(centroid);
  return (farthest(end) - end).norm();
}

}  // namespace detail
}  // namespace mspskel
