// A tripod's arcs and tips.
#pragma once

#include <vector>

#include "mspskel/limbs/limb_tips.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

namespace mspskel::test {

// Arcs from the middle of the tripod to the given share of each limb, and one more to the given place.
inline ArcGraph tripod_arcs(const Solid& solid, double share, const Vector3* hair = nullptr) {
  const BallGraph limbs = tripod();
  ArcGraph graph;
  graph.add_hub(solid.at({0, 0, 0}));
  for (Index i = 1; i < 4; ++i) {
    graph.add_hub(solid.at(share * limbs.nodes[i].position));
    line(graph, 0, i);
  }
  if (hair) {
    graph.add_hub(solid.at(*hair));
    line(graph, 0, 4);
  }
  map_to_nearest(graph, solid.surface.position);
  return graph;
}

inline std::vector<LimbTip> tripod_tips(const Solid& solid) {
  std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), {});
  REQUIRE(tips.size() == 3);
  return tips;
}

}  // namespace mspskel::test
