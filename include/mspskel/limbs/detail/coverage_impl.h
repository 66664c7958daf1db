#pragma once

#include <algorithm>
#include <cmath>

#include "mspskel/base/linkage.h"
#include "mspskel/limbs/detail/bare_plates.h"
#include "mspskel/limbs/detail/slender_parts.h"
#include "mspskel/mesh/component_extents.h"
#include "mspskel/mesh/subdivide_surface.h"
#include "mspskel/skeleton/detail/placed_skeleton.h"
#include "mspskel/solid/detail/ball_tree.h"

namespace mspskel {
namespace detail {

// Per component the maximal balls, in its solid, round the nodes that stand for it.
inline std::vector<BallTree> balls_of_nodes(const SurfaceSnapshot& surface, const SolidHierarchies& solids,
                                            const CurveSkeleton& skeleton, const Execution& execution) {
  const PlacedSkeleton placed(surface, solids, skeleton);
  std::vector<Ball> balls;
  for (const Vector3& position : placed.graph.position) balls.push_back({position, 0.0});
  parallel_for(
      static_cast<Index>(balls.size()), "coverage", execution, [] { return 0; },
      [&](Index i, int) {
        const BoundingVolumeHierarchy& solid = placed.solid_of(i);
        if (solid.inside(balls[i].centre)) balls[i].radius = solid.distance(balls[i].centre);
      });
  std::vector<std::vector<Ball>> of_component(surface.component_count);
  for (std::size_t i = 0; i < balls.size(); ++i)
    if (const Index c = placed.graph.component[i]; c != kNone) of_component[c].push_back(balls[i]);
  std::vector<BallTree> trees;
  for (std::vector<Ball>& own : of_component) trees.emplace_back(std::move(own));
  return trees;
}

// How far each vertex is outside the balls of its component.
inline std::vector<double> distances_outside(const SurfaceSnapshot& surface,
                                             const std::vector<BallTree>& balls, const Execution& execution) {
  std::vector<double> outside(surface.position.size(), 0.0);
  parallel_for(
      surface.vertex_count(), "coverage", execution,
      [&] { return std::vector<std::size_t>(balls.size(), 0); },
      [&](Index v, std::vector<std::size_t>& near) {
        if (surface.vertex_halfedge[v] == kNone) return;
        const Index c = surface.component[v];
        if (!balls[c].empty()) outside[v] = balls[c].distance_outside(surface.position[v], near[c]);
      });
  return outside;
}

// In model units. O(vertices).
inline Index nearest_vertex(const SurfaceSnapshot& surface, const Vector3& position) {
  const Vector3 x = surface.frame.to_normalised(position);
  Index best = kNone;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.vertex_halfedge[v] != kNone &&
        (best == kNone ||
         (surface.position[v] - x).squaredNorm() < (surface.position[best] - x).squaredNorm()))
      best = v;
  return best;
}

// The plates of a surface that its skeleton does not represent.
inline void add_bare_plates(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                            const std::vector<double>& outside, const CurveSkeleton& skeleton,
                            const CoverageOptions& options, const Execution& execution,
                            std::vector<UncoveredPart>& found) {
  std::vector<Vector3> points;
  for (const auto& node : skeleton.nodes) points.push_back(surface.frame.to_normalised(node.position));
  LimbOptions limbs;
  limbs.smallest = options.smallest / kLeastTipDepth;
  for (const Plate& plate :
       bare_plates(surface, solid, limbs, outside, points, options.smallest, execution.progress)) {
    const LimbTip& tip = plate.limb.tip;
    found.push_back({tip.vertex, surface.frame.to_model(surface.position[tip.vertex]),
                     surface.frame.scale * tip.measures.depth, 0.5 * tip.measures.slenderness, true});
  }
}

}  // namespace detail

MSPSKEL_INLINE std::vector<UncoveredPart> find_uncovered_parts(const SurfaceSnapshot& surface,
                                                               const BoundingVolumeHierarchy& solid,
                                                               const CurveSkeleton& skeleton,
                                                               const CoverageOptions& options,
                                                               const Execution& execution) {
  const SolidHierarchies solids(surface, solid, execution.progress);
  return find_uncovered_parts(surface, solids, skeleton, options, execution);
}

MSPSKEL_INLINE std::vector<UncoveredPart> find_uncovered_parts(const SurfaceSnapshot& surface,
                                                               const SolidHierarchies& solids,
                                                               const CurveSkeleton& skeleton,
                                                               const CoverageOptions& options,
                                                               const Execution& execution) {
  const std::vector<detail::BallTree> balls = detail::balls_of_nodes(surface, solids, skeleton, execution);
  const std::vector<double> outside = detail::distances_outside(surface, balls, execution);
  std::vector<Index> beyond;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (outside[v] > 0) beyond.push_back(v);
  const std::vector<double> extent = component_extents(surface);
  std::vector<UncoveredPart> found;
  // The balls are the body, so that what is beyond them may be nearly all.
  for (const detail::SlenderPart& part : detail::slender_parts(
           surface, outside, std::move(beyond),
           [&](Index v) { return options.smallest * extent[surface.component[v]]; },
           detail::LargestPart::kAny)) {
    if (!(part.slenderest.depth > 0)) continue;
    const double widths = 0.5 * part.slenderest.slenderness();
    if (widths >= kMissedWidths)
      found.push_back({part.top, surface.frame.to_model(surface.position[part.top]),
                       surface.frame.scale * part.slenderest.depth, widths, false});
  }
  if (!has_long_edge(surface)) {
    detail::add_bare_plates(surface, solids.whole(), outside, skeleton, options, execution, found);
  } else {
    // Few faces hide where a plate ends.
    const SubdividedSurface fine = subdivide_surface(surface);
    const std::size_t before = found.size();
    detail::add_bare_plates(fine.surface, solids.whole(),
                            detail::distances_outside(fine.surface, balls, execution), skeleton, options,
                            execution, found);
    for (std::size_t i = before; i < found.size(); ++i)
      found[i].vertex = detail::nearest_vertex(surface, found[i].position);
  }
  std::sort(found.begin(), found.end(), [](const UncoveredPart& a, const UncoveredPart& b) {
    return a.widths != b.widths ? a.widths > b.widths : a.vertex < b.vertex;
  });
  return found;
}

}  // namespace mspskel
