// Routing, merging, zipping, pruning, aiming and growing: each keeps the topology and stays inside, and does
// what it is for.
#include <catch2/catch.hpp>

#include "graph/arc_graphs.h"
#include "graph/solids.h"
#include "mspskel/graph/aim_ends.h"
#include "mspskel/graph/center_arcs.h"
#include "mspskel/graph/complete_limbs.h"
#include "mspskel/graph/detail/arc_leaves.h"
#include "mspskel/graph/extend_ends.h"
#include "mspskel/graph/limb_tips.h"
#include "mspskel/graph/merge_joints.h"
#include "mspskel/graph/prune_branches.h"
#include "mspskel/graph/refine_arcs.h"
#include "mspskel/graph/route_inside.h"
#include "mspskel/graph/zip_arcs.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// An arc between two hubs with even points on a straight line.
Index line(ArcGraph& graph, Index from, Index to, Index count = 40) {
  return add_arc(graph, from, to, straight(graph.hub_position[from], graph.hub_position[to], count));
}

Index joint_count(const ArcGraph& graph) {
  Index joints = 0;
  for (const auto& arcs : graph.incidence()) joints += arcs.size() >= 3;
  return joints;
}

Index spur_count(const ArcGraph& graph, const BoundingVolumeHierarchy& solid) {
  const auto at = graph.incidence();
  Index spurs = 0;
  for (const Arc& arc : graph.arcs)
    for (const int end : {0, 1}) {
      if (!arc.alive || at[arc.hub[end]].size() != 1 || at[arc.hub[1 - end]].size() < 3) continue;
      const Vector3& joint = graph.hub_position[arc.hub[1 - end]];
      spurs += (graph.hub_position[arc.hub[end]] - joint).norm() < solid.distance(joint);
    }
  return spurs;
}

}  // namespace

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

TEST_CASE("An arc across the hole of a torus comes back through the ring") {
  const Solid solid(torus(1, 0.3, 40, 16));
  ArcGraph graph;
  graph.add_hub(solid.at({1, 0, 0}));
  graph.add_hub(solid.at({-1, 0.05, 0}));
  line(graph, 0, 1);
  map_to_nearest(graph, solid.surface.position);
  const RoutingResult result = route_inside(graph, solid.hierarchy, solid.surface);
  CHECK(result.hubs_moved == 0);
  CHECK(result.routed > 0);
  CHECK(crossings(graph, solid.hierarchy) == 0);
  for (const Vector3& p : graph.arcs[0].points) {
    const Vector3 x = solid.model(p);
    CHECK(std::hypot(x.x(), x.y()) > 0.69);
  }
  // What is inside is left alone.
  const auto points = graph.arcs[0].points;
  const RoutingResult again = route_inside(graph, solid.hierarchy, solid.surface);
  CHECK((again.hubs_moved == 0 && again.routed == 0 && again.unroutable == 0));
  CHECK(graph.arcs[0].points == points);
}

TEST_CASE("A hub in the cavity of a cup moves into the wall, and its arcs follow the wall") {
  const Solid solid(sample("cup", 3100));
  ArcGraph graph;
  graph.add_hub(solid.at({0.1, 0, 0}));
  graph.add_hub(solid.at({-0.95, 0, 0}));
  graph.add_hub(solid.at({0, 0.97, 0.3}));
  line(graph, 0, 1);
  line(graph, 0, 2);
  line(graph, 1, 2);
  map_to_nearest(graph, solid.surface.position);
  REQUIRE(crossings(graph, solid.hierarchy) > 0);
  const RoutingResult result = route_inside(graph, solid.hierarchy, solid.surface);
  CHECK(result.hubs_moved >= 1);
  CHECK(result.unroutable == 0);
  CHECK(crossings(graph, solid.hierarchy) == 0);
  CHECK(type_of(graph) == GraphType{1, 1});
}

