#include "mspskel/center/skeletal_point.h"

#include <catch2/catch.hpp>

#include "center/planar_shapes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

SkeletalPointOptions with(SkeletalPointMethod method) {
  SkeletalPointOptions options;
  options.method = method;
  return options;
}

const auto kForces = {SkeletalPointMethod::kSampledForce, SkeletalPointMethod::kClosedForm};
const auto kInsideMethods = {SkeletalPointMethod::kSampledForce, SkeletalPointMethod::kClosedForm,
                             SkeletalPointMethod::kAreaField, SkeletalPointMethod::kVisibleField,
                             SkeletalPointMethod::kNearestValley};
const auto kAll = {SkeletalPointMethod::kCentre,       SkeletalPointMethod::kSampledForce,
                   SkeletalPointMethod::kClosedForm,   SkeletalPointMethod::kAreaField,
                   SkeletalPointMethod::kVisibleField, SkeletalPointMethod::kNearestValley};

}  // namespace

TEST_CASE("symmetric polygons have their skeletal point at the centre") {
  const std::vector<Polygon> shapes = {ellipse(1, 1, 5), ellipse(1, 1, 64), ellipse(2, 1, 100),
                                       rectangle(1, 1, 8), rectangle(2, 1, 7)};
  for (const Polygon& shape : shapes)
    for (auto method : kAll) {
      // A 2:1 rectangle has a valley along its middle line already.
      if (method == SkeletalPointMethod::kNearestValley && shape.size() == 28) continue;
      const PlanarRegion region(transformed(shape, 1, 0.3, {5, -2}));
      const SkeletalPoint point = find_skeletal_point(region, with(method));
      CAPTURE(shape.size(), static_cast<int>(method), point.position.transpose());
      // The sampled force stops at a finite step, as printed; 64 rays do not divide by 5.
      const double tolerance = method == SkeletalPointMethod::kSampledForce   ? 0.01
                               : method == SkeletalPointMethod::kVisibleField ? 1e-3
                                                                              : 1e-4;
      CHECK((point.position - Vector2(5, -2)).norm() < tolerance * region.perimeter());
    }
}

TEST_CASE("a long slice has a repulsive minimum near each end, its area field one zero in the middle") {
  // Far along a channel the walls balance; near an end the walls beyond it are missing, until the end itself
  // repels.
  const PlanarRegion region(rectangle(4, 1, 7));
  const SkeletalPoint repulsive = find_skeletal_point(region);
  CHECK(repulsive.minima == 2);
  CHECK(std::abs(repulsive.position.x()) > 1);
  CHECK(std::abs(repulsive.position.y()) < 1e-4);
  CHECK(find_skeletal_point(region, with(SkeletalPointMethod::kAreaField)).position.norm() < 1e-4);
}

TEST_CASE("a closed-form skeletal point is a minimum of the potential") {
  for (const Polygon& shape :
       {u_shape(), crescent(0.1, 4, 80), dumbbell(0.6, 0.2, 60), ellipse(3, 0.4, 50)}) {
    const PlanarRegion region(shape);
    const SkeletalPoint point = find_skeletal_point(region);
    REQUIRE(point.stop == SkeletalPointStop::kConverged);
    const double unit = region.perimeter();
    const FieldValue f = repulsive_field(region, point.position);
    CHECK(f.xx * f.yy - f.xy * f.xy > 0);
    for (Index k = 0; k < 16; ++k) {
      const double t = 2 * kPi * k / 16;
      const Vector2 p = point.position + 1e-3 * unit * Vector2(std::cos(t), std::sin(t));
      CHECK(repulsive_field(region, p).potential > f.potential);
    }
  }
}

TEST_CASE("skeletal points lie inside the material of concave slices") {
  std::vector<Polygon> shapes = {u_shape()};
  for (double thickness : {0.3, 0.1, 0.03, 0.01, 0.003, 0.001})
    for (double angle : {2.0, 4.0, 6.0}) shapes.push_back(crescent(thickness, angle, 100));
  for (const Polygon& shape : shapes) {
    const PlanarRegion region(shape);
    for (auto method : kInsideMethods) {
      const SkeletalPoint point = find_skeletal_point(region, with(method));
      CAPTURE(static_cast<int>(method), point.position.transpose(), region.area(),
              static_cast<int>(point.stop));
      CHECK(region.contains(point.position));
    }
    const SkeletalPoint point = find_skeletal_point(region);
    CHECK(point.stop == SkeletalPointStop::kConverged);
    // In the middle of the strip: as far from the contour as a strip of this area allows, to a fifth.
    CHECK(region.distance(point.position) > 0.8 * region.area() / region.perimeter());
  }
  CHECK_FALSE(PlanarRegion(u_shape()).contains(
      find_skeletal_point(PlanarRegion(u_shape()), with(SkeletalPointMethod::kCentre)).position));
}

