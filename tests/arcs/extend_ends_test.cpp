// Ends grow up to the wanted distance before the surface.
#include "mspskel/arcs/extend_ends.h"

#include <catch2/catch.hpp>

#include "mspskel/arcs/center_arcs.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

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
