// What a growing part of a surface is at a level: depth, area and mouth, with the triangles cut at the level.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Its mouth is the level's contour round it.
struct PartLevel {
  double depth = 0, area = 0, mouth = 0;
  double span = 0;  // of the mouth (PartShape); 0 where it was not asked for

  double slenderness() const { return 2 * kPi * depth * depth / area; }
  // Depth over the radius of a disc with such a rim: 0.82 for the corner of a cube, 1 for a right-angled
  // cone.
  double depth_over_mouth() const { return 2 * kPi * depth / mouth; }
  // Area over that of the disc: 1 for what is flat, 2 for a half ball, less than 1 for the corner of a cube
  // and at most pi / 2 for that of a thin plate.
  double bulge() const { return 4 * kPi * area / (mouth * mouth); }
  // The shorter side of a rectangle as long round and as large as the mouth; of a square where that is
  // rounder than a square.
  double mouth_thickness() const {
    return 0.25 * (mouth - std::sqrt(std::max(0.0, mouth * mouth - 16 * span)));
  }
};

// Whether few triangles tell a twig: it is as deep as two radii of its mouth. The bumps of a rough surface
// are not.
inline bool is_twig(const PartLevel& level) { return level.depth_over_mouth() >= 2; }

// The area beyond a level and the length of its contour, in one triangle or in several: no more than
// quadratic and linear in the level as long as it passes no corner, so those of a part add up as it grows.
struct LevelSum {
  std::array<double, 3> area{};  // area[0] + area[1] · level + area[2] · level²
  std::array<double, 2> mouth{};

  PartLevel at(double level, double top) const {
    return {top - level, area[0] + level * (area[1] + level * area[2]), mouth[0] + level * mouth[1]};
  }
  LevelSum& add(const LevelSum& o, double factor = 1) {
    for (std::size_t k = 0; k < area.size(); ++k) area[k] += factor * o.area[k];
    for (std::size_t k = 0; k < mouth.size(); ++k) mouth[k] += factor * o.mouth[k];
    return *this;
  }
};

// Of a triangle with that area and that base, as far as it lies between the levels of its tip and its base.
inline LevelSum tapered_sum(double area, double length, double tip, double base) {
  const double fall = base - tip, whole = area / (fall * fall), rim = length / fall;
  return {{whole * tip * tip, -2 * whole * tip, whole}, {-rim * tip, rim}};
}

// What a triangle's sum changes by once its corner v lies beyond the level, after those that are farther.
// Where two corners are as far, it stays until both of them are beyond.
inline LevelSum change_in_triangle(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                   std::array<Index, 3> corner, Index v) {
  const auto farther_first = [&](Index& a, Index& b) {
    if (distance[b] > distance[a] || (distance[b] == distance[a] && b < a)) std::swap(a, b);
  };
  farther_first(corner[0], corner[1]);
  farther_first(corner[1], corner[2]);
  farther_first(corner[0], corner[1]);
  constexpr double kLeastFall = 1e-6;  // nearly level triangles would leave rounding errors behind
  const double high = distance[corner[0]], middle = distance[corner[1]], low = distance[corner[2]];
  const Vector3& a = surface.position[corner[0]];
  const Vector3 to_middle = surface.position[corner[1]] - a, to_low = surface.position[corner[2]] - a;
  const double area = 0.5 * to_middle.cross(to_low).norm();
  // The contour through the middle corner, and the parts of the area on both sides of it.
  const double share = high - low > kLeastFall ? (high - middle) / (high - low) : 0.0;
  const double length = (to_middle - share * to_low).norm();
  const bool falls_to_middle = high - middle > kLeastFall, falls_to_low = middle - low > kLeastFall;
  LevelSum one, two;  // with so many corners beyond
  if (falls_to_middle && (v != corner[2] || !falls_to_low))
    one = two = tapered_sum(share * area, length, high, middle);
  if (v == corner[0]) return one;
  if (falls_to_low) {
    two = LevelSum{}.add(tapered_sum((1 - share) * area, length, low, middle), -1);
    for (double& m : two.mouth) m = -m;
    two.area[0] += area;
  }
  if (v == corner[1]) return two.add(one, -1);
  return LevelSum{{area, 0, 0}, {}}.add(two, -1);
}

// What the sum of a part changes by once a vertex of it lies beyond the level.
inline LevelSum change_at(const SurfaceSnapshot& surface, const std::vector<double>& distance, Index v) {
  LevelSum change;
  const Index first = surface.vertex_halfedge[v];
  Index h = first;
  do {
    change.add(change_in_triangle(surface, distance, {v, surface.target(h), surface.apex(h)}, v));
    h = surface.next_outgoing(h);
  } while (h != first);
  return change;
}

}  // namespace detail
}  // namespace mspskel
