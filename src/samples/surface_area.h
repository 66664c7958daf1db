// Area of a triangle soup.
#pragma once

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

inline double surface_area(const PolygonSoup& soup) {
  double sum = 0;
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const Vector3& a = soup.points[soup.corners[c]];
    sum += (soup.points[soup.corners[c + 1]] - a).cross(soup.points[soup.corners[c + 2]] - a).norm() / 2;
  }
  return sum;
}

}  // namespace mspskel::detail
