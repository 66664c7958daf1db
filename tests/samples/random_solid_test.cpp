// The generator of random meshes that other tests rely on.
#include "support/random_solid.h"

#include <catch2/catch.hpp>
#include <set>

using namespace mspskel;
using namespace mspskel::test;

TEST_CASE("random solids are connected, closed, outward, of many genera and of the wanted size") {
  std::set<Index> genera;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    INFO("seed " << seed);
    const DefaultMesh mesh = random_solid(seed);
    const SurfaceSnapshot s = make_snapshot(mesh);
    CHECK(s.component_count == 1);
    CHECK(signed_volume(mesh) > 0);
    CHECK(s.vertex_count() > 250);
    CHECK(s.vertex_count() < 4000);
    genera.insert(1 - (s.vertex_count() - s.face_count() / 2) / 2);
  }
  CHECK(genera.size() >= 4);
}

TEST_CASE("a random solid depends on its seed alone") {
  const PolygonSoup a = to_soup(random_solid(5)), b = to_soup(random_solid(5)), c = to_soup(random_solid(6));
  CHECK(a.points == b.points);
  CHECK(a.corners == b.corners);
  CHECK(a.corners != c.corners);
}