TEST_CASE("A hub outside moves into its own component, not into a nearer one") {
  PolygonSoup soup = to_soup(tube(1, 6, 12, 8));
  append(soup, to_soup(translated(tube(1, 6, 12, 8), {5, 0, 0})));
  const Solid solid(to_mesh(soup));
  ArcGraph graph;
  graph.add_hub(solid.at({3.6, 0, 3}));  // of the first tube, nearer to the second
  graph.add_hub(solid.at({0, 0, 5}));
  graph.add_hub(solid.at({5, 0, 3}));
  line(graph, 0, 1);
  for (Index v = 0; v < solid.surface.vertex_count(); ++v) {
    graph.arc_of_vertex.push_back(solid.surface.component[v] == 0 ? 0 : kNone);
    graph.hub_of_vertex.push_back(solid.surface.component[v] == 0 ? kNone : 2);
  }
  const RoutingResult result = route_inside(graph, solid.hierarchy, solid.surface);
  CHECK(result.hubs_moved == 1);
  CHECK(result.unroutable == 0);
  CHECK(crossings(graph, solid.hierarchy) == 0);
  CHECK(solid.model(graph.hub_position[0]).x() < 1);
}

TEST_CASE("Joints within one another's ball become one, those further apart and loops stay") {
  const Solid solid(tube(1, 20, 24, 40));
  ArcGraph graph;
  for (const double z : {1.0, 6.0, 6.5, 14.0, 19.0}) graph.add_hub(solid.at({0, 0, z}));
  for (const double z : {6.1, 6.4, 14.0}) graph.add_hub(solid.at({0.8, 0, z}));
  for (Index h = 0; h < 4; ++h) line(graph, h, h + 1);
  line(graph, 1, 5);
  line(graph, 2, 6);
  line(graph, 3, 7);
  map_to_nearest(graph, solid.surface.position);
  ArcGraph with_cycle = graph;
  CHECK(merge_joints(graph, solid.hierarchy) == 1);
  CHECK(joint_count(graph) == 2);
  CHECK(type_of(graph) == GraphType{1, 0});
  CHECK(map_is_partition(graph));
  CHECK(crossings(graph, solid.hierarchy) == 0);
  // A parallel arc would become a loop.
  line(with_cycle, 1, 2);
  CHECK(merge_joints(with_cycle, solid.hierarchy) == 0);
  CHECK(type_of(with_cycle) == GraphType{1, 1});
}

TEST_CASE("Joints with the surface between them do not merge, however far balls may reach") {
  // Two strands of a hairpin: the joints' balls overlap by far, but there is a gap between them.
  BallGraph hairpin;
  hairpin.blend = 0;
  hairpin.nodes = {{{0, 0, 0}, 0.3}, {{0, 0, 4}, 0.3}, {{0.8, 0, 4}, 0.3}, {{0.8, 0, 0}, 0.3}};
  hairpin.edges = {{0, 1}, {1, 2}, {2, 3}};
  const Solid solid(to_mesh(skin_graph(hairpin, 1200)));
  ArcGraph graph;
  for (const Vector3& p : {Vector3(0, 0, 3.2), Vector3(0, 0, 4), Vector3(0.8, 0, 4), Vector3(0.8, 0, 3.2)})
    graph.add_hub(solid.at(p));
  for (const Vector3& p : {Vector3(0.1, 0.1, 2), Vector3(-0.1, 0, 2), Vector3(0.7, 0, 2), Vector3(0.9, 0, 2)})
    graph.add_hub(solid.at(p));
  std::vector<Vector3> bend = straight(graph.hub_position[0], graph.hub_position[1], 20);
  for (const Vector3& p : straight(graph.hub_position[1], graph.hub_position[2], 20)) bend.push_back(p);
  bend.push_back(graph.hub_position[2]);
  for (const Vector3& p : straight(graph.hub_position[2], graph.hub_position[3], 20)) bend.push_back(p);
  add_arc(graph, 0, 3, bend);
  line(graph, 0, 4);
  line(graph, 0, 5);
  line(graph, 3, 6);
  line(graph, 3, 7);
  graph.hub_alive[1] = graph.hub_alive[2] = false;
  map_to_nearest(graph, solid.surface.position);
  REQUIRE(crossings(graph, solid.hierarchy) == 0);
  for (const double overlap : {1.0, 3.0, 10.0}) {
    ArcGraph merged = graph;
    merge_joints(merged, solid.hierarchy, overlap);
    CHECK(crossings(merged, solid.hierarchy) == 0);
    CHECK(type_of(merged) == GraphType{1, 0});
  }
}

