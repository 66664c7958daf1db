#include "mspskel/center/planar_region.h"

#include <catch2/catch.hpp>

#include "center/planar_shapes.h"

using namespace mspskel;
using namespace mspskel::test;

TEST_CASE("area, perimeter and centroids of known shapes") {
  PlanarRegion region(rectangle(4, 1, 5));
  CHECK(region.area() == Approx(4));
  CHECK(region.perimeter() == Approx(10));
  CHECK(region.roundness() == Approx(4 * kPi * 4 / 100));
  CHECK(region.centroid().norm() < 1e-12);
  CHECK(region.contour_centroid().norm() < 1e-12);

  region.add_hole(ellipse(0.25, 0.25, 40, {1, 0}));
  const double hole = 20 * 0.0625 * std::sin(2 * kPi / 40);
  CHECK(region.area() == Approx(4 - hole));
  CHECK(region.centroid().x() == Approx(-hole / (4 - hole)));
  CHECK(region.perimeter() == Approx(10));

  const PlanarRegion u(u_shape());
  CHECK(u.area() == Approx(10));
  CHECK(u.centroid().x() == Approx(2));
  CHECK(u.centroid().y() == Approx((4 * 0.5 + 2 * 3 * 2.5) / 10));
}

TEST_CASE("a region does not depend on the orientation that its polygons come in") {
  Polygon outer = u_shape(), hole = ellipse(0.2, 0.1, 17, {0.5, 0.5});
  const PlanarRegion region(outer, {hole});
  std::reverse(outer.begin() + 1, outer.end());
  std::reverse(hole.begin() + 1, hole.end());
  const PlanarRegion reversed(outer, {hole});
  CHECK(reversed.area() == Approx(region.area()));
  CHECK(reversed.rings()[0].area > 0);
  CHECK(reversed.rings()[1].area < 0);
  for (Index ring : {0, 1}) {
    const auto a = region.sample(ring, 12), b = reversed.sample(ring, 12);
    REQUIRE(a.size() == 12);
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK((a[i].point - b[i].point).norm() < 1e-12);
      CHECK((a[i].inward - b[i].inward).norm() < 1e-12);
    }
  }
}

TEST_CASE("samples lie on the contour and point into the material") {
  const PlanarRegion region(u_shape(), {ellipse(0.2, 0.1, 17, {0.5, 0.5})});
  for (Index ring : {0, 1})
    for (const auto& s : region.sample(ring, 50)) {
      CHECK(region.distance(s.point) < 1e-12);
      CHECK(region.contains(s.point + 1e-6 * s.inward));
      CHECK_FALSE(region.contains(s.point - 1e-6 * s.inward));
    }
}

TEST_CASE("containment, distance and first hit with holes and repeated points") {
  Polygon outer = rectangle(4, 4, 3);
  outer.insert(outer.begin() + 4, outer[4]);
  const PlanarRegion region(outer, {rectangle(1, 1, 2)});
  CHECK(region.contains({1, 0}));
  CHECK(region.contains({1, 0.5}));  // level with a corner of the hole
  CHECK_FALSE(region.contains({0, 0}));
  CHECK_FALSE(region.contains({3, 0.5}));
  CHECK(region.distance({1, 0.1}) == Approx(0.5));
  CHECK(region.distance({1.5, 1.5}) == Approx(0.5));
  CHECK(region.first_hit({1, 0}, {-1, 0}) == Approx(0.5));
  CHECK(region.first_hit({1, 0}, {2, 0}) == Approx(0.5));
  CHECK(region.first_hit({1, 0}, {0.9, 0}) == 2);
  CHECK(region.first_hit({1.5, -1.5}, {0, 1}) == 2);
}

TEST_CASE("resampling keeps short rings and the shape of long ones") {
  const PlanarRegion region(ellipse(2, 1, 500), {rectangle(0.5, 0.5, 2)});
  const PlanarRegion coarse = region.resampled(64);
  CHECK(coarse.rings()[0].points == 64);
  CHECK(coarse.rings()[1].points == 8);
  CHECK(coarse.area() == Approx(region.area()).epsilon(0.01));
}

TEST_CASE("degenerate polygons are told apart") {
  CHECK_FALSE(PlanarRegion().valid());
  CHECK_FALSE(PlanarRegion(Polygon{{1, 1}}).valid());
  CHECK_FALSE(PlanarRegion(Polygon{{1, 1}, {1, 1}, {1, 1}}).valid());
  CHECK_FALSE(PlanarRegion(Polygon{{0, 0}, {1, 0}}).valid());
  CHECK(PlanarRegion(Polygon{{0, 0}, {1, 0}, {0, 1}}).valid());
}

TEST_CASE("flattening and lifting are inverse") {
  const Vector3 normal = Vector3(1, 2, -2) / 3, u = Vector3(2, 1, 2) / 3, v = normal.cross(u);
  std::vector<Vector3> points;
  for (const Vector2& q : u_shape()) points.push_back(Vector3(5, 6, 7) + q.x() * u + q.y() * v);
  const PlaneFrame frame = make_plane_frame(points, normal);
  const auto flat = flatten(points, frame);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK((frame.to_space(flat[i]) - points[i]).norm() < 1e-12);
  CHECK(PlanarRegion(flat).area() == Approx(10));
  CHECK(frame.u.cross(frame.v).dot(normal) == Approx(1));
}
