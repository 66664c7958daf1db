// Plane search against exhaustive sampling, and its own laws.
#include "mspskel/slice/plane_search.h"

#include <catch2/catch.hpp>

#include "mspskel/samples/samples.h"
#include "mspskel/slice/cone_refinement.h"
#include "mspskel/slice/slice_error.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

DefaultMesh creature() {
  SampleOptions options;
  options.resolution = 2500;
  return to_mesh(make_sample("quadruped", options));
}

// Rough, with flat ends: many vertices whose first slice is a bad one.
DefaultMesh rough_tube() { return jittered(tube(1.0, 4.0, 16, 12), 2, 0.2); }

// 25 planes, and 15 x 25 more where the error is high.
VertexSlices exhaustive(const SliceTracer& tracer) {
  VertexSlices slices = compute_minimum_slice_perimeters(tracer, {});
  const std::int64_t steps = slices.steps;
  compute_slice_errors(tracer, {}, slices);
  slices.steps = steps;  // the search spends none on errors either
  refine_slices(tracer, {}, {}, slices);
  return slices;
}

SearchOptions raw() {
  SearchOptions options;
  options.objective = SliceObjective::kPerimeter;
  return options;
}

}  // namespace

TEST_CASE("search finds what exhaustive sampling finds with a fifth of the steps") {
  const SurfaceSnapshot s = make_snapshot(creature());
  const SliceTracer tracer(s);
  const VertexSlices sampled = exhaustive(tracer), found = search_minimum_slice_perimeters(tracer, raw());
  Index counted = 0, as_short = 0;
  double sum_sampled = 0, sum_found = 0;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    if (!sampled.valid[v]) continue;
    ++counted;
    REQUIRE(found.valid[v]);
    as_short += found.perimeter[v] <= 1.01 * sampled.perimeter[v];
    sum_sampled += sampled.perimeter[v];
    sum_found += found.perimeter[v];
  }
  CHECK(counted == s.vertex_count());
  CHECK(as_short >= 0.95 * counted);
  CHECK(sum_found < sum_sampled);
  CHECK(static_cast<double>(found.steps) <= 0.2 * static_cast<double>(sampled.steps));
}

TEST_CASE("over tilt the slices of a sphere stay great circles, raw they shrink") {
  const SurfaceSnapshot s = make_snapshot(sphere(800));
  const SliceTracer tracer(s);
  const VertexSlices fair = search_minimum_slice_perimeters(tracer, {}),
                     shrunk = search_minimum_slice_perimeters(tracer, raw());
  double mean_fair = 0, mean_shrunk = 0;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    const double tilt = std::asin(std::min(1.0, std::abs(fair.normal[v].dot(s.normal[v]))));
    const double circle = fair.perimeter[v] * s.frame.scale / std::cos(tilt);
    CHECK(circle == Approx(2 * kPi).epsilon(0.03));
    mean_fair += fair.perimeter[v];
    mean_shrunk += shrunk.perimeter[v];
  }
  CHECK(mean_shrunk < mean_fair);
}

TEST_CASE("no slice leans more than the options allow") {
  const SurfaceSnapshot s = make_snapshot(rough_tube());
  const SliceTracer tracer(s);
  SearchOptions options = raw();
  for (const double most : {0.0, 20.0, 55.0}) {
    options.max_tilt = most;
    const VertexSlices slices = search_minimum_slice_perimeters(tracer, options);
    for (Index v = 0; v < s.vertex_count(); ++v)
      CHECK(std::abs(slices.normal[v].dot(s.normal[v])) <= std::sin(most * kPi / 180) + 1e-9);
  }
}

TEST_CASE("rounds only shorten the slices, and without any each vertex has one") {
  const SurfaceSnapshot s = make_snapshot(rough_tube());
  const SliceTracer tracer(s);
  SearchOptions options = raw();
  std::vector<double> last(s.vertex_count(), std::numeric_limits<double>::infinity());
  std::int64_t steps = 0;
  for (const int rounds : {0, 1, 4, 50}) {
    options.rounds = rounds;
    const VertexSlices slices = search_minimum_slice_perimeters(tracer, options);
    for (Index v = 0; v < s.vertex_count(); ++v) {
      CHECK(slices.valid[v]);
      CHECK(slices.perimeter[v] <= last[v]);
      last[v] = slices.perimeter[v];
    }
    CHECK(slices.steps >= steps);
    steps = slices.steps;
  }
}

TEST_CASE("a vertex on which no slice bounds material ends the search without one") {
  Tessellation t;
  t.edge = 0.3;
  PolygonSoup inside_out = make_sphere(1.0, t);
  reverse_orientation(inside_out);
  const SurfaceSnapshot s = make_snapshot(to_mesh(inside_out));
  const VertexSlices slices = search_minimum_slice_perimeters(SliceTracer(s), {});
  CHECK(std::count(slices.valid.begin(), slices.valid.end(), 1) == 0);
  CHECK(slices.slices > 0);
}

TEST_CASE("regular meshes, on which everything ties, are searched too") {
  for (const DefaultMesh& mesh : {octahedron(), cube(), tetrahedron(), prism(4, 3.0, 6)}) {
    const SurfaceSnapshot s = make_snapshot(mesh);
    const VertexSlices slices = search_minimum_slice_perimeters(SliceTracer(s), {});
    CHECK(std::count(slices.valid.begin(), slices.valid.end(), 1) == s.vertex_count());
  }
}

TEST_CASE("search options are checked and named") {
  const auto refused = [](auto change, const char* name) {
    SearchOptions options;
    change(options);
    CHECK_THROWS_AS(validate(options), UsageError);
    CHECK_THROWS_WITH(validate(options), Catch::Contains(name));
  };
  CHECK_NOTHROW(validate(SearchOptions()));
  refused([](SearchOptions& o) { o.angles = 0; }, "angles");
  refused([](SearchOptions& o) { o.spread = -1; }, "spread");
  refused([](SearchOptions& o) { o.rounds = -1; }, "rounds");
  refused([](SearchOptions& o) { o.max_tilt = 90; }, "tilt");
  refused([](SearchOptions& o) { o.max_tilt = std::nan(""); }, "tilt");
  refused([](SearchOptions& o) { o.last_step = 0; }, "steps");
  refused([](SearchOptions& o) { o.first_step = o.last_step / 2; }, "steps");
  refused([](SearchOptions& o) { o.first_step = 91; }, "steps");
}
