// Leaf arcs are led to the ends of their limbs.
#include "mspskel/refine/aim_ends.h"

#include <catch2/catch.hpp>

#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"
#include "refine/tripod_arcs.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

TEST_CASE("Short leaf arcs are aimed at the end of their limb, and ends that reach it stay") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  ArcGraph graph = tripod_arcs(solid, 0.5);
  CHECK(aim_ends(graph, solid.surface, solid.hierarchy, 0.01) == 3);
  CHECK(crossings(graph, solid.hierarchy) == 0);
  for (Index i = 1; i < 4; ++i) {
    const Vector3 tip = tripod().nodes[i].position;
    CHECK((solid.model(graph.hub_position[i]) - tip).norm() < 0.3 * tip.norm());
  }
  CHECK(aim_ends(graph, solid.surface, solid.hierarchy, 0.05) == 0);
}

TEST_CASE("A leaf arc that stands for a tip is led to its target") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  ArcGraph graph = tripod_arcs(solid, 0.5, nullptr);
  const std::vector<LimbTip> tips = tripod_tips(solid);
  CHECK(aim_at_tips(graph, solid.hierarchy, tips, 0.01).size() == 3);
  const auto at = graph.incidence();
  for (const LimbTip& tip : tips) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h] && at[h].size() == 1)
        nearest = std::min(nearest, (graph.hub_position[h] - tip.target).norm());
    CHECK(nearest < 0.02);
  }
  CHECK(crossings(graph, solid.hierarchy) == 0);
}
