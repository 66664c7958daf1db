// How wide a planar region is, from its second moments.
#pragma once

#include <algorithm>
#include <cmath>

namespace mspskel {
namespace detail {

// Sums over triangles that have one corner in common, the origin, each with the sign of its orientation.
// Moments are integrals over the region, so a rough boundary hardly changes them, unlike its perimeter.
class RegionMoments {
 public:
  // The triangle of the origin, a and b.
  void add(double ax, double ay, double bx, double by) {
    const double twice = ax * by - ay * bx, sx = ax + bx, sy = ay + by;
    area_ += twice / 2;
    x_ += twice / 6 * sx;
    y_ += twice / 6 * sy;
    xx_ += twice / 24 * (ax * ax + bx * bx + sx * sx);
    xy_ += twice / 24 * (ax * ay + bx * by + sx * sy);
    yy_ += twice / 24 * (ay * ay + by * by + sy * sy);
  }

  // Half the longer side of a rectangle with the larger principal moment of the region: √3 radii of gyration,
  // √3/2 radii of a disc; 0 for a region without area.
  double half_width() const { return std::sqrt(3 * axes().larger); }

  // Principal moments about the region's own centre, per area, and the way from x to y, in radians, to the
  // axis along which the region is widest. All 0 for a region without area.
  struct Axes {
    double larger = 0, smaller = 0, angle = 0;
  };
  Axes axes() const {
    if (area_ == 0) return {};
    const double x = x_ / area_, y = y_ / area_;
    const double xx = xx_ / area_ - x * x, xy = xy_ / area_ - x * y, yy = yy_ / area_ - y * y;
    const double mean = (xx + yy) / 2, half = std::hypot((xx - yy) / 2, xy);
    return {std::max(0.0, mean + half), std::max(0.0, mean - half), 0.5 * std::atan2(2 * xy, xx - yy)};
  }

 private:
  double area_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
};

}  // namespace detail
}  // namespace mspskel
