#include "mspskel/center/planar_region.h"

#include <catch2/catch.hpp>

#include "center/planar_shapes.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// A star with `points` rays of random length.
Polygon random_star(Index points, double size, const Vector2& centre, mspskel::test::Random& random) {
  Polygon p;
  for (Index i = 0; i < points; ++i) {
    const double t = 2 * kPi * i / points, r = size * random.uniform(0.3, 1);
    p.push_back(centre + r * Vector2(std::cos(t), std::sin(t)));
  }
  return p;
}

bool inside_by_all_segments(const PlanarRegion& region, const Vector2& p) {
  bool inside = false;
  for (const PlanarRegion::Ring& ring : region.rings())
    for (Index i = ring.begin; i < ring.begin + ring.points; ++i) {
      const Vector2 a = region.point(i), b = region.point(i + 1);
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if ((cross(a - p, b - p) > 0) == (b.y() > p.y())) inside = !inside;
    }
  return inside;
}

Index segments_asked(const PlanarRegion& region, double y) {
  Index count = 0;
  region.for_each_segment_at(y, [&](Index) { ++count; });
  return count;
}

}  // namespace

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

TEST_CASE("containment is the parity over all segments, however the rings come") {
  mspskel::test::Random random(3);
  PlanarRegion region;
  for (Index round = 0; round < 60; ++round) {
    // Sizes about those at which strips are made, and long flat or steep rings.
    const Vector2 stretch(round % 3 == 1 ? 50 : 1, round % 3 == 2 ? 50 : 1);
    const auto stretched = [&](Polygon p) {
      for (Vector2& q : p) q = q.cwiseProduct(stretch);
      return p;
    };
    region.set_outer(stretched(random_star(3 + random.below(300), 4, {0, 0}, random)));
    const Index holes = random.below(30);
    for (Index k = 0; k < holes; ++k) {
      const double x = random.uniform(-3, 3), y = random.uniform(-3, 3);
      region.add_hole(stretched(random_star(3 + random.below(200), 0.5, {x, y}, random)));
    }
    for (Index k = 0; k < 100; ++k) {
      const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
      const Vector2 p = stretch.cwiseProduct(Vector2(x, y));
      REQUIRE(region.contains(p) == inside_by_all_segments(region, p));
    }
    for (Index k = 0; k < region.rings()[0].points; k += 7) {  // at levels of corners
      const Vector2 p(stretch.x() * random.uniform(-5, 5), region.point(k).y());
      REQUIRE(region.contains(p) == inside_by_all_segments(region, p));
    }
  }
}

TEST_CASE("containment comes by about the segments at a point's level") {
  mspskel::test::Random random(4);
  const auto mean = [&](const PlanarRegion& region) {
    double sum = 0;
    for (Index k = 0; k < 200; ++k) sum += segments_asked(region, random.uniform(-1, 1));
    return sum / 200;
  };
  // Two segments of an ellipse are level with a point, however many there are.
  for (const Index n : {100, 1000, 10000}) CHECK(mean(PlanarRegion(ellipse(2, 1, n))) < 8);
  // A plate with n x n holes: a level meets 2n of them.
  for (const Index n : {10, 20, 40}) {
    PlanarRegion plate(rectangle(2, 2, 4 * n));
    for (Index i = 0; i < n * n; ++i) {
      const Vector2 centre((i % n * 2 + 1.0) / n - 1, (i / n * 2 + 1.0) / n - 1);
      plate.add_hole(ellipse(0.6 / n, 0.6 / n, 16, centre));
    }
    CHECK(mean(plate) < 8 * n);
  }
}

TEST_CASE("rings with levels that are not finite have no strips") {
  Polygon p = ellipse(2, 1, 200);
  p[100].y() = std::numeric_limits<double>::quiet_NaN();
  PlanarRegion region(ellipse(4, 4, 200));
  region.add_hole(p);
  for (const Vector2& q : {Vector2(0, 0.1), Vector2(3, 0.1), Vector2(5, 0.1), Vector2(3, 2)})
    CHECK(region.contains(q) == inside_by_all_segments(region, q));
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
