// Searches that go toward their goal find what searches in all directions find, and come by less.
#include "mspskel/solid/detail/landmarks.h"

#include <catch2/catch.hpp>
#include <map>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/solid/detail/inner_graph.h"
#include "support/meshes.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A square grid of side * side vertices with random costs, some edges missing.
struct Grid {
  Index side;
  std::map<std::pair<Index, Index>, double> cost;

  Grid(Index size, std::uint64_t seed) : side(size) {
    mspskel::test::Random random(seed);
    for (Index v = 0; v < side * side; ++v)
      for (const Index w : {v % side + 1 < side ? v + 1 : kNone, v + side < side * side ? v + side : kNone})
        if (w != kNone && random.uniform() < 0.9) cost[{v, w}] = cost[{w, v}] = random.uniform(0.5, 1.5);
  }
  template <class Visit>
  void edges(Index v, Visit visit) const {
    for (const Index w : {v - 1, v + 1, v - side, v + side})
      if (const auto it = cost.find({v, w}); it != cost.end()) visit(w, it->second);
  }
  // Costs from one vertex to all.
  std::vector<double> costs(Index from) const {
    std::vector<double> result(static_cast<std::size_t>(side) * side, kInfinity);
    result[from] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [edge, more] : cost)
        if (result[edge.first] + more < result[edge.second]) {
          result[edge.second] = result[edge.first] + more;
          changed = true;
        }
    }
    return result;
  }
};

}  // namespace

TEST_CASE("bounds by landmarks are bounds, fall by no more than edges cost, and lead toward the goal") {
  constexpr Index kSide = 30;
  double all = 0, toward = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Grid grid(kSide, seed);
    detail::Landmarks landmarks;
    CHECK(landmarks.goal(std::vector<Index>{5}).bound(7) == 0);
    landmarks.build(kSide * kSide, kSide * kSide / 2, [&](Index v, auto visit) { grid.edges(v, visit); });
    mspskel::test::Random random(seed);
    for (int k = 0; k < 10; ++k) {
      const Index from = random.below(kSide * kSide), first = random.below(kSide * kSide);
      const std::vector<Index> goals{first, first + 1 < kSide * kSide ? first + 1 : first};
      const auto goal = landmarks.goal(goals);
      const std::vector<double> there = grid.costs(from), a = grid.costs(goals[0]), b = grid.costs(goals[1]);
      const auto rest = [&](Index v) { return std::min(a[v], b[v]); };
      for (Index v = 0; v < kSide * kSide; ++v) {
        REQUIRE(goal.bound(v) <= rest(v) + 1e-9);
        grid.edges(v, [&](Index w, double cost) { REQUIRE(goal.bound(v) <= cost + goal.bound(w) + 1e-9); });
        if (!(rest(from) < kInfinity)) continue;
        all += there[v] <= rest(from) ? 1 : 0;
        toward += there[v] + goal.bound(v) <= rest(from) ? 1 : 0;
      }
    }
  }
  CHECK(toward < 0.35 * all);
}

TEST_CASE("a path inside is the same whether landmarks lead the search or not") {
  mspskel::test::Random random(5);
  VoxelSolid solid;
  solid.add(random_lattice(3, 1.0, random));
  const SurfaceSnapshot surface = snapshot_of(solid, 1);
  const BoundingVolumeHierarchy faces(surface);
  detail::InnerGraph led(surface, faces);
  led.prepare();
  for (int k = 0; k < 40; ++k) {
    const Index from = random.below(surface.vertex_count()), to = random.below(surface.vertex_count());
    if (!led.usable(from) || !led.usable(to)) continue;
    detail::InnerGraph fresh(surface, faces);
    fresh.prepare();
    std::vector<Vector3> one, other;
    REQUIRE(led.path(led.point(from), led.point(to), one) ==
            fresh.path(led.point(from), led.point(to), other));
    CHECK(one == other);
  }
}

TEST_CASE("a path inside is the same from both ends in turn as from one alone") {
  mspskel::test::Random random(6);
  VoxelSolid solid;
  solid.add(random_lattice(3, 1.0, random));
  const SurfaceSnapshot surface = snapshot_of(solid, 1);
  const BoundingVolumeHierarchy faces(surface);
  detail::InnerGraph inner(surface, faces);
  inner.prepare();
  int found = 0;
  for (int k = 0; k < 60; ++k) {
    const Index from = random.below(surface.vertex_count()), to = random.below(surface.vertex_count());
    if (!inner.usable(from) || !inner.usable(to)) continue;
    std::vector<Vector3> both, one;
    const bool is_found = inner.path(inner.point(from), inner.point(to), both);
    CHECK(inner.path(inner.point(from), inner.point(to), one, 2 * surface.vertex_count()) == is_found);
    CHECK(both == one);
    found += is_found;
  }
  CHECK(found > 20);
}
