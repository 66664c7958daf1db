#pragma once

#include <algorithm>
#include <utility>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/complex_topology.h"

namespace mspskel {

MSPSKEL_INLINE CycleRank cycle_rank(const ArcGraph& graph, const CrossingLabels& crossings) {
  std::vector<std::pair<CocycleLabel, Index>> labelled;
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (graph.arcs[a].alive) labelled.push_back({crossings.along(graph.arcs[a].points), a});
  std::stable_sort(labelled.begin(), labelled.end(),
                   [](const auto& a, const auto& b) { return has_fewer_crossings(a.first, b.first); });
  CycleRank result;
  LabelledForest forest(graph.hub_count());
  LabelRank rank;
  CocycleLabel loop;
  for (const auto& [label, a] : labelled) {
    if (forest.join(graph.arcs[a].hub[0], graph.arcs[a].hub[1], label, loop)) continue;
    ++result.cycles;
    rank.insert(loop);
  }
  result.rank = rank.rank();
  return result;
}

}  // namespace mspskel
