// Every sample is a closed manifold of the topology that its description states.
#include "mspskel/samples/samples.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <set>

#include "mspskel/base/error.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/self_intersection.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {
double area(const SurfaceSnapshot& s) {
  return std::accumulate(s.vertex_area.begin(), s.vertex_area.end(), 0.0) * s.frame.scale * s.frame.scale;
}

bool same_bytes(const PolygonSoup& a, const PolygonSoup& b) {
  return a.points.size() == b.points.size() && a.corners == b.corners && a.begin == b.begin &&
         std::memcmp(a.points.data(), b.points.data(), a.points.size() * sizeof(Vector3)) == 0;
}
}  // namespace

TEST_CASE("each sample is embedded, with the topology, orientation and resolution that it promises") {
  for (const SampleInfo& info : list_samples()) {
    for (const Index resolution :
         {info.least_resolution, std::min(info.resolution, 2 * info.least_resolution)}) {
      INFO(info.name << " " << resolution);
      SampleOptions options;
      options.resolution = resolution;
      const DefaultMesh mesh = to_mesh(make_sample(info.name, options));
      const SurfaceSnapshot s = make_snapshot(mesh);
      CHECK(s.component_count == info.components);
      CHECK(s.vertex_count() - s.halfedge_count() / 2 + s.face_count() == 2 * (info.components - info.genus));
      CHECK(signed_volume(mesh) > 0);
      CHECK(s.vertex_count() < 1.5 * resolution + 50);
      CHECK(s.vertex_count() > 0.75 * resolution - 20);
      CHECK(count_self_intersections(s, BoundingVolumeHierarchy(s), 1) == 0);
      for (Index v = 0; v < s.vertex_count(); ++v) REQUIRE(s.vertex_halfedge[v] != kNone);
    }
  }
}

TEST_CASE("samples are the same bytes each time and differ with the seed") {
  for (const char* name : {"sphere", "prism", "torus", "trefoil", "chain", "plate", "y-tube"}) {
    INFO(name);
    SampleOptions options;
    options.jitter = 0.1;
    options.resolution = describe_sample(name).least_resolution;
    const PolygonSoup first = make_sample(name, options);
    CHECK(same_bytes(first, make_sample(name, options)));
    options.seed = 2;
    CHECK_FALSE(same_bytes(first, make_sample(name, options)));
  }
}

TEST_CASE("the count sets the genus and the number of pieces") {
  SampleOptions options;
  for (const Index holes : {0, 1, 7, 30}) {
    options = {};
    options.count = holes;
    const SampleInfo info = describe_sample("plate", options);
    CHECK(info.genus == holes);
    options.resolution = info.least_resolution;
    const SurfaceSnapshot s = make_snapshot(to_mesh(make_sample("plate", options)));
    CHECK(s.vertex_count() - s.face_count() / 2 == 2 - 2 * holes);
  }
  options = {};
  options.count = 4;
  CHECK(make_snapshot(to_mesh(make_sample("chain", options))).component_count == 4);
  CHECK(describe_sample("chain-mail", options).components == 40);
}

TEST_CASE("the surface of a cavity looks into the cavity") {
  const DefaultMesh mesh = to_mesh(make_sample("shell"));
  CHECK(signed_volume(mesh) == Approx(4 * kPi / 3 * (1 - 0.216)).epsilon(0.02));
}

TEST_CASE("volume and area of round samples approach the formulas") {
  const auto check = [](const char* name, double volume, double surface) {
    INFO(name);
    SampleOptions options;
    options.resolution = 6000;
    const DefaultMesh mesh = to_mesh(make_sample(name, options));
    CHECK(signed_volume(mesh) == Approx(volume).epsilon(0.01));
    CHECK(area(make_snapshot(mesh)) == Approx(surface).epsilon(0.01));
  };
  check("sphere", 4 * kPi / 3, 4 * kPi);
  check("capsule", 4 * kPi / 3 + 6 * kPi, 4 * kPi + 12 * kPi);
  check("tube", 8 * kPi, 18 * kPi);
  check("torus", 2 * kPi * kPi * 0.09, 4 * kPi * kPi * 0.3);
  check("prism", 8 * 1.5 * std::sqrt(3.0), 48 + 3 * std::sqrt(3.0));
}

TEST_CASE("a bad name or value is a usage error that names what is near") {
  CHECK_THROWS_WITH(make_sample("spere"), Catch::Contains("sphere"));
  SampleOptions options;
  options.resolution = 3;
  CHECK_THROWS_AS(make_sample("sphere", options), UsageError);
  options = {};
  options.jitter = -1;
  CHECK_THROWS_AS(make_sample("sphere", options), UsageError);
  options = {};
  options.ratio = 1.5;
  CHECK_THROWS_AS(make_sample("torus", options), UsageError);
  options = {};
  options.count = 3;
  CHECK_THROWS_AS(make_sample("torus", options), UsageError);
}

TEST_CASE("the test meshes are closed and renumbering keeps the surface") {
  for (const DefaultMesh& mesh : {tetrahedron(), octahedron(), cube(), prism(5, 2, 4), tube(1, 5, 12, 10),
                                  sphere(300), saddle(3, 24, 6), y_tube(400)}) {
    CHECK(make_snapshot(mesh).component_count == 1);
    CHECK(signed_volume(mesh) > 0);
    CHECK(signed_volume(renumbered(mesh, 3)) == Approx(signed_volume(mesh)));
  }
  const SurfaceSnapshot t = make_snapshot(torus(1, 0.4, 30, 12));
  CHECK(t.vertex_count() - t.halfedge_count() / 2 + t.face_count() == 0);
}

TEST_CASE("extreme ratios do not make a sample intersect itself") {
  for (const char* name : {"torus", "trefoil", "figure-eight", "chain", "borromean-rings", "bowl", "plate"})
    for (const bool most : {false, true}) {
      const SampleInfo info = describe_sample(name);
      SampleOptions options;
      options.ratio = most ? info.most_ratio : info.least_ratio;
      options.resolution = info.least_resolution;
      INFO(name << " ratio " << options.ratio);
      const SurfaceSnapshot s = make_snapshot(to_mesh(make_sample(name, options)));
      CHECK(count_self_intersections(s, BoundingVolumeHierarchy(s), 1) == 0);
    }
}
