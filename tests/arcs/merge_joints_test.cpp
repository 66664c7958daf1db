// Joints within one another's ball become one, and no others.
#include "mspskel/arcs/merge_joints.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

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
