// Arcs side by side become one, arcs round a hole stay two.
#include "mspskel/arcs/zip_arcs.h"

#include <array>
#include <catch2/catch.hpp>

#include "mspskel/arcs/detail/arc_zipper.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// In a tube along z one arc down and two side by side up.
ArcGraph side_by_side(const Solid& solid) {
  ArcGraph graph;
  graph.add_hub(solid.at({0, 0, 5}));
  graph.add_hub(solid.at({0, 0, 1}));
  graph.add_hub(solid.at({0.15, 0, 11}));
  graph.add_hub(solid.at({-0.15, 0, 10.8}));
  for (Index tip = 1; tip < 4; ++tip) line(graph, 0, tip, 60);
  map_to_nearest(graph, solid.surface.position);
  return graph;
}

}  // namespace

TEST_CASE("Ends that are kept stay two, however near their arcs are") {
  const Solid solid(tube(1, 12, 24, 24));
  ArcGraph graph = side_by_side(solid);
  zip_arcs(graph, solid.surface, solid.hierarchy, {}, {}, {}, {false, false, true, true});
  CHECK(leaf_count(graph) == 3);
  CHECK(map_is_partition(graph));
  // One that is not kept goes into one that is.
  ArcGraph other = side_by_side(solid);
  zip_arcs(other, solid.surface, solid.hierarchy, {}, {}, {}, {false, false, true, false});
  CHECK(leaf_count(other) == 2);
}

TEST_CASE("Two arcs side by side in a tube become one") {
  const Solid solid(tube(1, 12, 24, 24));
  ArcGraph graph = side_by_side(solid);
  CHECK(zip_arcs(graph, solid.surface, solid.hierarchy, {}) >= 1);
  CHECK(living_arcs(graph) == 1);
  CHECK(leaf_count(graph) == 2);
  CHECK(map_is_partition(graph));
  CHECK(crossings(graph, solid.hierarchy) == 0);
}

TEST_CASE("Arcs that part later are zipped up to where they part; arcs round a hole stay two") {
  BallGraph fork;
  fork.blend = 0;
  fork.nodes = {{{0, 0, 0}, 0.5}, {{0, 0, 4}, 0.5}, {{2, 0, 6}, 0.4}, {{-2, 0, 6}, 0.4}};
  fork.edges = {{0, 1}, {1, 2}, {1, 3}};
  const Solid solid(to_mesh(skin_graph(fork, 1500)));
  ArcGraph graph;
  for (const Vector3& p : {Vector3(0, 0, 1), Vector3(0, 0, 0), Vector3(2, 0, 6), Vector3(-2, 0, 6)})
    graph.add_hub(solid.at(p));
  line(graph, 0, 1);
  for (const double side : {1.0, -1.0}) {
    const Vector3 bend = solid.at({0.1 * side, 0, 4});
    const Index tip = side > 0 ? 2 : 3;
    std::vector<Vector3> points = straight(graph.hub_position[0], bend, 40);
    points.push_back(bend);
    for (const Vector3& p : straight(bend, graph.hub_position[tip], 40)) points.push_back(p);
    add_arc(graph, 0, tip, points);
  }
  map_to_nearest(graph, solid.surface.position);
  REQUIRE(crossings(graph, solid.hierarchy) == 0);
  CHECK(zip_arcs(graph, solid.surface, solid.hierarchy, {}) >= 1);
  CHECK(joint_count(graph) == 1);
  CHECK(leaf_count(graph) == 3);
  CHECK(map_is_partition(graph));
  CHECK(crossings(graph, solid.hierarchy) == 0);
  const auto at = graph.incidence();
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (at[h].size() == 3) CHECK(solid.model(graph.hub_position[h]).z() > 3.7);

  const Solid ring(torus(1, 0.3, 40, 16));
  ArcGraph round;
  round.add_hub(ring.at({1, 0, 0}));
  round.add_hub(ring.at({-1, 0, 0}));
  round.add_hub(ring.at({1.2, 0, 0}));
  for (const double side : {1.0, -1.0}) {
    std::vector<Vector3> half;
    for (int i = 1; i < 30; ++i)
      half.push_back(ring.at({std::cos(kPi * i / 30), side * std::sin(kPi * i / 30), 0}));
    add_arc(round, 0, 1, half);
  }
  line(round, 0, 2, 5);
  map_to_nearest(round, ring.surface.position);
  zip_arcs(round, ring.surface, ring.hierarchy, {});
  CHECK(type_of(round) == GraphType{1, 1});
  CHECK(crossings(round, ring.hierarchy) == 0);
}

// Each hub of a line has two leaf arcs that never part, and loses them: what that costs does not depend on
// how long the line is.
TEST_CASE("As many pairs are compared a zip in a long graph as in a short one") {
  std::array<double, 2> compared{};
  for (const int k : {0, 1}) {
    const int hubs = k == 0 ? 20 : 100;
    const Solid solid(tube(1, hubs + 1, 24, 4 * hubs));
    ArcGraph graph;
    for (int i = 0; i < hubs; ++i) {
      const Index hub = graph.add_hub(solid.at({0, 0, i + 1.0}));
      if (i > 0) line(graph, i == 1 ? 0 : hub - 3, hub, 10);
      for (const double side : {0.1, -0.1})
        line(graph, hub, graph.add_hub(solid.at({0.5, side, i + 1.2})), 10);
    }
    map_to_nearest(graph, solid.surface.position);
    const GraphType before = type_of(graph);
    detail::ArcZipper zipper(graph, solid.surface, solid.hierarchy, 0.75, {});
    CHECK(zipper.run({}) >= 2 * (hubs - 2));
    CHECK(type_of(graph) == before);
    CHECK(map_is_partition(graph));
    compared[k] = static_cast<double>(zipper.compared()) / hubs;
  }
  CHECK(compared[1] < 1.25 * compared[0]);
}

// Two of the seven arcs at a joint lie in the same arm, and one of them goes: the other pairs are as they
// were.
TEST_CASE("Pairs of arcs that have not changed are not compared again") {
  BallGraph jack;
  jack.blend = 0;
  jack.nodes = {{{0, 0, 0}, 0.5}};
  for (int arm = 0; arm < 6; ++arm) {
    jack.nodes.push_back({(arm % 2 == 0 ? 6.0 : -6.0) * Vector3::Unit(arm / 2), 0.5});
    jack.edges.push_back({0, arm + 1});
  }
  const Solid solid(to_mesh(skin_graph(jack, 3000)));
  ArcGraph graph;
  graph.add_hub(solid.at({0, 0, 0}));
  for (int arm = 0; arm < 6; ++arm)
    line(graph, 0, graph.add_hub(solid.at(jack.nodes[static_cast<std::size_t>(arm) + 1].position * 0.9)), 11);
  line(graph, 0, graph.add_hub(solid.at({5.2, 0.1, 0})), 11);
  map_to_nearest(graph, solid.surface.position);
  detail::ArcZipper zipper(graph, solid.surface, solid.hierarchy, 0.75, {});
  CHECK(zipper.run({}) == 1);
  CHECK(living_arcs(graph) == 6);
  CHECK(zipper.compared() <= 7 * 6);
}
