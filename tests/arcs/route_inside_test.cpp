// Arcs and hubs outside the solid move inside, into their own limb.
#include "mspskel/arcs/route_inside.h"

#include <array>
#include <catch2/catch.hpp>
#include <type_traits>

#include "mspskel/arcs/detail/hub_components.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"
#include "mspskel/solid/detail/inner_graph.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

// Paths of any surface are no way to the vertices of the one that a graph's map is of.
static_assert(!std::is_convertible_v<mspskel::detail::InnerPaths&, mspskel::detail::InnerGraph&>);

TEST_CASE("A map of another surface's vertices is refused before anything is read from it") {
  const Solid coarse(sphere(200)), fine(sphere(800));
  ArcGraph graph;
  graph.add_hub(Vector3(2, 0, 0));  // outside
  graph.arc_of_vertex.assign(coarse.surface.position.size(), kNone);
  graph.hub_of_vertex.assign(coarse.surface.position.size(), 0);
  CHECK_THROWS_WITH(route_inside(graph, fine.hierarchy, fine.surface),
                    Catch::Contains("the graph's map is of"));
  CHECK(route_inside(graph, coarse.hierarchy, coarse.surface).hubs_moved == 1);
}

TEST_CASE("Every hub of a piece that stands for some vertex has that vertex's component") {
  const Solid solid(sphere(200));
  ArcGraph graph;
  for (int i = 0; i < 5; ++i) graph.add_hub(Vector3(0.1 * i, 0, 0));
  // The vertices stand for hub 2; hubs 0 and 1 hang on it, hubs 3 and 4 are a piece without vertices.
  for (const auto& [from, to] : {std::array<Index, 2>{0, 1}, {1, 2}, {3, 4}}) {
    Arc arc;
    arc.hub = {from, to};
    arc.points = {graph.hub_position[from], graph.hub_position[to]};
    graph.arcs.push_back(arc);
  }
  graph.arc_of_vertex.assign(solid.surface.position.size(), kNone);
  graph.hub_of_vertex.assign(solid.surface.position.size(), 2);
  CHECK(mspskel::detail::hub_components(graph, solid.surface) == std::vector<Index>{0, 0, 0, kNone, kNone});
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
