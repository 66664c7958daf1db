// How many independent cycles a graph of arcs has, and how many of them are independent in the solid.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/collapse/crossing_labels.h"

namespace mspskel {

struct CycleRank {
  Index cycles = 0;  // independent cycles of the graph
  Index rank = 0;    // of their signed crossings with the cocycles' regions
};

// Both are the genus in a skeleton with the right topology. Cost: a label a point; an elimination of as many
// rows as there are cycles, which arcs without a crossing keep short.
CycleRank cycle_rank(const ArcGraph& graph, const CrossingLabels& crossings);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/cycle_rank_impl.h"
#endif
