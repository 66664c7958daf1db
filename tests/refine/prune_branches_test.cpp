// Pruning takes what stands for no limb, and nothing else.
#include "mspskel/refine/prune_branches.h"

#include <catch2/catch.hpp>

#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/refine_arcs.h"
#include "mspskel/samples/skin_graph.h"
#include "refine/tripod_arcs.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

TEST_CASE("Pruning takes a hair and leaves the limbs") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  const Vector3 hair(0, 0.3, 0);
  ArcGraph graph = tripod_arcs(solid, 1.0, &hair);
  CHECK(prune_branches(graph, tripod_tips(solid)) == 1);
  CHECK(leaf_count(graph) == 3);
  CHECK(living_arcs(graph) == 3);
  CHECK_FALSE(graph.hub_alive[4]);
  CHECK(map_is_partition(graph));
  // The last arc of a piece stays, whether or not it stands for a tip.
  prune_branches(graph, {});
  CHECK(type_of(graph) == GraphType{1, 0});
  CHECK(living_arcs(graph) == 1);
}

TEST_CASE("A leaf arc that leaves the solid goes, and the others stay") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  const Vector3 outside(0, 2, 0);
  ArcGraph graph = tripod_arcs(solid, 0.97, &outside);
  CHECK(crossings(graph, solid.hierarchy) > 0);
  CHECK(remove_crossing_leaves(graph, solid.hierarchy) == 1);
  CHECK(crossings(graph, solid.hierarchy) == 0);
  CHECK(leaf_count(graph) == 3);
  CHECK(map_is_partition(graph));
  CHECK(type_of(graph) == GraphType{1, 0});
  CHECK(remove_crossing_leaves(graph, solid.hierarchy) == 0);
}

TEST_CASE("A star in a ball is pruned to one arc") {
  const Solid solid(sphere(200));
  ArcGraph graph;
  graph.add_hub(Vector3::Zero());
  Random random(3);
  for (Index i = 1; i < 7; ++i) {
    graph.add_hub(0.3 * random.in_ball().normalized());
    line(graph, 0, i);
  }
  map_to_nearest(graph, solid.surface.position);
  prune_branches(graph, {});
  CHECK(living_arcs(graph) == 1);
  CHECK(map_is_partition(graph));
}

TEST_CASE("Leaf arcs that stand for a tip are not pruned") {
  const Solid solid(sphere(100));
  Random random(6);
  for (int run = 0; run < 20; ++run) {
    ArcGraph graph = random_arc_graph(random, 0.4);
    map_to_nearest(graph, solid.surface.position);
    dissolve_through_hubs(graph);
    const detail::ArcLeaves leaves(graph, graph.incidence());
    std::vector<LimbTip> tips(leaves.leaf.size());
    for (std::size_t i = 0; i < tips.size(); ++i) {
      tips[i].target = graph.hub_position[leaves.leaf[i].tip];
      tips[i].cap = leaves.vertices[i];
    }
    CHECK(prune_branches(graph, tips) == 0);
  }
}

TEST_CASE("A bump on a limb does not take the arc that ends at the limb's tip") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  ArcGraph graph = tripod_arcs(solid, 0.97);
  std::vector<LimbTip> tips = tripod_tips(solid);
  LimbTip bump;  // all of its few vertices lie on the first limb's arc
  bump.target = bump.position = solid.at({0.4, 0, 2});
  for (Index v = 0; v < solid.surface.vertex_count(); ++v)
    if ((solid.surface.position[v] - bump.target).norm() < 0.03) bump.cap.push_back(v);
  REQUIRE_FALSE(bump.cap.empty());
  tips.insert(tips.begin(), bump);
  const detail::ArcLeaves leaves(graph, graph.incidence());
  const std::vector<std::size_t> leaf = detail::leaves_of_tips(graph, leaves, tips);
  CHECK(leaf[0] == detail::kNoLeaf);
  for (std::size_t t = 1; t < tips.size(); ++t) CHECK(leaf[t] != detail::kNoLeaf);
}

TEST_CASE("No leaf ends in the ball of its joint once spurs are removed") {
  const Solid solid(sphere(100));
  Random random(5);
  Index removed = 0;
  for (int run = 0; run < 400; ++run) {
    ArcGraph graph = random_arc_graph(random, 0.4);
    map_to_nearest(graph, solid.surface.position);
    const GraphType before = type_of(graph);
    removed += remove_spurs(graph, solid.hierarchy);
    CHECK(spur_count(graph, solid.hierarchy) == 0);
    CHECK(type_of(graph) == before);
    CHECK(map_is_partition(graph));
  }
  CHECK(removed > 10);
}
