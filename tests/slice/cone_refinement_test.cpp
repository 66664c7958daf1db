// The cone of Eq. 3.3 and 3.4, and what refinement may and may not do.
#include "mspskel/slice/cone_refinement.h"

#include <catch2/catch.hpp>

#include "mspskel/slice/detail/cone_directions.h"
#include "mspskel/slice/slice_error.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {
VertexFrame any_frame() {
  const SurfaceSnapshot s = make_snapshot(jittered(octahedron(), 4, 0.15));
  return make_vertex_frame(s, 2);
}
}  // namespace

TEST_CASE("cone directions are unit vectors that fill the cone and stay in it") {
  const VertexFrame frame = any_frame();
  for (const double half_angle : {0.1, 25 * kPi / 180, 55 * kPi / 180, 1.5}) {
    for (double x = 0; x <= 1; x += 0.125)
      for (double y = 0; y < 1; y += 0.125) {
        const Vector3 d = detail::cone_direction(frame, half_angle, x, y);
        CHECK(d.norm() == Approx(1.0));
        const double angle = std::acos(std::min(1.0, d.dot(frame.normal)));
        CHECK(angle <= half_angle + 1e-7);
        // Equal steps of ξx are equal steps of area on the sphere.
        CHECK(1 - std::cos(angle) == Approx(x * (1 - std::cos(half_angle))).margin(1e-12));
      }
    const Vector3 a = detail::cone_direction(frame, half_angle, 1.0, 0.0),
                  b = detail::cone_direction(frame, half_angle, 1.0, 0.25),
                  c = detail::cone_direction(frame, half_angle, 1.0, 0.5);
    CHECK(std::acos(a.dot(frame.normal)) == Approx(half_angle));
    CHECK((a + c - 2 * std::cos(half_angle) * frame.normal).norm() < 1e-12);
    CHECK((a - c).dot(b) == Approx(0).margin(1e-12));
  }
}

TEST_CASE("the whole sphere of Eq. 3.3 comes back with a half angle of 180 degrees") {
  const VertexFrame frame = any_frame();
  for (const double x : {0.1, 0.5, 0.9}) {
    const Vector3 d = detail::cone_direction(frame, kPi, x, 0.3);
    CHECK(std::acos(d.dot(frame.normal)) == Approx(2 * std::acos(std::sqrt(1 - x))));
  }
}

TEST_CASE("the half angle is linear in the error from the threshold to 1") {
  const ConeOptions options;
  const double degree = kPi / 180;
  CHECK(detail::cone_half_angle(options, 0.25) == Approx(25 * degree));
  CHECK(detail::cone_half_angle(options, 0.625) == Approx(40 * degree));
  CHECK(detail::cone_half_angle(options, 1.0) == Approx(55 * degree));
  ConeOptions last = options;
  last.threshold = 1.0;
  CHECK(detail::cone_half_angle(last, 1.0) == Approx(55 * degree));
}

TEST_CASE("the pattern fills both coordinates, and the seed only turns it about the normal") {
  ConeOptions one, two;
  two.seed = 99;
  const auto a = detail::cone_pattern(one), b = detail::cone_pattern(two);
  REQUIRE(a.size() == 15);
  const double turn = b[0].second - a[0].second;
  CHECK(std::abs(turn) > 1e-6);
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].first > 0);
    CHECK(a[i].first < 1);
    CHECK(a[i].second >= 0);
    CHECK(a[i].second < 1);
    CHECK(b[i].first == a[i].first);
    const double difference = b[i].second - a[i].second - turn;
    CHECK(std::abs(difference - std::round(difference)) < 1e-12);
  }
  // No sixth of the turn is left without a direction.
  for (int sector = 0; sector < 6; ++sector)
    CHECK(std::any_of(a.begin(), a.end(), [&](const auto& d) { return int(d.second * 6) == sector; }));
}

TEST_CASE("refinement only shortens, only above the threshold, and counts its work") {
  const SurfaceSnapshot s = make_snapshot(jittered(tube(1.0, 4.0, 16, 10), 2, 0.15));
  const SliceTracer tracer(s);
  VertexSlices before = compute_minimum_slice_perimeters(tracer, {});
  compute_slice_errors(tracer, {}, before);
  VertexSlices after = before;
  const ConeOptions options;
  refine_slices(tracer, {}, options, after);
  Index refined = 0, shorter = 0;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    CHECK((after.refined[v] != 0) == (before.error[v] > options.threshold));
    CHECK(after.perimeter[v] <= before.perimeter[v]);
    if (!after.refined[v]) CHECK(after.normal[v] == before.normal[v]);
    refined += after.refined[v];
    shorter += after.perimeter[v] < before.perimeter[v];
    // A plane of the cone's widest direction leans that far at most.
    const double tilt = std::asin(std::min(1.0, std::abs(after.normal[v].dot(s.normal[v]))));
    CHECK(tilt <= detail::cone_half_angle(options, before.error[v]) + 1e-9);
  }
  CHECK(refined > 0);
  CHECK(shorter > 0);
  // 15 directions of 25 planes, and the old slice once more.
  CHECK(after.slices - before.slices == refined * (15 * 25 + 1));
  CHECK(after.steps > before.steps);
}

TEST_CASE("at threshold 1 nothing is refined") {
  const SurfaceSnapshot s = make_snapshot(torus(1.0, 0.5, 24, 12));
  const SliceTracer tracer(s);
  VertexSlices slices = compute_minimum_slice_perimeters(tracer, {});
  compute_slice_errors(tracer, {}, slices);
  const std::int64_t before = slices.slices;
  ConeOptions options;
  options.threshold = 1.0;
  refine_slices(tracer, {}, options, slices);
  CHECK(slices.slices == before);
}

TEST_CASE("cone options are checked and named") {
  const auto refused = [](auto change, const char* name) {
    ConeOptions options;
    change(options);
    CHECK_THROWS_AS(validate(options), UsageError);
    CHECK_THROWS_WITH(validate(options), Catch::Contains(name));
  };
  CHECK_NOTHROW(validate(ConeOptions()));
  refused([](ConeOptions& o) { o.threshold = -0.1; }, "threshold");
  refused([](ConeOptions& o) { o.threshold = std::nan(""); }, "threshold");
  refused([](ConeOptions& o) { o.min_angle = -1; }, "angles");
  refused([](ConeOptions& o) { o.min_angle = 60; }, "angles");
  refused([](ConeOptions& o) { o.max_angle = 90; }, "angles");
  refused([](ConeOptions& o) { o.directions = 0; }, "directions");
  refused([](ConeOptions& o) { o.directions = 1001; }, "directions");
}
