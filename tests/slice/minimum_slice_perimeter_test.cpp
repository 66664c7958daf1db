// The MSP function on shapes with known slices, its laws, and how its stages report and stop.
#include "mspskel/slice/minimum_slice_perimeter.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <thread>

#include "mspskel/slice/cone_refinement.h"
#include "mspskel/slice/plane_search.h"
#include "mspskel/slice/slice_error.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

VertexSlices sampled(const SurfaceSnapshot& s, const Execution& execution = {}) {
  return compute_minimum_slice_perimeters(SliceTracer(s), {}, execution);
}

// Everything that thesis mode does to slices.
VertexSlices refined(const SurfaceSnapshot& s, const Execution& execution = {}) {
  const SliceTracer tracer(s);
  VertexSlices slices = compute_minimum_slice_perimeters(tracer, {}, execution);
  compute_slice_errors(tracer, {}, slices, execution);
  refine_slices(tracer, {}, {}, slices, execution);
  compute_slice_errors(tracer, {}, slices, execution);
  return slices;
}

VertexSlices searched(const SurfaceSnapshot& s, const Execution& execution = {}) {
  const SliceTracer tracer(s);
  VertexSlices slices = search_minimum_slice_perimeters(tracer, {}, execution);
  compute_slice_errors(tracer, {}, slices, execution);
  return slices;
}

using Stage = VertexSlices (*)(const SurfaceSnapshot&, const Execution&);

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// Vertices of a body from z = 0 to `length` that are further from its ends than `margin`.
template <class Check>
void on_body(const SurfaceSnapshot& s, double length, double margin, Check&& check) {
  for (Index v = 0; v < s.vertex_count(); ++v) {
    const double z = s.frame.to_model(s.position[v]).z();
    if (z > margin && z < length - margin) check(v);
  }
}

// A ball with a concentric cavity: the cavity's wall has no slice that bounds material.
DefaultMesh hollow_ball() {
  Tessellation t;
  t.edge = 0.25;
  PolygonSoup ball = make_sphere(1.0, t), cavity = make_sphere(0.5, t);
  reverse_orientation(cavity);
  append(ball, cavity);
  return to_mesh(ball);
}

}  // namespace

TEST_CASE("MSP of a prism's body is its cross-section, within 1 % at 20 levels of 6 corners") {
  const SurfaceSnapshot s = make_snapshot(prism(6, 10.0, 20));
  const VertexSlices slices = sampled(s);
  on_body(s, 10.0, 2.4, [&](Index v) {
    const double perimeter = slices.perimeter[v] * s.frame.scale, exact = 12 * std::sin(kPi / 6);
    CHECK(perimeter > exact * (1 - 1e-9));
    CHECK(perimeter < exact * 1.01);
  });
}

TEST_CASE("MSP of a tube's body is its circle and its slice error small, at 48 x 40 vertices") {
  const SurfaceSnapshot s = make_snapshot(tube(1.0, 10.0, 48, 40));
  const SliceTracer tracer(s);
  // N planes miss the cross-section by up to a right angle / N, and two slices by up to twice that.
  for (const int planes : {25, 50}) {
    SamplingOptions options;
    options.planes = planes;
    VertexSlices slices = compute_minimum_slice_perimeters(tracer, options);
    compute_slice_errors(tracer, {}, slices);
    double sum = 0, most = 0;
    Index count = 0;
    on_body(s, 10.0, 2.5, [&](Index v) {
      CHECK(slices.perimeter[v] * s.frame.scale == Approx(2 * kPi).epsilon(0.01));
      const Vector3 centre = s.frame.to_model(slices.centre[v]);
      CHECK(std::hypot(centre.x(), centre.y()) < 0.02);
      sum += slices.error[v];
      most = std::max(most, slices.error[v]);
      ++count;
    });
    REQUIRE(count > 500);
    CHECK(sum / count <= 0.04);
    CHECK(most <= 2.0 / planes);
    if (planes == 50) CHECK(most <= 0.04);
  }
}

TEST_CASE("MSP of a sphere is its great circle, within 1 % at 2,500 vertices") {
  const SurfaceSnapshot s = make_snapshot(sphere(2500));
  const VertexSlices slices = sampled(s);
  for (Index v = 0; v < s.vertex_count(); ++v)
    CHECK(slices.perimeter[v] * s.frame.scale == Approx(2 * kPi).epsilon(0.01));
}

