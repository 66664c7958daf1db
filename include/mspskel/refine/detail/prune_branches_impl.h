#pragma once

#include <algorithm>

#include "mspskel/arcs/detail/arc_editor.h"
#include "mspskel/base/linkage.h"
#include "mspskel/refine/detail/arc_leaves.h"

namespace mspskel {
namespace detail {

// One round: removes the leaf arcs that stand for no tip, from a graph without through hubs. Where all arcs
// of a joint go but one, that one is a leaf arc of the next round.
inline Index remove_leaves_without_tip(ArcGraph& graph, const std::vector<LimbTip>& tips) {
  ArcEditor editor(graph);
  const ArcLeaves leaves(graph, graph.incidence());
  std::vector<bool> has_tip(leaves.leaf.size(), false);
  for (const std::size_t leaf : leaves_of_tips(graph, leaves, tips))
    if (leaf != kNoLeaf) has_tip[leaf] = true;
  std::vector<std::pair<double, std::size_t>> bare;
  for (std::size_t i = 0; i < leaves.leaf.size(); ++i)
    if (!has_tip[i]) bare.push_back({arc_length(graph.arcs[leaves.leaf[i].arc]), i});
  std::sort(bare.begin(), bare.end());
  Index removed = 0;
  for (const auto& [length, i] : bare) {
    const auto [arc, joint, tip] = leaves.leaf[i];
    if (editor.at(joint).size() < 2) continue;
    editor.remove_leaf_arc(arc, joint);
    ++removed;
  }
  return removed;
}

}  // namespace detail

MSPSKEL_INLINE Index prune_branches(ArcGraph& graph, const std::vector<LimbTip>& tips) {
  Index removed = 0;
  while (true) {
    dissolve_through_hubs(graph);
    const Index round = detail::remove_leaves_without_tip(graph, tips);
    if (round == 0) return removed;
    removed += round;
  }
}

MSPSKEL_INLINE Index remove_spurs(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                  const std::vector<LimbTip>& tips) {
  const auto is_flat_end = [&](const Vector3& x) {
    return std::any_of(tips.begin(), tips.end(), [&](const LimbTip& tip) {
      return (tip.target - x).norm() < 0.5 * tip.flat_end;
    });
  };
  Index removed = 0;
  while (true) {
    dissolve_through_hubs(graph);
    detail::ArcEditor editor(graph);
    Index spur = kNone, joint = kNone;
    for (Index a = 0; a < graph.arc_count() && spur == kNone; ++a) {
      if (!graph.arcs[a].alive) continue;
      for (const int end : {0, 1}) {
        const Index tip = graph.arcs[a].hub[end], hub = graph.arcs[a].hub[1 - end];
        if (editor.at(tip).size() != 1 || editor.at(hub).size() < 3) continue;
        const Vector3& centre = graph.hub_position[hub];
        if ((graph.hub_position[tip] - centre).norm() >= solid.distance(centre) ||
            is_flat_end(graph.hub_position[tip]))
          continue;
        spur = a;
        joint = hub;
      }
    }
    if (spur == kNone) return removed;
    editor.remove_leaf_arc(spur, joint);
    ++removed;
  }
}

}  // namespace mspskel
