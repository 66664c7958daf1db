// What a growing part of a surface is at a level: depth, area and mouth, with the triangles cut at the level.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

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

// What a triangle adds once 0, 1, 2 or 3 of its corners lie beyond the level. Where two corners are as far,
// it stays until both of them are beyond.
class TriangleLevels {
 public:
  TriangleLevels(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                 std::array<Index, 3> corner)
      : corner_(corner) {
    std::sort(corner_.begin(), corner_.end(), [&](Index a, Index b) {
      return distance[a] != distance[b] ? distance[a] > distance[b] : a < b;
    });
    constexpr double kLeastFall = 1e-6;  // nearly level triangles would leave rounding errors behind
    const double high = distance[corner_[0]], middle = distance[corner_[1]], low = distance[corner_[2]];
    const Vector3& a = surface.position[corner_[0]];
    const Vector3 to_middle = surface.position[corner_[1]] - a, to_low = surface.position[corner_[2]] - a;
    const double area = 0.5 * to_middle.cross(to_low).norm();
    // The contour through the middle corner, and the parts of the area on both sides of it.
    const double share = high - low > kLeastFall ? (high - middle) / (high - low) : 0.0;
    const double length = (to_middle - share * to_low).norm();
    if (high - middle > kLeastFall) beyond_[1] = tapered(share * area, length, high, middle);
    beyond_[2] = beyond_[1];
    if (middle - low > kLeastFall) {
      beyond_[2] = LevelSum{}.add(tapered((1 - share) * area, length, low, middle), -1);
      for (double& m : beyond_[2].mouth) m = -m;
      beyond_[2].area[0] += area;
    }
    beyond_[3].area[0] = area;
  }

  // What changes once the corner v lies beyond the level, after those that are farther.
  LevelSum change(Index v) const {
    const auto k = static_cast<std::size_t>(std::find(corner_.begin(), corner_.end(), v) - corner_.begin());
    return LevelSum(beyond_[k + 1]).add(beyond_[k], -1);
  }

 private:
  // Between the level of a tip and that of the base of a triangle.
  static LevelSum tapered(double area, double length, double tip, double base) {
    const double fall = base - tip, whole = area / (fall * fall), rim = length / fall;
    return {{whole * tip * tip, -2 * whole * tip, whole}, {-rim * tip, rim}};
  }

  std::array<Index, 3> corner_;  // the farthest first
  std::array<LevelSum, 4> beyond_;
};

// What the sum of a part changes by once a vertex of it lies beyond the level.
inline LevelSum change_at(const SurfaceSnapshot& surface, const std::vector<double>& distance, Index v) {
  LevelSum change;
  const Index first = surface.vertex_halfedge[v];
  Index h = first;
  do {
    change.add(TriangleLevels(surface, distance, {v, surface.target(h), surface.apex(h)}).change(v));
    h = surface.next_outgoing(h);
  } while (h != first);
  return change;
}

}  // namespace detail
}  // namespace mspskel
