#pragma once

#include <algorithm>
#include <cmath>

#include "mspskel/base/linkage.h"
#include "mspskel/limbs/detail/slender_parts.h"
#include "mspskel/mesh/detail/component_diagonals.h"
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
  std::vector<double> outside(surface.position.size(), 0.0);
  parallel_for(
      surface.vertex_count(), "coverage", execution,
      [&] { return std::vector<std::size_t>(balls.size(), 0); },
      [&](Index v, std::vector<std::size_t>& near) {
        if (surface.vertex_halfedge[v] == kNone) return;
        const Index c = surface.component[v];
        if (!balls[c].empty()) outside[v] = balls[c].distance_outside(surface.position[v], near[c]);
      });

  std::vector<Index> beyond;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (outside[v] > 0) beyond.push_back(v);
  const std::vector<double> diagonal = detail::component_diagonals(surface);
  std::vector<UncoveredPart> found;
  for (const detail::SlenderPart& part :
       detail::slender_parts(surface, outside, std::move(beyond),
                             [&](Index v) { return options.smallest * diagonal[surface.component[v]]; })) {
    if (!(part.slenderest.depth > 0)) continue;
    const double widths = 0.5 * part.slenderest.slenderness();
    if (widths >= kMissedWidths)
      found.push_back({part.top, surface.frame.to_model(surface.position[part.top]),
                       surface.frame.scale * part.slenderest.depth, widths});
  }
  std::sort(found.begin(), found.end(), [](const UncoveredPart& a, const UncoveredPart& b) {
    return a.widths != b.widths ? a.widths > b.widths : a.vertex < b.vertex;
  });
  return found;
}

}  // namespace mspskel