TEST_CASE("samples that slip out between two force samples do not count") {
  // Steps that halve the distance to the contour, or more, get down to rounding.
  for (const Polygon& shape :
       {rectangle(1, 1, 1), rectangle(3, 1, 1), ellipse(1, 1, 3), ellipse(2, 1, 5), u_shape()})
    for (const Index force_samples : {3, 8, 16})
      for (const double step : {0.25, 0.6, 0.9}) {
        SkeletalPointOptions options = with(SkeletalPointMethod::kSampledForce);
        options.step = step;
        options.force_samples = force_samples;
        options.moving_samples = 7;
        const PlanarRegion region(shape);
        const SkeletalPoint point = find_skeletal_point(region, options);
        CAPTURE(force_samples, step, static_cast<int>(point.stop), point.position.transpose());
        CHECK(region.contains(point.position));
      }
}

TEST_CASE("holes repel") {
  for (double offset : {0.0, 0.3}) {
    const PlanarRegion region(ellipse(2, 2, 90), {ellipse(0.5, 0.5, 40, {offset, 0})});
    for (auto method : kForces) {
      const SkeletalPoint point = find_skeletal_point(region, with(method));
      CAPTURE(static_cast<int>(method), point.position.transpose());
      CHECK(region.contains(point.position));
      CHECK(point.position.norm() > 0.5 + std::abs(offset));
      CHECK(region.distance(point.position) > 0.4);
    }
  }
}

TEST_CASE("the nearest valley of a ring lies in the middle of the wall beside the first contour point") {
  for (double turn : {0.0, 1.0, 2.5}) {
    const PlanarRegion region(transformed(ellipse(2, 2, 90), 1, turn, {0, 0}), {ellipse(1.6, 1.6, 70)});
    const SkeletalPoint point = find_skeletal_point(region, with(SkeletalPointMethod::kNearestValley));
    CHECK(point.stop == SkeletalPointStop::kConverged);
    CHECK((point.position - 1.8 * region.point(0).normalized()).norm() <
          0.1 * 0.4);  // curvature shifts it a little
  }
  const PlanarRegion disc(ellipse(1.2, 1, 40));
  CHECK(find_skeletal_point(disc, with(SkeletalPointMethod::kNearestValley)).position.norm() < 1e-4);
}

TEST_CASE("fields of filled regions stay well inside rings and thin strips") {
  for (auto method : {SkeletalPointMethod::kAreaField, SkeletalPointMethod::kVisibleField})
    for (const PlanarRegion& region : {PlanarRegion(ellipse(2, 2, 90), {ellipse(1.6, 1.6, 70)}),
                                       PlanarRegion(crescent(0.05, 5, 90)), PlanarRegion(uneven_u_shape())}) {
      const SkeletalPoint point = find_skeletal_point(region, with(method));
      CHECK(region.contains(point.position));
      CHECK(region.distance(point.position) > 0.2 * region.mean_width());
    }
}

TEST_CASE("the vote picks the lobe with more contour") {
  const PlanarRegion region(dumbbell(0.5, 0.1, 80, 1.8));
  for (auto method : kForces) {
    SkeletalPointOptions options = with(method);
    options.starts = 32;
    const SkeletalPoint point = find_skeletal_point(region, options);
    CAPTURE(static_cast<int>(method));
    CHECK(point.position.norm() < 0.5);
    CHECK(point.minima >= 2);
    CHECK(point.votes > 1);
  }
  // The other way round in storage makes no difference.
  Polygon turned = dumbbell(0.5, 0.1, 80, 1.8);
  std::rotate(turned.begin(), turned.begin() + 100, turned.end());
  CHECK(find_skeletal_point(PlanarRegion(turned)).position.norm() < 0.5);
}

TEST_CASE("a decided vote needs no more samples, and more samples do not change it") {
  const PlanarRegion region(ellipse(1.5, 1, 60));
  SkeletalPointOptions many;
  many.starts = 64;
  const SkeletalPoint few = find_skeletal_point(region), all = find_skeletal_point(region, many);
  CHECK(few.samples < 8);
  CHECK((few.position - all.position).norm() < 1e-6);
}

