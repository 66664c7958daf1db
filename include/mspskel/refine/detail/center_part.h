// Centring of a part of the arcs, while the others stay.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mspskel/arcs/center_arcs.h"

namespace mspskel {
namespace detail {

// Per hub of `after` whether an arc there is not as it was in `before`, or one that ended there is gone. What
// `before` had keeps its number.
inline std::vector<bool> changed_hubs(const ArcGraph& before, const ArcGraph& after) {
  std::vector<bool> changed(after.hub_position.size(), false);
  for (std::size_t a = 0; a < after.arcs.size(); ++a) {
    const Arc& now = after.arcs[a];
    const Arc* then = a < before.arcs.size() && before.arcs[a].alive ? &before.arcs[a] : nullptr;
    if (then != nullptr && now.alive && then->hub == now.hub && then->points == now.points) continue;
    for (const int end : {0, 1}) {
      if (now.alive) changed[now.hub[end]] = true;
      if (then != nullptr) changed[then->hub[end]] = true;
    }
  }
  return changed;
}

// Per arc whether it ends at one of these hubs.
inline std::vector<bool> arcs_at(const ArcGraph& graph, const std::vector<bool>& hubs) {
  std::vector<bool> arcs(graph.arcs.size(), false);
  for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
    const auto [first, last] = graph.arcs[a].hub;
    arcs[a] = graph.arcs[a].alive && (hubs[first] || hubs[last]);
  }
  return arcs;
}

// Per hub whether one of these arcs ends there.
inline std::vector<bool> hubs_of(const ArcGraph& graph, const std::vector<bool>& arcs) {
  std::vector<bool> hubs(graph.hub_position.size(), false);
  for (std::size_t a = 0; a < graph.arcs.size(); ++a)
    if (arcs[a])
      for (const Index hub : graph.arcs[a].hub) hubs[hub] = true;
  return hubs;
}

// The arcs that a change moves: those that meet what has changed, with both their ends, and so those that
// meet these.
inline std::vector<bool> arcs_near_changes(const ArcGraph& before, const ArcGraph& after) {
  return arcs_at(after, hubs_of(after, arcs_at(after, changed_hubs(before, after))));
}

// As center_arcs() on these arcs alone. The hubs where others end stay, as those do that are held.
inline void center_part(ArcGraph& graph, const std::vector<bool>& arcs, const BoundingVolumeHierarchy& solid,
                        const CenteringOptions& options, const Execution& execution,
                        const CrossingLabels& crossings, std::vector<Index> held) {
  ArcGraph part;
  part.hub_position = graph.hub_position;
  part.hub_alive = hubs_of(graph, arcs);
  part.arcs.resize(graph.arcs.size());
  std::vector<bool> others(graph.arcs.size(), false);
  for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
    others[a] = graph.arcs[a].alive && !arcs[a];
    if (arcs[a])
      part.arcs[a] = graph.arcs[a];
    else
      part.arcs[a].alive = false;
  }
  const std::vector<bool> border = hubs_of(graph, others);
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (border[h]) held.push_back(h);
  center_arcs(part, solid, options, execution, crossings, held);
  for (std::size_t a = 0; a < graph.arcs.size(); ++a)
    if (arcs[a]) graph.arcs[a] = std::move(part.arcs[a]);
  graph.hub_position = std::move(part.hub_position);
}

}  // namespace detail
}  // namespace mspskel