TEST_CASE("Two arcs side by side in a tube become one") {
  const Solid solid(tube(1, 12, 24, 24));
  ArcGraph graph;
  graph.add_hub(solid.at({0, 0, 5}));
  graph.add_hub(solid.at({0, 0, 1}));
  graph.add_hub(solid.at({0.15, 0, 11}));
  graph.add_hub(solid.at({-0.15, 0, 10.8}));
  for (Index tip = 1; tip < 4; ++tip) line(graph, 0, tip, 60);
  map_to_nearest(graph, solid.surface.position);
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

namespace {

// Arcs from the middle of the tripod to the given share of each limb, and one more to the given place.
ArcGraph tripod_arcs(const Solid& solid, double share, const Vector3* hair = nullptr) {
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

std::vector<LimbTip> tripod_tips(const Solid& solid) {
  std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), {});
  REQUIRE(tips.size() == 3);
  return tips;
}

}  // namespace

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

TEST_CASE("A hub outside goes into its own limb, however near another one is") {
  // Two parallel tubes, joined far away.
  BallGraph limbs;
  limbs.blend = 0.02;
  limbs.nodes = {{{0, 0, 0}, 0.3}, {{3, 0, 0}, 0.3}, {{3, 1, 0}, 0.3}, {{0, 1, 0}, 0.3}};
  limbs.edges = {{0, 1}, {1, 2}, {2, 3}};
  const Solid solid(to_mesh(skin_graph(limbs, 1500)));
  ArcGraph graph;
  graph.add_hub(solid.at({1.5, 0.55, 0}));  // nearer to the other tube
  graph.add_hub(solid.at({2.8, 0, 0}));
  line(graph, 0, 1);
  graph.arc_of_vertex.assign(solid.surface.position.size(), kNone);
  graph.hub_of_vertex.assign(solid.surface.position.size(), kNone);
  for (Index v = 0; v < solid.surface.vertex_count(); ++v) {
    const Vector3 x = solid.model(solid.surface.position[v]);
    graph.hub_of_vertex[v] = x.y() < 0.45 && x.x() < 2 ? 0 : 1;
  }
  route_inside(graph, solid.hierarchy, solid.surface);
  CHECK(solid.hierarchy.inside(graph.hub_position[0]));
  CHECK(solid.model(graph.hub_position[0]).y() < 0.4);
  CHECK(crossings(graph, solid.hierarchy) == 0);
}

TEST_CASE("A limb without an arc gets one, and nothing is added where all have theirs") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  const VertexSlices slices = solid.slices();
  std::vector<LimbTip> tips = tripod_tips(solid);
  ArcGraph whole = tripod_arcs(solid, 0.97);
  CHECK(complete_limbs(whole, solid.surface, solid.hierarchy, tips, {}, 0.01) == 0);
  ArcGraph graph = whole;
  remove_leaf_arc(graph, 2, 0);
  dissolve_through_hubs(graph);
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 1);
  CHECK(leaf_count(graph) == 3);
  CHECK(type_of(graph) == GraphType{1, 0});
  CHECK(arcs_meet_hubs(graph));
  CHECK(map_is_partition(graph));
  CHECK(crossings(graph, solid.hierarchy) == 0);
  double nearest = 10;
  const auto at = graph.incidence();
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (at[h].size() == 1)
      nearest = std::min(nearest, (solid.model(graph.hub_position[h]) - tripod().nodes[3].position).norm());
  CHECK(nearest < 0.5);
}

TEST_CASE("What no arc comes near gets an arc and a tip, whatever other limbs were told") {
  BallGraph horned = tripod();
  horned.nodes.push_back({{0, 0, 1.5}, 0.2});
  horned.nodes.push_back({{0, 1.2, 1.5}, 0.15});
  horned.edges.push_back({4, 5});
  const Solid solid(to_mesh(skin_graph(horned, 2500)));
  ArcGraph graph = tripod_arcs(solid, 0.97);
  std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), {});
  const auto is_horn = [&](const LimbTip& tip) {
    return (solid.model(tip.position) - horned.nodes[5].position).norm() < 0.4;
  };
  tips.erase(std::remove_if(tips.begin(), tips.end(), is_horn), tips.end());
  REQUIRE(tips.size() == 3);
  ArcGraph limbless = graph;
  std::vector<LimbTip> none;
  CHECK(complete_limbs(limbless, solid.surface, solid.hierarchy, none, {}, 0.01) == 1);
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 1);
  CHECK(leaf_count(graph) == 4);
  REQUIRE(tips.size() == 4);
  CHECK(is_horn(tips.back()));
  CHECK(crossings(graph, solid.hierarchy) == 0);
  CHECK(map_is_partition(graph));
}