TEST_CASE("skeletal points turn, move and scale with the slice") {
  for (const Polygon& shape :
       {uneven_u_shape(), crescent(0.2, 4, 60), dumbbell(0.6, 0.2, 60), ellipse(2, 1, 33)}) {
    for (auto method : kAll) {
      const SkeletalPoint base = find_skeletal_point(PlanarRegion(shape), with(method));
      for (double scale : {1e-6, 1.0, 1e5}) {
        const double turn = 2.2;
        const Vector2 shift = scale * Vector2(3, -7);
        const SkeletalPoint moved =
            find_skeletal_point(PlanarRegion(transformed(shape, scale, turn, shift)), with(method));
        const Vector2 expected = transformed({base.position}, scale, turn, shift)[0];
        CAPTURE(static_cast<int>(method), scale);
        CHECK((moved.position - expected).norm() < 1e-5 * scale);
      }
    }
  }
}

TEST_CASE("a region cut out on the other side of the plane has the same skeletal point") {
  Polygon shape = dumbbell(0.7, 0.2, 60);
  const SkeletalPoint base = find_skeletal_point(PlanarRegion(shape));
  for (Vector2& p : shape) p.y() = -p.y();
  const SkeletalPoint mirrored = find_skeletal_point(PlanarRegion(shape));
  CHECK((Vector2(base.position.x(), -base.position.y()) - mirrored.position).norm() < 1e-6);
}

TEST_CASE("resampled descents end at the whole contour's minimum") {
  const PlanarRegion region(dumbbell(0.5, 0.2, 300));
  SkeletalPointOptions screened;
  screened.max_segments = 48;
  const SkeletalPoint a = find_skeletal_point(region), b = find_skeletal_point(region, screened);
  CHECK((a.position - b.position).norm() < 1e-5);
}

TEST_CASE(
    "the area field's centre of a disc with an off-centre bulge lies nearer the disc than the centroid") {
  const PlanarRegion region(dumbbell(0.3, 0.1, 80));
  const SkeletalPoint point = find_skeletal_point(region, with(SkeletalPointMethod::kAreaField));
  CHECK(point.stop == SkeletalPointStop::kConverged);
  CHECK(area_field(region, point.position).force.norm() < 1e-6);
  CHECK(point.position.norm() < region.centroid().norm());
}

TEST_CASE("regions without an inside give the contour's centre and say so") {
  for (auto method : kInsideMethods) {
    for (const Polygon& shape :
         {Polygon{}, Polygon{{1, 2}}, Polygon{{1, 2}, {1, 2}, {1, 2}}, Polygon{{0, 0}, {1, 0}}}) {
      const SkeletalPoint point = find_skeletal_point(PlanarRegion(shape), with(method));
      CHECK(point.stop == SkeletalPointStop::kDegenerate);
      CHECK(point.position.allFinite());
    }
  }
}

TEST_CASE("an option out of range is named") {
  const auto fails = [](auto set, const std::string& name) {
    SkeletalPointOptions options;
    set(options);
    try {
      find_skeletal_point(PlanarRegion(rectangle(1, 1, 2)), options);
      FAIL("accepted");
    } catch (const UsageError& e) {
      CHECK(std::string(e.what()).find(name) != std::string::npos);
    }
  };
  fails([](SkeletalPointOptions& o) { o.moving_samples = 0; }, "moving_samples");
  fails([](SkeletalPointOptions& o) { o.force_samples = 2; }, "force_samples");
  fails([](SkeletalPointOptions& o) { o.displacement = 0; }, "displacement");
  fails([](SkeletalPointOptions& o) { o.step = 1; }, "step");
  fails([](SkeletalPointOptions& o) { o.merge_radius = -1; }, "merge_radius");
  fails([](SkeletalPointOptions& o) { o.starts = 0; }, "starts");
  fails([](SkeletalPointOptions& o) { o.max_segments = 3; }, "max_segments");
  fails([](SkeletalPointOptions& o) { o.rays = 1; }, "rays");
  fails([](SkeletalPointOptions& o) { o.tolerance = std::nan(""); }, "tolerance");
  fails([](SkeletalPointOptions& o) { o.max_iterations = 0; }, "max_iterations");
}
