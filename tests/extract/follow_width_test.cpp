// The thinnest width that surfaces and limbs follow is a property of the shape.
#include "mspskel/pipeline/detail/follow_width.h"

#include <catch2/catch.hpp>
#include <random>

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

TEST_CASE(
    "A surface that crosses itself all over asks for no vertices, and one that does in places asks for "
    "them") {
  // The corners of a ball, dealt out anew.
  PolygonSoup ball = to_soup(sphere(160));
  std::mt19937 random(5);
  std::shuffle(ball.points.begin(), ball.points.end(), random);
  CHECK(demand_of(to_mesh(ball)).vertices == 0);

  // A long tube that turns back by three quarters of a circle and goes through its own beginning.
  DefaultMesh crossed = test::tube(0.2, 12, 16, 60);
  for (const auto v : crossed.vertices()) {
    const Vector3 x = to_vector3(crossed.point(v));
    Vector3 on_axis(0, 0, 0);
    double turn = 0;
    constexpr double kStep = 0.001;
    for (double along = 0; along < x.z(); along += kStep) {
      turn = 1.5 * kPi * std::clamp((along - 4) / 4, 0.0, 1.0);
      on_axis += kStep * Vector3(std::sin(turn), 0, std::cos(turn));
    }
    const Vector3 moved =
        on_axis + x.x() * Vector3(std::cos(turn), 0, -std::sin(turn)) + Vector3(0, x.y(), 0);
    crossed.set_point(v, {moved.x(), moved.y(), moved.z()});
  }
  CHECK(demand_of(crossed).vertices > 0);
}