TEST_CASE("on a fat torus no slice is the hole's circle") {
  // The hole's circle measures 2π · 0.4, the tube 2π · 0.6: without the test for material it would win.
  const SurfaceSnapshot s = make_snapshot(torus(1.0, 0.6, 30, 18));
  const SliceTracer tracer(s);
  const Stage stage = GENERATE(refined, searched);
  const VertexSlices slices = stage(s, {});
  Contour contour;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    REQUIRE(slice_contour(tracer, slices, v, contour));
    CHECK(contour.area > 0);
    double turn = 0;  // round the torus's axis
    for (std::size_t i = 0; i < contour.point.size(); ++i) {
      const Vector3 a = s.frame.to_model(contour.point[i]),
                    b = s.frame.to_model(contour.point[(i + 1) % contour.point.size()]);
      turn += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    }
    CHECK(std::abs(turn) < 1);
  }
}

TEST_CASE("the stored slice is what its contour says") {
  const SurfaceSnapshot s = make_snapshot(jittered(torus(1.0, 0.5, 20, 12), 2, 0.15));
  const SliceTracer tracer(s);
  const Stage stage = GENERATE(refined, searched);
  const VertexSlices slices = stage(s, {});
  Contour contour;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    REQUIRE(slice_contour(tracer, slices, v, contour));
    CHECK(slices.perimeter[v] == Approx(contour.perimeter).epsilon(1e-12));
    CHECK(slices.contour_points[v] == static_cast<Index>(contour.point.size()));
    CHECK(slices.normal[v].norm() == Approx(1.0));
    CHECK(std::abs(slices.normal[v].dot(slices.centre[v] - s.position[v])) < 1e-12);
  }
}

TEST_CASE("a vertex without a slice has the documented values and does not touch the others") {
  const DefaultMesh hollow = hollow_ball();
  const SurfaceSnapshot s = make_snapshot(hollow);
  REQUIRE(s.component_count == 2);
  const Stage stage = GENERATE(refined, searched);
  VertexSlices slices = stage(s, {});
  Index without = 0;
  const auto check_values = [&] {
    for (Index v = 0; v < s.vertex_count(); ++v) {
      if (s.component[v] == s.component[0]) {
        CHECK(slices.valid[v]);
        continue;
      }
      ++without;
      CHECK_FALSE(slices.valid[v]);
      CHECK(slices.perimeter[v] == 0);
      CHECK(slices.normal[v].isZero(0));
      CHECK(slices.centre[v].isZero(0));
      CHECK(slices.error[v] == 1);
      CHECK(slices.contour_points[v] == 0);
    }
  };
  check_values();
  CHECK(without > 20);
  // E_min and E_max are those of the vertices with a slice.
  compute_slice_errors(SliceTracer(s), {SliceErrorAverage::kMean, SliceErrorScale::kMinMax}, slices);
  check_values();
  double low = 1, high = 0;
  for (Index v = 0; v < s.vertex_count(); ++v)
    if (slices.valid[v]) {
      low = std::min(low, slices.error[v]);
      high = std::max(high, slices.error[v]);
    }
  CHECK(low == 0);
  CHECK(high == 1);
}

TEST_CASE("slices do not depend on position, size, direction or numbering") {
  const DefaultMesh mesh = jittered(torus(1.0, 0.55, 20, 12), 8, 0.2);
  std::vector<Index> place(mesh.n_vertices());
  std::iota(place.begin(), place.end(), 0);
  DefaultMesh changed = mesh;
  SECTION("turned") { changed = rotated(mesh, {1, 2, -3}, 1.234); }
  SECTION("moved") { changed = translated(mesh, {3, -7, 11}); }
  SECTION("scaled") { changed = scaled(mesh, 37.5); }
  SECTION("renumbered") { changed = renumbered(mesh, 5, &place); }
  const SurfaceSnapshot a = make_snapshot(mesh), b = make_snapshot(changed);
  const double ratio = b.frame.scale / a.frame.scale;
  const double size = changed.n_vertices() > 0 && ratio > 10 ? 37.5 : 1.0;
  CHECK(ratio == Approx(size).epsilon(1e-9));
  for (const Stage stage : {Stage(refined), Stage(searched)}) {
    const VertexSlices x = stage(a, {}), y = stage(b, {});
    CHECK(x.slices == y.slices);
    for (Index v = 0; v < a.vertex_count(); ++v) {
      const Index w = place[v];
      CHECK(y.perimeter[w] == Approx(x.perimeter[v]).epsilon(1e-9));
      CHECK(y.error[w] == Approx(x.error[v]).epsilon(1e-6).margin(1e-9));
      CHECK(y.refined[w] == x.refined[v]);
      CHECK(y.contour_points[w] == x.contour_points[v]);
    }
  }
}

