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

// Which of the first `count` parts are limbs, as some were told to be: one that is as another that was told
// is one, too. Blunt parts, as the corners of a block are, do as most of those that are like them. O(parts²).
template <class IsTold, class AreAlike, class IsBlunt>
std::vector<bool> equal_answers(std::size_t count, IsTold is_told, AreAlike are_alike, IsBlunt is_blunt) {
  std::vector<bool> limb(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_blunt(i)) {
      limb[i] = is_told(i);
      for (std::size_t j = 0; j < count && !limb[i]; ++j) limb[i] = is_told(j) && are_alike(i, j);
      continue;
    }
    std::size_t told = 0, untold = 0;
    for (std::size_t j = 0; j < count; ++j)
      if (i == j || are_alike(i, j)) ++(is_told(j) ? told : untold);
    limb[i] = told > untold;
  }
  return limb;
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
  // One leaf stands for all corners of a block.
  const std::vector<bool> is_limb = equal_answers(
      parts.size(), is_told,
      [&](std::size_t i, std::size_t j) { return are_alike(beyond, parts[i], parts[j]); },
      [&](std::size_t i) { return is_block_corner(parts[i].narrowest.depth_over_mouth()); });
  std::vector<LimbTip> limbs;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (is_limb[i] && leaf[i] == kNoLeaf) limbs.push_back(tips[i]);
  return limbs;
}

}  // namespace detail
}  // namespace mspskel
