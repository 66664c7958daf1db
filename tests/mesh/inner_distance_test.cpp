// Distances through the solid: straight where that is free, never shorter, and even along the surface.
#include "mspskel/mesh/inner_distance.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/samples.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

SurfaceSnapshot sample(const std::string& name) { return make_snapshot(to_mesh(make_sample(name, {}))); }

// Halfway through the solid from vertex 0.
Vector3 beneath_first_vertex(const SurfaceSnapshot& s, const BoundingVolumeHierarchy& solid) {
  const Vector3 inward = -s.normal[0];
  const auto hit = solid.first_hit(s.position[0] + 1e-6 * inward, inward);
  REQUIRE(hit);
  return s.position[0] + 0.5 * hit->distance * inward;
}

}  // namespace

TEST_CASE("In a ball every way from inside is straight") {
  const SurfaceSnapshot s = sample("sphere");
  const BoundingVolumeHierarchy solid(s);
  const Vector3 from(0.1, -0.05, 0.02);
  const std::vector<double> distance = inner_distances(s, SurfaceWays(s), solid, {from});
  for (Index v = 0; v < s.vertex_count(); ++v)
    CHECK(distance[v] == Approx((s.position[v] - from).norm()).epsilon(1e-12));
}

TEST_CASE("Inner distances are no shorter than the straight way and grow no faster than an edge is long") {
  for (const std::string name : {"torus", "y-tube", "octoped"}) {
    const SurfaceSnapshot s = sample(name);
    const BoundingVolumeHierarchy solid(s);
    const Vector3 from = beneath_first_vertex(s, solid);
    const std::vector<double> distance = inner_distances(s, SurfaceWays(s), solid, {from});
    for (Index v = 0; v < s.vertex_count(); ++v) {
      INFO(name << ", vertex " << v);
      CHECK(distance[v] >= (s.position[v] - from).norm() * (1 - 1e-12));
      for_each_neighbour(s, v, [&](Index w) {
        CHECK(distance[w] <= distance[v] + (s.position[w] - s.position[v]).norm() * (1 + 1e-12));
      });
    }
  }
}

TEST_CASE("Along a prism ways cross faces") {
  // Unrolled, the side of a prism is flat; ways along edges alone are up to 1.41 times too long on a grid.
  const SurfaceSnapshot s = make_snapshot(prism(24, 3.0, 12));
  Index from = 0, low = 0;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    if (s.position[v].z() < s.position[low].z()) low = v;
    if (s.position[v].head<2>().norm() > s.position[from].head<2>().norm() + 1e-9) from = v;
  }
  for (Index v = 0; v < s.vertex_count(); ++v)
    if (s.position[v].head<2>().norm() > s.position[from].head<2>().norm() - 1e-9 &&
        s.position[v].z() < s.position[from].z())
      from = v;
  std::vector<double> distance(s.position.size(), std::numeric_limits<double>::infinity());
  distance[from] = 0;
  SurfaceWays(s).extend(std::vector<std::uint8_t>(s.position.size(), 0), distance);
  const double radius = s.position[from].head<2>().norm();
  const auto angle = [&](Index v) { return std::atan2(s.position[v].y(), s.position[v].x()); };
  double longest = 1;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    if (s.position[v].head<2>().norm() < 0.99 * radius || v == from) continue;
    const double round = std::abs(std::remainder(angle(v) - angle(from), 2 * kPi));
    if (round > 1.5) continue;  // there the end of the prism may be a shorter way
    const double chords = 24 / kPi * std::sin(kPi / 24) * round * radius;
    const double straight = std::hypot(chords, s.position[v].z() - s.position[from].z());
    if (s.position[v].z() - s.position[from].z() < 2 * chords) continue;
    CHECK(distance[v] >= straight * (1 - 1e-9));
    longest = std::max(longest, distance[v] / straight);
  }
  CHECK(longest < 1.1);
}

TEST_CASE("A component without a point is out of reach") {
  const SurfaceSnapshot s = sample("hopf-link");
  REQUIRE(s.component_count > 1);
  const BoundingVolumeHierarchy solid(s);
  std::vector<std::optional<Vector3>> from(static_cast<std::size_t>(s.component_count));
  const Vector3 inward = -s.normal[0];
  const auto hit = solid.first_hit(s.position[0] + 1e-6 * inward, inward);
  REQUIRE(hit);
  from[s.component[0]] = s.position[0] + 0.5 * hit->distance * inward;
  const std::vector<double> distance = inner_distances(s, SurfaceWays(s), solid, from);
  for (Index v = 0; v < s.vertex_count(); ++v)
    CHECK(std::isfinite(distance[v]) == (s.component[v] == s.component[0]));
}

TEST_CASE("Distances to some vertices only are those of the whole where no way leaves them") {
  const SurfaceSnapshot s = sample("octoped");
  const BoundingVolumeHierarchy solid(s);
  const Vector3 from = beneath_first_vertex(s, solid);
  const std::vector<double> whole = inner_distances(s, SurfaceWays(s), solid, {from});
  const double other = -std::numeric_limits<double>::infinity();
  std::vector<double> local(whole.size(), other);
  std::vector<Index> all, near;
  for (Index v = 0; v < s.vertex_count(); ++v) {
    all.push_back(v);
    if ((s.position[v] - from).norm() < 0.25) near.push_back(v);
  }
  inner_distances(s, solid, from, near, local);
  REQUIRE(near.size() < all.size());
  for (const Index v : near) CHECK(local[v] >= whole[v] * (1 - 1e-12));
  CHECK(std::count(local.begin(), local.end(), other) ==
        static_cast<std::ptrdiff_t>(all.size() - near.size()));
  inner_distances(s, solid, from, all, local);
  for (const Index v : all) CHECK(local[v] == Approx(whole[v]).epsilon(1e-12));
}
