// Centring what a change moves, and nothing else.
#include "mspskel/refine/detail/center_part.h"

#include <catch2/catch.hpp>

#include "mspskel/refine/prune_branches.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Six arcs one after the other along a tube of radius 1 round the z axis, beside that axis; the hubs from 0
// to 6 and the arcs from 0 to 5 in their order.
ArcGraph row_of_arcs(const Solid& solid) {
  ArcGraph graph;
  for (Index h = 0; h < 7; ++h) graph.add_hub(solid.at({0.4, 0.2, 2.0 + 3 * h}));
  for (Index a = 0; a < 6; ++a) line(graph, a, a + 1);
  map_to_nearest(graph, solid.surface.position);
  return graph;
}

}  // namespace

TEST_CASE("A change moves the arcs that meet it, and those that meet them") {
  const Solid solid(tube(1, 22, 24, 24));
  const ArcGraph before = row_of_arcs(solid);
  CHECK(detail::arcs_near_changes(before, before) == std::vector<bool>(6, false));

  ArcGraph moved = before;
  moved.arcs[0].points[1] += Vector3(0.001, 0, 0);
  CHECK(detail::arcs_near_changes(before, moved) == std::vector<bool>{true, true, true, false, false, false});

  ArcGraph shorter = before;
  shorter.arcs[5].alive = false;
  CHECK(detail::arcs_near_changes(before, shorter) ==
        std::vector<bool>{false, false, false, true, true, false});

  ArcGraph longer = before;
  longer.add_hub(solid.at({0, 0, 0.5}));
  line(longer, 0, 7);
  CHECK(detail::arcs_near_changes(before, longer) ==
        std::vector<bool>{true, true, false, false, false, false, true});

  ArcGraph joined = before;
  dissolve_through_hubs(joined);
  CHECK(living_arcs(joined) == 1);
  const std::vector<bool> near = detail::arcs_near_changes(before, joined);
  for (std::size_t a = 0; a < near.size(); ++a) CHECK(near[a] == joined.arcs[a].alive);
}

TEST_CASE("A part comes to the axis of a tube while the other arcs stay") {
  const Solid solid(tube(1, 22, 24, 24));
  const ArcGraph before = row_of_arcs(solid);
  ArcGraph graph = before;
  CenteringOptions options;
  options.rounds = 30;
  detail::center_part(graph, {true, true, true, false, false, false}, solid.hierarchy, options, {}, {}, {0});
  REQUIRE(arcs_meet_hubs(graph));
  CHECK(map_is_partition(graph));
  CHECK(type_of(graph) == type_of(before));
  CHECK(graph.hub_position[0] == before.hub_position[0]);
  for (std::size_t a = 3; a < 6; ++a) CHECK(graph.arcs[a].points == before.arcs[a].points);
  for (Index h = 3; h < 7; ++h) CHECK(graph.hub_position[h] == before.hub_position[h]);
  for (const Vector3& p : graph.arcs[1].points) {
    const Vector3 x = solid.surface.frame.to_model(p);
    CHECK(std::hypot(x.x(), x.y()) < 0.02);
  }
}
