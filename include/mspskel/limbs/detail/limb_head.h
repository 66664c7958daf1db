// What a limb ends in that is squat and much wider than the limb.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "mspskel/limbs/detail/end_target.h"
#include "mspskel/limbs/detail/part_level.h"
#include "mspskel/limbs/detail/part_shape.h"
#include "mspskel/limbs/detail/part_walk.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {
namespace detail {

struct LimbHead {
  std::vector<Index> part;
  Vector3 middle;  // of its surface
  Vector3 along;   // from the neck to there, unit; 0 if they are one
  Vector3 end;     // where the limb is to end
  double neck;     // radius of a circle as long as the mouth
};

// Where a part is narrow again behind its widest level: about as narrow as it gets, since farther on the
// contour may by chance be shorter still. Nothing where it is not.
inline std::optional<double> neck_of(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                     Index top, std::vector<Index> part) {
  constexpr double kWider = 1.6, kAbout = 1.5;
  std::sort(part.begin(), part.end(),
            [&](Index a, Index b) { return distance[a] != distance[b] ? distance[a] > distance[b] : a < b; });
  LevelSum sum;
  std::vector<double> mouth;
  for (const Index v : part) {
    sum.add(change_at(surface, distance, v));
    mouth.push_back(sum.at(distance[v], distance[top]).mouth);
  }
  const auto widest = std::max_element(mouth.begin(), mouth.end());
  const auto narrowest = std::min_element(widest, mouth.end());
  if (!(*narrowest > 0) || *widest < kWider * *narrowest) return std::nullopt;
  const auto neck = std::find_if(widest, mouth.end(), [&](double m) { return m <= kAbout * *narrowest; });
  return distance[part[neck - mouth.begin()]];
}

// The middle of the surface for two radii of the mouth below a level, beyond which a part has the given
// shape; nothing where the limb begins there.
inline std::optional<Vector3> middle_below(const SurfaceSnapshot& surface,
                                           const std::vector<double>& distance, Index top,
                                           const std::vector<Index>& limb, double level,
                                           const PartShape& beyond) {
  double least = level;
  for (const Index v : limb) least = std::min(least, distance[v]);
  const double begin = std::max(least, level - 2 * beyond.mouth / (2 * kPi));
  PartShapeSum sum(surface, distance, begin);
  for (const Index v : limb)
    if (distance[v] >= begin) sum.add_vertex(v);
  return middle_between(sum.shape(distance[top]), beyond);
}

// A limb may end in something squat and much wider than itself, as a pole does in a disc, a box or a ball.
// Then it ends in the middle of that, on the side opposite to where it comes from: what lies farthest is some
// place of a rim, or a corner. Squat is what is no deeper than a ball, for its surface; a flat cap is none,
// nor is a wheel. `part`: the limb's surface. Walks on the head last. O(part · log part).
inline std::optional<LimbHead> find_head(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                         const std::vector<double>& distance, PartWalk& walk,
                                         const LimbTip& tip, const std::vector<Index>& part) {
  constexpr double kSquat = 2, kBulge = 4, kOfWay = 0.75;
  const std::optional<double> neck = neck_of(surface, distance, tip.vertex, part);
  if (!neck) return std::nullopt;
  LimbHead head;
  head.part = walk.beyond(tip.vertex, *neck);
  if (euler_characteristic(surface, head.part, [&](Index v) { return walk.holds(v); }) != 1)
    return std::nullopt;
  PartShapeSum sum(surface, distance, *neck);
  for (const Index v : head.part) sum.add_vertex(v);
  const PartShape shape = sum.shape(distance[tip.vertex]);
  const PartLevel level{distance[tip.vertex] - *neck, shape.area, shape.mouth};
  if (level.slenderness() >= kSquat || level.bulge() < kBulge || !solid.inside(shape.centre))
    return std::nullopt;
  head.neck = shape.mouth / (2 * kPi);
  head.middle = shape.centre;
  const std::optional<Vector3> root = middle_below(surface, distance, tip.vertex, part, *neck, shape);
  if (!root) return std::nullopt;
  const double way = (head.middle - *root).norm();
  head.along = way > 0 ? Vector3((head.middle - *root) / way) : Vector3::Zero();
  head.end = head.middle;
  if (const auto hit = way > 0 ? solid.first_hit(head.middle, head.along) : std::nullopt) {
    const double clear = hit->distance - 2 * kLeastClearance * tip.measures.half_width;
    head.end += std::max(0.0, std::min(clear, kOfWay * hit->distance)) * head.along;
  }
  return head;
}

}  // namespace detail
}  // namespace mspskel
