// Meshes put into one scene, each as often as the scene says and where it says.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "growth_limit.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

class Assembly {
 public:
  explicit Assembly(GrowthLimit& limit) : limit_(limit) {}

  // Appends the part. A transform that mirrors turns the polygons round, so that they are seen from outside
  // as before. Throws ReadError for what is not finite, too much or too many.
  void add(const PolygonSoup& part, const Eigen::Affine3d& place);

  PolygonSoup take() { return std::move(soup_); }

 private:
  GrowthLimit& limit_;
  PolygonSoup soup_;
};

}  // namespace mspskel::detail
