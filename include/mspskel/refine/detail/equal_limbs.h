// Equal parts get equal answers: what is as a limb that has an arc is a limb.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mspskel/arcs/detail/arc_balls.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/detail/uncovered_surface.h"

namespace mspskel {
namespace detail {

// Whether two parts are of about one depth, slenderness and carrier.
inline bool are_alike(const UncoveredSurface& surface, const SlenderPart& a, const SlenderPart& b) {
  return about_equal(a.slenderest.depth, b.slenderest.depth) &&
         about_equal(a.slenderest.slenderness(), b.slenderest.slenderness()) &&
         about_equal(surface.carrier(a.top), surface.carrier(b.top));
}

// The balls of the arcs that do not end in a leaf, and of the hubs where they and leaf arcs meet.
inline std::vector<Ball> balls_of_core(const ArcGraph& graph, const ArcLeaves& leaves,
                                       const std::vector<std::vector<Index>>& at, const ArcBalls& balls) {
  std::vector<bool> leads_to_leaf(graph.arcs.size(), false);
  for (const LeafArc& leaf : leaves.leaf) leads_to_leaf[leaf.arc] = true;
  std::vector<Ball> core;
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h] && at[h].size() >= 2) core.push_back(balls.hub[h]);
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (!leads_to_leaf[a]) core.insert(core.end(), balls.arc[a].balls().begin(), balls.arc[a].balls().end());
  return core;
}

// The parts without a leaf arc that are as one that has one. Limbs are told by their distance from the middle
// of the shape, which cuts those of a ring aslant, or from arcs that other limbs may lie along. Beyond the
// balls of what is no leaf arc all of them are measured alike. `told_limbs` are those that were told before.
// `least` and `few` as in UncoveredSurface. Cost: O(vertices · log balls + parts²).
inline std::vector<LimbTip> equal_limbs(const ArcGraph& graph, const SurfaceSnapshot& surface,
                                        const BoundingVolumeHierarchy& solid,
                                        const std::vector<LimbTip>& told_limbs, double least, bool few,
                                        const Execution& execution) {
  const auto at = graph.incidence();
  const ArcLeaves leaves(graph, at);
  if (leaves.leaf.empty()) return {};
  UncoveredSurface beyond(graph, surface, balls_of_core(graph, leaves, at, ArcBalls(graph, solid, execution)),
                          execution);
  std::vector<SlenderPart> parts = beyond.parts(least, few);
  const auto is_none = [](const SlenderPart& part) {
    return part.slenderest.depth == 0 || part.narrowest.depth == 0;
  };
  parts.erase(std::remove_if(parts.begin(), parts.end(), is_none), parts.end());
  std::vector<LimbTip> tips;
  for (const SlenderPart& part : parts) tips.push_back(beyond.limb(part.top, part.slenderest, solid));
  const std::vector<std::size_t> leaf = leaves_of_tips(graph, leaves, tips);
  // Where a deeper limb ends, at a corner of its end perhaps, that corner is none of its own.
  constexpr double kDeeper = 2;
  std::vector<double> depth(leaves.leaf.size(), 0.0);
  const std::vector<std::size_t> leaf_of_limb = leaves_of_tips(graph, leaves, told_limbs);
  for (std::size_t i = 0; i < told_limbs.size(); ++i)
    if (leaf_of_limb[i] != kNoLeaf) depth[leaf_of_limb[i]] = told_limbs[i].measures.depth;
  const auto is_told = [&](std::size_t i) {
    return leaf[i] != kNoLeaf && depth[leaf[i]] < kDeeper * parts[i].slenderest.depth;
  };
  std::vector<LimbTip> limbs;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (leaf[i] != kNoLeaf) continue;
    std::size_t told = 0, untold = 0;
    for (std::size_t j = 0; j < parts.size(); ++j)
      if (are_alike(beyond, parts[i], parts[j])) ++(is_told(j) ? told : untold);
    // The corners of a block are alike too, and one leaf stands for all of them.
    const bool blunt = is_block_corner(parts[i].narrowest.depth_over_mouth());
    if (told > (blunt ? untold : 0)) limbs.push_back(tips[i]);
  }
  return limbs;
}

}  // namespace detail
}  // namespace mspskel
