// The thinnest width that surfaces and limbs follow is a property of the shape.
#include "mspskel/pipeline/detail/follow_width.h"

#include <catch2/catch.hpp>

#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

detail::WidthDemand demand_of(const DefaultMesh& mesh) {
  const Solid solid(mesh);
  return detail::demand_of_width(solid.surface, solid.hierarchy, {});
}

}  // namespace

TEST_CASE("The demand of width turns with the model") {
  for (const char* name : {"octoped", "quadruped", "airway"}) {
    CAPTURE(name);
    const DefaultMesh mesh = sample(name, 4000);
    const detail::WidthDemand demand = demand_of(mesh);
    REQUIRE(demand.thinnest > 0);
    for (const double angle : {0.4, 1.3, 2.9}) {
      const detail::WidthDemand turned = demand_of(rotated(mesh, {0.3, -0.8, 0.5}, angle));
      CHECK(turned.thinnest == Approx(demand.thinnest).epsilon(1e-6));
      CHECK(turned.vertices == Approx(demand.vertices).epsilon(1e-6));
    }
  }
}

TEST_CASE("The thinnest of a tube's widths is its radius, with noise and with more vertices") {
  // A tube of radius 0.2 that is 12 long: its extent is the distance of its ends.
  for (const Index segments : {16, 32, 64}) {
    const DefaultMesh tube = test::tube(0.2, 12, segments, 30 * segments / 16);
    for (const double noise : {0.0, 0.1}) {
      const DefaultMesh mesh = noise > 0 ? jittered(tube, 7, noise) : tube;
      const Solid solid(mesh);
      const double thinnest =
          detail::demand_of_width(solid.surface, solid.hierarchy, {}).thinnest * solid.surface.frame.scale;
      CHECK(thinnest == Approx(0.2).epsilon(0.1));
    }
  }
}
