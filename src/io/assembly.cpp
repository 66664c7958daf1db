#include "assembly.h"

#include <algorithm>

#include "mesh_parsers.h"
#include "mspskel/base/error.h"

namespace mspskel::detail {

void Assembly::add(const PolygonSoup& part, const Eigen::Affine3d& place) {
  limit_.spend(sizeof(Vector3) * part.points.size() +
               sizeof(Index) * (part.corners.size() + part.begin.size()));
  if (soup_.points.size() + part.points.size() > kMostElements ||
      soup_.corners.size() + part.corners.size() > kMostElements)
    throw ReadError("there are too many vertices or corners");
  const auto first = static_cast<Index>(soup_.points.size());
  for (const Vector3& p : part.points) {
    soup_.points.push_back(place * p);
    if (!soup_.points.back().allFinite())
      throw ReadError("a transform makes a coordinate that is not finite");
  }
  const bool mirrored = place.linear().determinant() < 0;
  for (std::size_t f = 0; f < part.polygon_count(); ++f) {
    for (Index i = part.begin[f]; i < part.begin[f + 1]; ++i)
      soup_.corners.push_back(first + part.corners[static_cast<std::size_t>(i)]);
    if (mirrored)
      std::reverse(soup_.corners.end() - (part.begin[f + 1] - part.begin[f]), soup_.corners.end());
    soup_.begin.push_back(static_cast<Index>(soup_.corners.size()));
  }
}

}  // namespace mspskel::detail
