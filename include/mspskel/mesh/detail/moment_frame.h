// A frame that turns with the surface, and what it is for: telling places apart and numbering them without a
// regard to how the surface lies or is stored.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Rows are orthonormal and right-handed: the directions of the third moment of weighted points and of what
// the fifth moment has beside it. For points that a rotation about the origin maps onto themselves rounding
// decides.
template <class Weight>
Eigen::Matrix3d moment_frame(const std::vector<Vector3>& points, const Weight& weight_of) {
  Vector3 third = Vector3::Zero(), fifth = Vector3::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3& p = points[i];
    const double square = p.squaredNorm(), weight = weight_of(i) * square;
    third += weight * p;
    fifth += weight * square * p;
  }
  const auto unit = [](const Vector3& v, const Vector3& otherwise) {
    const double length = v.norm();
    return length > 0 ? Vector3(v / length) : otherwise;
  };
  const Vector3 x = unit(third, Vector3::UnitX());
  const Vector3 y = unit(fifth - fifth.dot(x) * x, x.unitOrthogonal());
  Eigen::Matrix3d frame;
  frame << x.transpose(), y.transpose(), x.cross(y).transpose();
  return frame;
}

// The first moment is zero in the normalised frame.
inline Eigen::Matrix3d moment_frame(const SurfaceSnapshot& s) {
  return moment_frame(s.position, [&](std::size_t v) { return s.vertex_area[v]; });
}

// Regular and symmetric surfaces have many equal costs, which would be taken in the order of storage or, once
// the surface is turned, of their rounding. A factor per place, far above rounding and far below what
// matters, orders them instead. Mirrored places differ, for the frame is right-handed.
class TieBreaker {
 public:
  explicit TieBreaker(const Eigen::Matrix3d& frame) {
    // Some twenty waves over the model, in directions and lengths without simple ratios.
    waves_ << 17.31, 5.83, 9.47, -6.19, 19.73, 8.11, 4.37, -7.91, 21.13;
    waves_ *= frame;
  }

  // From 1 to 1 + 1.5e-6.
  double factor(const Vector3& p) const {
    const Vector3 t = waves_ * p;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double u =
          std::abs(t[k]) + 0.5;  // cast, for floor is a call where SSE 4 is not taken for granted
      sum += std::abs(u - static_cast<int>(u) - 0.5);
    }
    return 1 + 1e-6 * sum;
  }

 private:
  Eigen::Matrix3d waves_;
};

// The points along a space-filling curve (Morton's) in the frame: what lies close is numbered close.
// Coordinates in the frame must lie in [-2, 2]. O(n log n).
inline std::vector<Index> spatial_order(const std::vector<Vector3>& points, const Eigen::Matrix3d& frame) {
  const auto spread = [](std::uint64_t x) {  // 21 bits, two zeros between neighbours
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
  };
  std::vector<std::pair<std::uint64_t, Index>> keyed;
  keyed.reserve(points.size());
  for (const Vector3& p : points) {
    // Half a cell's shift: the planes through the origin, where symmetric surfaces have points, bound no
    // cells.
    const Vector3 q = ((frame * p).array() + 2) * 0x1p19 + 0.5;
    const auto cell = [&](int k) {
      return spread(static_cast<std::uint64_t>(std::min(std::max(q[k], 0.0), 0x1p21 - 1)));
    };
    keyed.emplace_back(cell(0) << 2 | cell(1) << 1 | cell(2), static_cast<Index>(keyed.size()));
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<Index> order;
  order.reserve(points.size());
  for (const auto& [key, point] : keyed) order.push_back(point);
  return order;
}

}  // namespace detail
}  // namespace mspskel
