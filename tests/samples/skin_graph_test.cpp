// Solids round graphs, and the mesher under them.
#include "mspskel/samples/skin_graph.h"

#include <catch2/catch.hpp>

#include "mspskel/base/error.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

TEST_CASE("a round cone is as far as its nearest ball") {
  const BallNode a{{0, 0, 0}, 1}, b{{3, 1, 0}, 0.4};
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = 4 * random.in_ball();
    double nearest = 1e300;
    for (int k = 0; k <= 4000; ++k) {
      const double t = k / 4000.0;
      nearest = std::min(
          nearest, (p - (1 - t) * a.position - t * b.position).norm() - (1 - t) * a.radius - t * b.radius);
    }
    CHECK(round_cone_distance(p, a, b) == Approx(nearest).margin(1e-4));
  }
}

TEST_CASE("marching tetrahedra closes the surface of any function, also one without a surface") {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    ImplicitSolid solid;
    solid.low = Vector3::Constant(-1);
    solid.high = Vector3::Constant(1);
    const std::uint64_t seed = random.next();
    // Values without any continuity at the scale of the cell; near 0, so that no cube is skipped.
    solid.value = [seed](const Vector3& p) {
      Random value(seed +
                   static_cast<std::uint64_t>(1000003 * p.x() + 10007 * p.y() + 101 * p.z() + 5000000));
      return p.norm() > 1 ? 0.01 : value.uniform(-0.01, 0.01);
    };
    const PolygonSoup soup = march_tetrahedra(solid, 0.3);
    REQUIRE(soup.polygon_count() > 100);
    CHECK_NOTHROW(make_snapshot(to_mesh(soup)));
  }
  ImplicitSolid nothing;
  nothing.high = Vector3::Ones();
  nothing.value = [](const Vector3&) { return 1.0; };
  CHECK(march_tetrahedra(nothing, 0.1).points.empty());
  CHECK_THROWS_AS(polygonise(nothing, 100, 0.1), UsageError);
}

TEST_CASE("the mesh of a ball lies on the ball and has good triangles") {
  ImplicitSolid ball;
  ball.low = Vector3::Constant(-1);
  ball.high = Vector3::Constant(1);
  ball.value = [](const Vector3& p) { return p.norm() - 1; };
  const PolygonSoup soup = polygonise(ball, 1000, 0.5);
  CHECK(soup.points.size() == Approx(1000).epsilon(0.15));
  for (const Vector3& p : soup.points) REQUIRE(p.norm() == Approx(1).margin(1e-4));
  double least_angle = kPi;
  for (std::size_t c = 0; c < soup.corners.size(); ++c) {
    const std::size_t first = c - c % 3;
    const Vector3& p = soup.points[soup.corners[c]];
    const Vector3 a = soup.points[soup.corners[first + (c + 1) % 3]] - p,
                  b = soup.points[soup.corners[first + (c + 2) % 3]] - p;
    least_angle = std::min(least_angle, std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  CHECK(least_angle > 20 * kPi / 180);
}

TEST_CASE("the skin of a graph has one handle for each of its loops") {
  BallGraph graph;
  graph.nodes = {
      {{0, 0, 0}, 0.2}, {{2, 0, 0}, 0.2}, {{2, 2, 0.1}, 0.25}, {{0, 2, 0}, 0.2}, {{1, 1, 1.5}, 0.2}};
  graph.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
  const SurfaceSnapshot s = make_snapshot(to_mesh(skin_graph(graph, 1500)));
  CHECK(s.vertex_count() - s.face_count() / 2 == 2 - 2 * 4);
  CHECK(s.component_count == 1);
}
