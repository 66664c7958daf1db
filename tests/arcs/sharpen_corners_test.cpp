// Rounded arcs get the corners of the solid; what bends gradually keeps its bend.
#include "mspskel/arcs/sharpen_corners.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// A round bar with a right-angled corner at (4, 0, 0).
BallGraph elbow_bar() {
  BallGraph graph;
  graph.blend = 0.02;
  graph.nodes = {{{0, 0, 0}, 0.4}, {{4, 0, 0}, 0.4}, {{4, 4, 0}, 0.4}};
  graph.edges = {{0, 1}, {1, 2}};
  return graph;
}

// From the middle of the elbow's one end to that of the other, cutting the corner by `cut`.
ArcGraph cut_arc(const Solid& solid, double cut) {
  ArcGraph graph;
  graph.add_hub(solid.at({0, 0, 0}));
  graph.add_hub(solid.at({4, 4, 0}));
  std::vector<Vector3> between;
  const auto add_line = [&](const Vector3& from, const Vector3& to) {
    const int steps = static_cast<int>(std::ceil((to - from).norm() / 0.05));
    for (int i = 0; i < steps; ++i) between.push_back(solid.at(from + (to - from) * i / steps));
  };
  add_line({0.05, 0, 0}, {4 - cut, 0, 0});
  add_line({4 - cut, 0, 0}, {4, cut, 0});
  add_line({4, cut, 0}, {4, 3.95, 0});
  add_arc(graph, 0, 1, between);
  map_to_nearest(graph, solid.surface.position);
  return graph;
}

double distance_to(const Solid& solid, const ArcGraph& graph, const Vector3& corner) {
  double least = 1e9;
  for (const Vector3& x : graph.arcs[0].points) least = std::min(least, (solid.model(x) - corner).norm());
  return least;
}

}  // namespace

TEST_CASE("An arc that cuts the corner of an elbow gets the corner") {
  const Solid solid(to_mesh(skin_graph(elbow_bar(), 6000)));
  for (const double cut : {0.7, 0.75}) {
    CAPTURE(cut);
    ArcGraph graph = cut_arc(solid, cut);
    REQUIRE(crossings(graph, solid.hierarchy) == 0);
    const GraphType type = type_of(graph);
    CHECK(distance_to(solid, graph, {4, 0, 0}) > 0.3);
    CHECK(sharpen_corners(graph, solid.hierarchy) == 1);
    CHECK(distance_to(solid, graph, {4, 0, 0}) < 0.1);
    CHECK(type_of(graph) == type);
    CHECK(arcs_meet_hubs(graph));
    CHECK(crossings(graph, solid.hierarchy) == 0);
    // A corner is no longer off the middle.
    ArcGraph again = graph;
    CHECK(sharpen_corners(again, solid.hierarchy) == 0);
    CHECK(again.arcs[0].points == graph.arcs[0].points);
  }
}

TEST_CASE("Arcs in the middle stay, straight or bent") {
  const Solid elbow(to_mesh(skin_graph(elbow_bar(), 6000)));
  ArcGraph corner = cut_arc(elbow, 1e-3);
  CHECK(sharpen_corners(corner, elbow.hierarchy) == 0);

  const Solid ring(torus(2, 0.5, 64, 24));
  ArcGraph graph;
  graph.add_hub(ring.at({2, 0, 0}));
  std::vector<Vector3> between;
  for (int i = 1; i < 120; ++i) {
    const double angle = 2 * kPi * i / 120;
    between.push_back(ring.at({2 * std::cos(angle), 2 * std::sin(angle), 0}));
  }
  add_arc(graph, 0, 0, between);
  CHECK(sharpen_corners(graph, ring.hierarchy) == 0);
}

TEST_CASE("Corners do not depend on the number of threads") {
  const DefaultMesh mesh = to_mesh(skin_graph(elbow_bar(), 6000));
  const Solid solid(mesh);
  ArcGraph one = cut_arc(solid, 0.7), four = one;
  sharpen_corners(one, solid.hierarchy, {1, {}});
  sharpen_corners(four, solid.hierarchy, {4, {}});
  CHECK(one.arcs[0].points == four.arcs[0].points);
}
