// Every stage keeps arcs inside, with their homotopy type and map.
#include <catch2/catch.hpp>

#include "mspskel/arcs/center_arcs.h"
#include "mspskel/arcs/extend_ends.h"
#include "mspskel/arcs/merge_joints.h"
#include "mspskel/arcs/route_inside.h"
#include "mspskel/arcs/zip_arcs.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/refine/aim_ends.h"
#include "mspskel/refine/complete_limbs.h"
#include "mspskel/refine/prune_branches.h"
#include "mspskel/refine/refine_arcs.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

TEST_CASE("Random graphs are routed inside, and every stage keeps them there, with their type and map") {
  struct Case {
    std::string name;
    Index vertices, count, runs;
  };
  for (const Case& c : {Case{"torus", 300, 0, 8}, Case{"y-tube", 400, 0, 8}, Case{"plate", 600, 3, 5},
                        Case{"cup", 3100, 0, 2}, Case{"quadruped", 2500, 0, 2}}) {
    const Solid solid(sample(c.name, c.vertices, c.count));
    const VertexSlices slices = solid.no_slices();
    std::vector<LimbTip> no_tips;
    CenteringOptions coarse;
    coarse.step = 0.03;
    coarse.rounds = 1;
    for (Index run = 0; run < c.runs; ++run) {
      Random random(100 + run);
      ArcGraph graph = random_arc_graph(random, 0.5);
      map_to_nearest(graph, solid.surface.position);
      const GraphType before = type_of(graph);
      std::string stage;
      const auto check = [&](const char* name) {
        stage = name;
        INFO(c.name << ", run " << run << ", after " << stage);
        CHECK(type_of(graph) == before);
        CHECK(arcs_meet_hubs(graph));
        CHECK(map_is_partition(graph));
        CHECK(crossings(graph, solid.hierarchy) == 0);
      };
      const RoutingResult routing = route_inside(graph, solid.hierarchy, solid.surface);
      REQUIRE(routing.unroutable == 0);
      check("routing");
      center_arcs(graph, solid.hierarchy, coarse);
      check("centring");
      merge_joints(graph, solid.hierarchy, run % 2 ? 1.0 : 4.0);
      check("merging");
      zip_arcs(graph, solid.surface, solid.hierarchy, {run % 2 ? 0.75 : 1.9});
      check("zipping");
      aim_ends(graph, solid.surface, solid.hierarchy, coarse.step);
      check("aiming");
      extend_ends(graph, solid.hierarchy, {});
      check("extension");
      prune_branches(graph, no_tips);
      check("pruning");
      remove_spurs(graph, solid.hierarchy);
      check("removing spurs");
      CHECK(spur_count(graph, solid.hierarchy) == 0);
      center_arcs(graph, solid.hierarchy, coarse);
      check("centring again");
      complete_limbs(graph, solid.surface, solid.hierarchy, no_tips, {}, coarse.step);
      check("completion of limbs");
      subdivide(graph, 0.01);
      check("subdivision");
    }
  }
}

TEST_CASE("Options of the arc stages are checked") {
  const auto throws = [](auto options) { CHECK_THROWS_AS(validate(options), UsageError); };
  throws(ZipOptions{2.5});
  throws(LimbOptions{-1, 0.01});
  throws(LimbOptions{1, 2});
  throws(ExtensionOptions{0});
  throws(ExtensionOptions{0.01, 0});
  throws(ExtensionOptions{0.01, 0.5, -1});
}
