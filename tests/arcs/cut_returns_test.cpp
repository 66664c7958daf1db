// What an arc does between two points of one ball goes, unless it goes round a handle.
#include "mspskel/arcs/cut_returns.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mspskel/collapse/volume_cocycles.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// One arc through the corners, in steps of 0.05 of the model.
ArcGraph arc_through(const Solid& solid, const std::vector<Vector3>& corners) {
  ArcGraph graph;
  graph.add_hub(solid.at(corners.front()));
  graph.add_hub(solid.at(corners.back()));
  std::vector<Vector3> between;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Vector3 way = corners[k + 1] - corners[k];
    const int steps = static_cast<int>(std::ceil(way.norm() / 0.05));
    for (int i = k == 0 ? 1 : 0; i < steps; ++i) between.push_back(solid.at(corners[k] + way * i / steps));
  }
  add_arc(graph, 0, 1, between);
  map_to_nearest(graph, solid.surface.position);
  return graph;
}

double length(const Solid& solid, const ArcGraph& graph) {
  const std::vector<Vector3>& points = graph.arcs[0].points;
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += (solid.model(points[i]) - solid.model(points[i - 1])).norm();
  return sum;
}

}  // namespace

TEST_CASE("A detour within a ball gives way to its chord, wherever it is on the arc") {
  const Solid bar(tube(1, 8, 32, 40));
  const std::vector<std::vector<Vector3>> detours{
      {{0, 0, 1}, {0, 0, 4}, {0, 0.6, 4}, {0, 0.6, 3.5}, {0, -0.1, 3.5}, {0, -0.1, 4.1}, {0, 0, 7}},
      {{0, 0, 1}, {0, 0, 1.6}, {0, 0.5, 1.6}, {0, 0.5, 1}, {0, 0.1, 1}, {0, 0, 7}},
      {{0, 0, 1}, {0, 0, 7.1}, {0, 0.5, 7.1}, {0, 0.5, 6.5}, {0, 0.1, 6.5}, {0, 0, 7}}};
  for (const auto& corners : detours) {
    ArcGraph graph = arc_through(bar, corners);
    const GraphType type = type_of(graph);
    REQUIRE(length(bar, graph) > 7.3);
    CHECK(cut_returns(graph, bar.hierarchy) == 1);
    CHECK(length(bar, graph) < 6.7);
    CHECK(type_of(graph) == type);
    CHECK(arcs_meet_hubs(graph));
    CHECK(crossings(graph, bar.hierarchy) == 0);
    CHECK(cut_returns(graph, bar.hierarchy) == 0);
  }
}

TEST_CASE("An arc that comes back before its end ends where it was farthest") {
  const Solid bar(tube(1, 8, 32, 40));
  std::vector<Vector3> corners{{0, 0, 2}, {0, 0, 7}, {0, 0.1, 7}, {0, 0.1, 4}};
  for (const bool back : {false, true}) {
    if (back) std::reverse(corners.begin(), corners.end());
    ArcGraph graph = arc_through(bar, corners);
    CHECK(cut_returns(graph, bar.hierarchy) == 1);
    CHECK(arcs_meet_hubs(graph));
    CHECK(length(bar, graph) == Approx(5).margin(0.2));
    const Vector3 first = bar.model(graph.hub_position[0]), last = bar.model(graph.hub_position[1]);
    CHECK((back ? first : last).z() == Approx(7).margin(0.1));
    CHECK((back ? last : first).z() == 2);
  }
  // At its other end where another arc ends, too.
  ArcGraph graph = arc_through(bar, {{0, 0, 2}, {0, 0, 7}, {0, 0.1, 7}, {0, 0.1, 4}});
  const Index joint = 1, tip = graph.add_hub(bar.at({0, 0.8, 4}));
  add_arc(graph, joint, tip, {});
  const Vector3 before = graph.hub_position[joint];
  CHECK(cut_returns(graph, bar.hierarchy) == 1);
  CHECK(graph.hub_position[joint] == before);
  CHECK(bar.model(graph.hub_position[0]).z() == Approx(7).margin(0.1));
  CHECK(length(bar, graph) == Approx(3).margin(0.2));
}

TEST_CASE("Bends of bars stay, a full turn too") {
  const Solid bar(tube(1, 8, 32, 40));
  ArcGraph zigzag = arc_through(bar, {{0, 0, 1}, {0, 0.4, 2}, {0, -0.4, 3}, {0, 0.4, 4}, {0, 0, 7}});
  const auto before = zigzag.arcs[0].points;
  CHECK(cut_returns(zigzag, bar.hierarchy) == 0);
  CHECK(zigzag.arcs[0].points == before);

  // Two legs side by side: their middles are more than a ball's radius apart.
  BallGraph hairpin;
  hairpin.blend = 0.02;
  hairpin.nodes = {{{0, 0, 0}, 0.4}, {{4, 0, 0}, 0.4}, {{4, 1.1, 0}, 0.4}, {{0, 1.1, 0}, 0.4}};
  hairpin.edges = {{0, 1}, {1, 2}, {2, 3}};
  const Solid solid(to_mesh(skin_graph(hairpin, 6000)));
  ArcGraph turn = arc_through(solid, {{0, 0, 0}, {4, 0, 0}, {4, 1.1, 0}, {0, 1.1, 0}});
  CHECK(cut_returns(turn, solid.hierarchy) == 0);
}

TEST_CASE("What goes round a handle stays") {
  const Solid ring(torus(2, 0.5, 64, 24));
  std::vector<Vector3> circle;
  for (int i = 0; i <= 60; ++i) {
    const double angle = 0.1 + (2 * kPi - 0.2) * i / 60;
    circle.push_back({2 * std::cos(angle), 2 * std::sin(angle), 0.0});
  }
  const CrossingLabels labels(compute_volume_cocycles(ring.surface));
  ArcGraph graph = arc_through(ring, circle);
  CHECK(cut_returns(graph, ring.hierarchy, {}, labels) == 0);
  CHECK(length(ring, graph) > 12);
  // Without labels nobody knows of the handle, and only a cycle tells of it.
  CHECK(cut_returns(graph, ring.hierarchy) == 1);
  ArcGraph cycle = arc_through(ring, circle);
  add_arc(cycle, 1, 0, {ring.at({2, 0, 0})});
  CHECK(cut_returns(cycle, ring.hierarchy) == 0);
  CHECK(cut_returns(cycle, ring.hierarchy, {}, labels) == 0);
}
