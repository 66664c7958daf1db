// Where the axis of a solid runs inside it: a principal axis, or in a vessel that of its opening.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "mspskel/base/even_directions.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/detail/solid_moments.h"

namespace mspskel {
namespace detail {

// The longest stretch that a line has in the solid.
inline std::optional<std::array<Vector3, 2>> longest_stretch(const Vector3& point, const Vector3& direction,
                                                             const BoundingVolumeHierarchy& solid) {
  constexpr double kReach = 4.0;  // beyond the model, whose extent is 1
  constexpr double kSkip = 1e-7;  // off the surface just met
  constexpr int kHits = 10000;    // a line that runs in a face may meet it at every skip
  std::optional<std::array<Vector3, 2>> longest;
  double length = 0;
  Vector3 from = point - kReach * direction;
  for (int hits = 0; hits < kHits; ++hits) {
    const auto hit = solid.first_hit(from + kSkip * direction, direction);
    if (!hit) break;
    const Vector3 to = from + (hit->distance + kSkip) * direction;
    if (hit->distance > length && hit->distance < kReach / 2 && solid.inside((from + to) / 2)) {
      length = hit->distance;
      longest = {from, to};
    }
    from = to;
  }
  return longest;
}

// What a line has of the solid there and back from a point inside.
inline std::optional<std::array<Vector3, 2>> stretch_through(const Vector3& point, const Vector3& direction,
                                                             const BoundingVolumeHierarchy& solid) {
  const auto back = solid.first_hit(point, -direction), ahead = solid.first_hit(point, direction);
  if (!back || !ahead) return std::nullopt;
  return std::array<Vector3, 2>{point - back->distance * direction, point + ahead->distance * direction};
}

struct FreeDirections {
  Vector3 sum = Vector3::Zero();
  int count = 0;
};

// Directions in which nothing lies, evenly over the sphere by the golden angle.
inline FreeDirections free_directions(const Vector3& point, const BoundingVolumeHierarchy& solid) {
  constexpr int kRays = 400;
  FreeDirections found;
  for (int k = 0; k < kRays; ++k) {
    const double z = (2 * k + 1.0) / kRays - 1, angle = kPi * (3 - std::sqrt(5.0)) * k;
    const Vector3 way(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    if (solid.first_hit(point, way)) continue;
    found.sum += way;
    ++found.count;
  }
  return found;
}

// Where a point in a hollow sees out: the mean direction to the rim of the opening, a unit vector. None if
// there is no opening, or as much of one on the other side.
inline std::optional<Vector3> opening_direction(const Vector3& point, const BoundingVolumeHierarchy& solid) {
  constexpr double kOneSided = 0.5;  // length of the mean direction; that of a half space
  const auto escapes = [&](const Vector3& way) { return !solid.first_hit(point, way); };
  const FreeDirections free = free_directions(point, solid);
  if (free.count == 0 || !(free.sum.norm() >= kOneSided * free.count)) return std::nullopt;
  // The rays are too few to find its middle by; the rim all round is exact, whichever way the model lies.
  Vector3 middle = free.sum.normalized();
  constexpr int kRounds = 3, kRim = 32, kHalvings = 12;
  for (int round = 0; round < kRounds && escapes(middle); ++round) {
    const Vector3 u = middle.unitOrthogonal(), w = middle.cross(u);
    Vector3 rim = Vector3::Zero();
    for (const Vector2& d : even_directions(kRim)) {
      double inner = 0, outer = kPi;
      const auto at = [&](double angle) -> Vector3 {
        return std::cos(angle) * middle + std::sin(angle) * (d.x() * u + d.y() * w);
      };
      for (int k = 0; k < kHalvings; ++k) {
        const double half = (inner + outer) / 2;
        (escapes(at(half)) ? inner : outer) = half;
      }
      rim += at((inner + outer) / 2);
    }
    if (rim.norm() > 0) middle = rim.normalized();
  }
  return middle;
}

// Whether a point lies in the solid and not just below its surface: the way to the nearest surface is no less
// than a tenth of the way in the opposite direction.
inline bool is_well_inside(const Vector3& x, const BoundingVolumeHierarchy& solid) {
  constexpr double kLeast = 0.1;
  if (!solid.inside(x)) return false;
  const ClosestPoint nearest = solid.closest(x);
  if (!(nearest.distance > 0)) return false;
  const auto opposite = solid.first_hit(x, x - nearest.point);
  return opposite && nearest.distance >= kLeast * opposite->distance;
}

// A cup, a vase: its middle is air that opens to one side, and across the way out stands a wall all round. A
// groove between two sheets is open at its ends as well.
inline bool is_vessel(const SolidMoments& moments, const BoundingVolumeHierarchy& solid) {
  constexpr int kRays = 360;  // the ends of a long groove are narrow to look at
  if (!moments.has_volume()) return false;
  const Vector3 centre = moments.centroid();
  if (is_well_inside(centre, solid)) return false;
  const auto opening = opening_direction(centre, solid);
  if (!opening) return false;
  const Vector3 u = opening->unitOrthogonal(), w = opening->cross(u);
  const std::vector<Vector2>& horizon = even_directions(kRays);
  return std::all_of(horizon.begin(), horizon.end(), [&](const Vector2& d) {
    return solid.first_hit(centre, d.x() * u + d.y() * w).has_value();
  });
}

// Half way through the wall that is nearest to a point in a hollow, or through which the point lies.
inline std::optional<Vector3> middle_of_wall(const Vector3& x, const BoundingVolumeHierarchy& solid) {
  constexpr double kSkip = 1e-7;  // off the surface
  const ClosestPoint nearest = solid.closest(x);
  if (!(nearest.distance > 0)) return std::nullopt;
  const Vector3 into = ((solid.inside(x) ? 1.0 : -1.0) * (x - nearest.point)).normalized();
  const Vector3 start = nearest.point + kSkip * into;
  const auto hit = solid.first_hit(start, into);
  if (!hit) return std::nullopt;
  return start + 0.5 * hit->distance * into;
}

// Whether sections across a line are alike: at several places of it as much lies in most directions.
inline bool is_prism_along(const Vector3& from, const Vector3& to, const BoundingVolumeHierarchy& solid) {
  constexpr int kRays = 24;
  constexpr double kAlike = 0.1, kMost = 0.8;
  const Vector3 along = (to - from).normalized(), u = along.unitOrthogonal(), w = along.cross(u);
  const auto distances = [&](double share) {
    std::vector<double> found;
    for (const Vector2& d : even_directions(kRays)) {
      const auto hit = solid.first_hit(from + share * (to - from), d.x() * u + d.y() * w);
      found.push_back(hit ? hit->distance : std::numeric_limits<double>::infinity());
    }
    return found;
  };
  const std::vector<double> middle = distances(0.5);
  for (const double share : {0.1, 0.25, 0.75, 0.9}) {
    const std::vector<double> there = distances(share);
    int alike = 0;
    for (std::size_t k = 0; k < middle.size(); ++k)
      alike += there[k] == middle[k] || std::abs(there[k] - middle[k]) <= kAlike * middle[k];
    if (alike < kMost * static_cast<double>(middle.size())) return false;
  }
  return true;
}

// Of a prism, which is longer than wide and has sections that are alike across its length, the line from end
// to end: through the centroid or, of an open profile as an angle or a channel, in the middle of the wall
// that is nearest to it. Nothing of other solids. Cost: a query of the nearest surface and some hundred rays.
inline std::optional<std::array<Vector3, 2>> prism_stretch(const SolidMoments& moments,
                                                           const BoundingVolumeHierarchy& solid) {
  constexpr double kEven = 0.04;  // legs at the ends of a bench make it longer by its moments
  if (!moments.has_volume() || !moments.is_longer_than_wide()) return std::nullopt;
  const Vector3 axis = moments.axis(), centroid = moments.centroid();
  const std::optional<Vector3> middle =
      is_well_inside(centroid, solid) ? centroid : middle_of_wall(centroid, solid);
  if (!middle || !solid.inside(*middle)) return std::nullopt;
  const auto stretch = stretch_through(*middle, axis, solid);
  if (!stretch) return std::nullopt;
  const auto [from, to] = *stretch;
  const double expected = moments.length_as_prism();
  if (std::abs((to - from).norm() - expected) > kEven * expected) return std::nullopt;
  const Vector3 beside = centroid - *middle - (centroid - *middle).dot(axis) * axis;
  if (!is_prism_along(from + beside, to + beside, solid)) return std::nullopt;
  return stretch;
}

// The axis of a solid as far as it runs inside. Of a block, whose centroid lies inside, it is the given axis,
// there and back from the centroid, and of an open profile that in a wall. Of a vessel it is the line from
// the opening through the centroid, and of that the longest stretch, which is the stem or lies in the floor;
// its moments may well be equal, and a handle turns them.
inline std::optional<std::array<Vector3, 2>> axis_stretch(const SolidMoments& moments, const Vector3& axis,
                                                          const BoundingVolumeHierarchy& solid) {
  if (!moments.has_volume()) return std::nullopt;
  const Vector3 centre = moments.centroid();
  if (!is_well_inside(centre, solid)) {
    if (const auto along = prism_stretch(moments, solid)) return along;
    const auto opening = opening_direction(centre, solid);
    return opening ? longest_stretch(centre, *opening, solid) : std::nullopt;
  }
  return stretch_through(centre, axis, solid);
}

// The same along the principal axis that stands apart.
inline std::optional<std::array<Vector3, 2>> axis_stretch(const SolidMoments& moments,
                                                          const BoundingVolumeHierarchy& solid) {
  if (!moments.has_volume()) return std::nullopt;
  return axis_stretch(moments, moments.axis(), solid);
}

}  // namespace detail
}  // namespace mspskel