TEST_CASE("one thread and two give the same bytes") {
  const SurfaceSnapshot s = make_snapshot(torus(1.0, 0.5, 24, 12));
  const Stage stage = GENERATE(refined, searched);
  Execution one, two;
  one.threads = 1;
  two.threads = 2;
  const VertexSlices x = stage(s, one), y = stage(s, two);
  CHECK(same_bytes(x.perimeter, y.perimeter));
  CHECK(same_bytes(x.normal, y.normal));
  CHECK(same_bytes(x.centre, y.centre));
  CHECK(same_bytes(x.error, y.error));
  CHECK(x.slices == y.slices);
  CHECK(x.steps == y.steps);
}

TEST_CASE("more planes never give a longer slice, where they contain the fewer") {
  const SurfaceSnapshot s = make_snapshot(jittered(torus(1.0, 0.5, 20, 12), 1, 0.2));
  const SliceTracer tracer(s);
  SamplingOptions few, many;
  few.planes = 5;
  many.planes = 25;
  const VertexSlices x = compute_minimum_slice_perimeters(tracer, few),
                     y = compute_minimum_slice_perimeters(tracer, many);
  CHECK(x.slices == 5 * s.vertex_count());
  CHECK(y.slices == 25 * s.vertex_count());
  for (Index v = 0; v < s.vertex_count(); ++v) CHECK(y.perimeter[v] <= x.perimeter[v] * (1 + 1e-12));
}

TEST_CASE("the number of planes is checked and named") {
  for (const int planes : {0, -3, 1001}) {
    SamplingOptions options;
    options.planes = planes;
    CHECK_THROWS_AS(validate(options), UsageError);
    CHECK_THROWS_WITH(validate(options),
                      Catch::Contains("slices") && Catch::Contains(std::to_string(planes)));
  }
}

TEST_CASE("progress comes from the calling thread, grows from 0 and can cancel every stage") {
  const SurfaceSnapshot s = make_snapshot(torus(1.0, 0.5, 24, 12));
  const Stage stage = GENERATE(sampled, refined, searched);
  Execution execution;
  execution.threads = 2;
  const std::thread::id caller = std::this_thread::get_id();
  int calls = 0;
  bool elsewhere = false, outside = false;
  execution.progress = [&](const char* name, double fraction) {
    ++calls;
    elsewhere = elsewhere || std::this_thread::get_id() != caller;
    outside = outside || fraction < 0 || fraction > 1 || name == nullptr;
    return true;
  };
  stage(s, execution);
  CHECK(calls > 0);
  CHECK_FALSE(elsewhere);
  CHECK_FALSE(outside);
  execution.threads = 1;
  calls = 0;
  stage(s, execution);
  const int all = calls;
  REQUIRE(all > 4);
  for (const int last : {1, 2, all / 2}) {
    calls = 0;
    execution.progress = [&](const char*, double) { return ++calls < last; };
    CHECK_THROWS_AS(stage(s, execution), Cancelled);
    CHECK(calls == last);
  }
}

TEST_CASE("a parallel loop stops soon after it is cancelled or a body throws") {
  Execution execution;
  execution.threads = 1;
  int calls = 0;
  execution.progress = [&](const char*, double) { return ++calls < 2; };
  Index bodies = 0;
  const auto state = [] { return 0; };
  CHECK_THROWS_AS(parallel_for(100000, "test", execution, state, [&](Index, int&) { ++bodies; }), Cancelled);
  CHECK(bodies < 100);
  execution.progress = nullptr;
  execution.threads = 2;
  CHECK_THROWS_AS(parallel_for(1000, "test", execution, state,
                               [](Index i, int&) {
                                 if (i == 137) throw MeshError("137");
                               }),
                  MeshError);
}