TEST_CASE("A leaning horn that no arc comes near is reached to its tip") {
  BallGraph leaning;
  leaning.blend = 0.05;
  leaning.nodes = {{{0, 0, -3}, 0.5}, {{0, 0, 3}, 0.5}, {{0, 0, 0}, 0.12}, {{0, 1.5, 1.5}, 0.09}};
  leaning.edges = {{0, 1}, {2, 3}};
  const Solid solid(to_mesh(skin_graph(leaning, 4000)));
  const auto of_horn = [&](const LimbTip& tip) {
    return (solid.model(tip.position) - leaning.nodes[3].position).norm() < 0.3;
  };
  std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), {});
  tips.erase(std::remove_if(tips.begin(), tips.end(), of_horn), tips.end());
  REQUIRE(tips.size() == 2);
  for (const Index count : {300, 700}) {
    ArcGraph graph;
    graph.add_hub(solid.at({0, 0, -3}));
    graph.add_hub(solid.at({0, 0, 3}));
    line(graph, 0, 1, count);
    map_to_nearest(graph, solid.surface.position);
    std::vector<LimbTip> found = tips;
    CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, found, {}, 0.008) == 1);
    CHECK(of_horn(found.back()));
    CHECK((solid.model(graph.hub_position.back()) - leaning.nodes[3].position).norm() < 0.3);
  }
}

TEST_CASE("Vertices without faces are no limb's") {
  DefaultMesh mesh = to_mesh(skin_graph(tripod(), 1200));
  mesh.add_vertex({9, 9, 9});
  const Solid solid(mesh);
  REQUIRE(solid.surface.component.back() == kNone);
  ArcGraph graph = tripod_arcs(solid, 0.97);
  graph.arc_of_vertex.back() = graph.hub_of_vertex.back() = kNone;
  std::vector<LimbTip> tips = tripod_tips(solid);
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 0);
}

TEST_CASE("No place is completed twice") {
  for (const std::string name : {"plate", "quadruped", "octoped"}) {
    const Solid solid(sample(name, 3200));
    const auto middle = solid.hierarchy.first_hit(solid.surface.position[0] - 1e-6 * solid.surface.normal[0],
                                                  -solid.surface.normal[0]);
    REQUIRE(middle);
    ArcGraph graph;
    graph.add_hub(solid.surface.position[0] - 0.4 * middle->distance * solid.surface.normal[0]);
    graph.add_hub(solid.surface.position[0] - 0.6 * middle->distance * solid.surface.normal[0]);
    line(graph, 0, 1);
    map_to_nearest(graph, solid.surface.position);
    LimbOptions lenient;
    lenient.slenderness = 0.2;
    std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), lenient);
    complete_limbs(graph, solid.surface, solid.hierarchy, tips, lenient, 0.01);
    const auto at = graph.incidence();
    std::vector<Vector3> ends;
    for (Index h = 2; h < graph.hub_count(); ++h)
      if (at[h].size() == 1) ends.push_back(graph.hub_position[h]);
    INFO(name << ", " << ends.size() << " ends");
    CHECK_FALSE(ends.empty());
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) CHECK((ends[i] - ends[j]).norm() > 1e-3);
  }
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
  CHECK(aim_at_tips(graph, solid.hierarchy, tips, 0.01) == 3);
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

TEST_CASE("Ends grow along a capsule up to the wanted distance before its tips") {
  SampleOptions options;
  options.resolution = 600;
  const Solid solid(to_mesh(make_sample("capsule", options)));  // radius 1, tips at z = ±4
  ArcGraph graph;
  graph.add_hub(solid.at({0, 0, -1.5}));
  graph.add_hub(solid.at({0, 0, 1.5}));
  line(graph, 0, 1);
  map_to_nearest(graph, solid.surface.position);
  for (const double clearance : {0.2, 0.5, 1.0}) {
    ArcGraph grown = graph;
    ExtensionOptions extension;
    extension.tip_clearance = clearance;
    extend_ends(grown, solid.hierarchy, extension);
    CHECK(crossings(grown, solid.hierarchy) == 0);
    for (Index h = 0; h < 2; ++h) {
      const Vector3 end = solid.model(grown.hub_position[h]);
      CHECK(std::abs(end.z()) == Approx(4 - clearance).margin(0.15));
      CHECK(std::hypot(end.x(), end.y()) < 0.05);
    }
  }
  ArcGraph kept = graph;
  ExtensionOptions none;
  none.max_length = 0;
  extend_ends(kept, solid.hierarchy, none);
  CHECK(kept.hub_position == graph.hub_position);
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
