// Laws of the volume cocycles on solids whose topology is known by construction.
#include "mspskel/collapse/volume_cocycles.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "mspskel/collapse/detail/component_slabs.h"
#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/collapse/label_rank.h"
#include "support/meshes.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

Index total(const std::vector<Index>& x) { return std::accumulate(x.begin(), x.end(), Index{0}); }

// Cup product of two cocycles over the surface: 0 for classes that extend to the solid, since the product
// there bounds. Half-edges 3f, 3f + 1 are the front and the back of the ordered triangle.
std::int64_t cup(const SurfaceSnapshot& s, const VolumeCocycles& c, Index i, Index j) {
  std::int64_t sum = 0;
  for (Index f = 0; f < s.face_count(); ++f) {
    std::array<Index, 3> v{s.origin[3 * f], s.origin[3 * f + 1], s.origin[3 * f + 2]};
    // The half-edges v0 → v1 and v1 → v2 of the corners sorted by index, with the sign of the sorting.
    const Index low = static_cast<Index>(std::min_element(v.begin(), v.end()) - v.begin());
    const bool even = v[(low + 1) % 3] < v[(low + 2) % 3];
    const Index first = even ? 3 * f + low : s.twin[3 * f + (low + 2) % 3];
    const Index second = even ? 3 * f + (low + 1) % 3 : s.twin[3 * f + (low + 1) % 3];
    sum += (even ? 1 : -1) * std::int64_t{c.label[first][i]} * c.label[second][j];
  }
  return sum;
}

CocycleLabel along(const VolumeCocycles& c, const std::vector<Index>& loop) {
  CocycleLabel sum;
  for (const Index h : loop) sum += c.label[h];
  return sum;
}

void check_laws(const SurfaceSnapshot& s, const VolumeCocycles& c, Index genus) {
  REQUIRE(total(c.genus) == genus);
  REQUIRE(c.rank == genus);
  CHECK(c.discs + c.holed_regions + c.linking + c.completions == genus);
  CHECK(c.completions == 0);
  REQUIRE(c.label.size() == s.origin.size());
  bool closed = true, antisymmetric = true;
  for (Index f = 0; f < s.face_count(); ++f)
    closed = closed && (c.label[3 * f] + c.label[3 * f + 1] + c.label[3 * f + 2]).is_zero();
  for (Index h = 0; h < s.halfedge_count(); ++h)
    antisymmetric = antisymmetric && c.label[h] == -c.label[s.twin[h]];
  CHECK(closed);
  CHECK(antisymmetric);
  LabelRank rank;
  for (const auto& generators : detail::homology_generators(s, detail::component_elements(s)))
    for (const auto& loop : generators.loop) rank.insert(along(c, loop));
  CHECK(rank.rank() == genus);
  if (genus <= 12)
    for (Index i = 0; i < genus; ++i)
      for (Index j = 0; j < i; ++j) CHECK(cup(s, c, i, j) == 0);
}

// All sources in turn must span the same space of functions on loops.
void check_sources_agree(const SurfaceSnapshot& s, Index genus) {
  CocycleOptions linking;
  linking.use_discs = linking.use_holed_regions = false;
  const VolumeCocycles by_slices = compute_volume_cocycles(s),
                       by_linking = compute_volume_cocycles(s, {}, linking);
  check_laws(s, by_slices, genus);
  check_laws(s, by_linking, genus);
  CHECK(by_linking.linking == genus);
  // Rows of both, as values on the generator loops: together no larger rank.
  std::vector<CocycleLabel> rows(2 * static_cast<std::size_t>(genus));
  Index column = 0;
  for (const auto& generators : detail::homology_generators(s, detail::component_elements(s)))
    for (const auto& loop : generators.loop) {
      const CocycleLabel a = along(by_slices, loop), b = along(by_linking, loop);
      for (const auto& e : a.entries()) rows[e.index] += CocycleLabel::unit(column, e.value);
      for (const auto& e : b.entries()) rows[genus + e.index] += CocycleLabel::unit(column, e.value);
      ++column;
    }
  LabelRank rank;
  for (const CocycleLabel& row : rows) rank.insert(row);
  CHECK(rank.rank() == genus);
}

// Loops of the torus grid (i, j) -> i · nv + j: along i (round the axis) and along j (round the tube).
CocycleLabel grid_loop(const SurfaceSnapshot& s, const VolumeCocycles& c, Index from,
                       const std::vector<Index>& walk) {
  CocycleLabel sum;
  Index at = from;
  for (const Index to : walk) {
    Index h = s.vertex_halfedge[at];
    while (s.target(h) != to) h = s.next_outgoing(h);
    sum += c.label[h];
    at = to;
  }
  return sum;
}

}  // namespace

TEST_CASE("a torus's label is ±1 round the axis and 0 round the tube, however thin or fat") {
  const double minor = GENERATE(0.02, 0.3, 0.9, 0.97);
  const Index nu = 40, nv = 16;
  const SurfaceSnapshot s = make_snapshot(torus(1.0, minor, nu, nv));
  const bool slices = GENERATE(true, false);
  CocycleOptions options;
  options.use_discs = options.use_holed_regions = slices;
  const VolumeCocycles c = compute_volume_cocycles(s, {}, options);
  check_laws(s, c, 1);
  CHECK((slices ? c.discs : c.linking) == 1);
  std::vector<Index> longitude, meridian;
  for (Index i = 1; i <= nu; ++i) longitude.push_back(i % nu * nv);
  for (Index j = 1; j <= nv; ++j) meridian.push_back(j % nv);
  CHECK(std::abs(grid_loop(s, c, 0, longitude)[0]) == 1);
  CHECK(grid_loop(s, c, 0, meridian).is_zero());
}

TEST_CASE("a surface of genus 0 has rank 0 and no labels") {
  const SurfaceSnapshot s = make_snapshot(sphere(200));
  const VolumeCocycles c = compute_volume_cocycles(s);
  check_laws(s, c, 0);
  CHECK(c.sections == 0);
}

TEST_CASE("slices and linking numbers span the same space on plates of any genus") {
  const Index holes = GENERATE(1, 2, 5, 12);
  VoxelSolid plate;
  plate.box({0, 0, 0}, {2 * holes + 1, 3, 1});
  for (Index i = 0; i < holes; ++i) plate.cells.erase({2 * i + 1, 1, 0});
  check_sources_agree(snapshot_of(plate, 2), holes);
}

TEST_CASE("axis-parallel plates without jitter have a rank equal to their genus") {
  const Index n = GENERATE(1, 3, 8);
  VoxelSolid plate;
  plate.box({0, 0, 0}, {2 * n + 1, 2 * n + 1, 1});
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) plate.cells.erase({2 * i + 1, 2 * j + 1, 0});
  const SurfaceSnapshot s = snapshot_of(boundary(plate, 1));
  const VolumeCocycles c = compute_volume_cocycles(s);
  check_laws(s, c, n * n);
}

TEST_CASE("a knotted tube has a disc across it") {
  const auto [p, q] = GENERATE(std::pair(2, 3), std::pair(2, 5), std::pair(3, 4));
  VoxelSolid tube;
  tube.add(torus_knot(p, q));
  const SurfaceSnapshot s = snapshot_of(tube, 1);
  check_sources_agree(s, 1);
  CHECK(compute_volume_cocycles(s).discs == 1);
}

TEST_CASE("a block with a knotted tunnel has no disc, and is settled all the same") {
  const auto [p, q] = GENERATE(std::pair(2, 3), std::pair(2, 5), std::pair(3, 4));
  const SurfaceSnapshot s = snapshot_of(knotted_tunnel(p, q), 1);
  check_sources_agree(s, 1);
  CHECK(compute_volume_cocycles(s).discs == 0);
}

TEST_CASE("a knotted and a straight tunnel through one block") {
  VoxelSolid block = knotted_tunnel(2, 3);
  block.box({10, -1, -1}, {13, 10, 4});
  block.remove(VoxelSolid::path({{11, 3, -1}, {11, 3, 3}}));
  const SurfaceSnapshot s = snapshot_of(block, 1);
  check_sources_agree(s, 2);
  CHECK(compute_volume_cocycles(s).discs == 1);
}

TEST_CASE("linked rings have one cocycle each, which is zero on the other") {
  VoxelSolid rings;
  rings.add(VoxelSolid::path({{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 0, 0}}));
  rings.add(VoxelSolid::path({{3, 3, -3}, {3, 3, 3}, {3, 9, 3}, {3, 9, -3}, {3, 3, -3}}));
  const SurfaceSnapshot s = snapshot_of(rings, 2);
  REQUIRE(s.component_count == 2);
  check_sources_agree(s, 2);
  const VolumeCocycles c = compute_volume_cocycles(s);
  for (const VolumeCocycle& cocycle : c.cocycle)
    for (const auto& [h, value] : cocycle.values) CHECK(s.component[s.origin[h]] == cocycle.component);
}

TEST_CASE("a cavity is a shell of its own, whichever way it turns") {
  // A ring-shaped cavity in a thick ring, one round cavity in the block beside it.
  VoxelSolid ring;
  ring.box({0, 0, 0}, {9, 9, 3});
  ring.remove(VoxelSolid::path({{1, 1, 1}, {7, 1, 1}, {7, 7, 1}, {1, 7, 1}, {1, 1, 1}}));
  for (int x = 3; x < 6; ++x)
    for (int y = 3; y < 6; ++y)
      for (int z = 0; z < 3; ++z) ring.cells.erase({x, y, z});
  const SurfaceSnapshot s = snapshot_of(ring, 1);
  REQUIRE(s.component_count == 2);
  check_sources_agree(s, 2);
  // Turned inside out as a whole, both solids are the same.
  SurfaceSnapshot turned = snapshot_of(inside_out(to_soup(jittered(to_mesh(boundary(ring, 1)), 1, 0.1))));
  check_sources_agree(turned, 2);
}

TEST_CASE("two handles that almost touch stay two") {
  VoxelSolid solid;
  solid.add(VoxelSolid::path({{0, 0, 0}, {8, 0, 0}}));
  solid.add(VoxelSolid::path({{0, 0, 0}, {0, 0, 4}, {8, 0, 4}, {8, 0, 0}}));
  solid.add(VoxelSolid::path({{2, 0, 0}, {2, 2, 0}, {2, 2, 4}, {2, 2, 8}, {6, 2, 8}, {6, 2, 0}, {6, 0, 0}}));
  PolygonSoup soup = boundary(solid, 2);
  // The upper bar of the first handle bulges until it is within 0.001 of the second.
  for (Vector3& x : soup.points)
    if (x.y() == 1.0 && x.z() >= 4 && x.x() > 1 && x.x() < 7) x.y() = 1.999;
  check_sources_agree(snapshot_of(soup), 2);
}

TEST_CASE("the torus with seven vertices") {
  const SurfaceSnapshot s = snapshot_of(csaszar_torus());
  REQUIRE(s.face_count() == 14);
  check_sources_agree(s, 1);
}

TEST_CASE("random lattices and blocks with random tunnels") {
  Random random(7);
  for (int round = 0; round < 100; ++round) {
    VoxelSolid solid;
    const std::set<Cell> lattice = random_lattice(3, random.uniform(0.3, 0.9), random);
    if (round % 2 == 0) {
      solid.add(lattice);
    } else {
      solid.box({-1, -1, 0}, {6, 6, 5});
      solid.remove(lattice);
    }
    const SurfaceSnapshot s = snapshot_of(solid, 1, 0.1, static_cast<std::uint64_t>(round));
    Index genus = 0;
    for (const auto& component : detail::component_elements(s)) genus += component.genus();
    INFO("round " << round);
    check_sources_agree(s, genus);
  }
}

TEST_CASE("options out of range are named") {
  const SurfaceSnapshot s = make_snapshot(torus(1, 0.3, 8, 6));
  CocycleOptions options;
  options.own_planes = -1;
  CHECK_THROWS_AS(compute_volume_cocycles(s, {}, options), UsageError);
  CHECK_THROWS_AS(compute_volume_cocycles(s, {{s.vertex_count(), Vector3::UnitX(), 1.0}}), UsageError);
}

TEST_CASE("A slab's faces are all found, and after many slabs few others are looked at") {
  const SurfaceSnapshot s = snapshot_of(pierced_plate(12), 2);
  const std::vector<detail::ComponentElements> components = detail::component_elements(s);
  REQUIRE(components.size() == 1);
  detail::ComponentSlabs slabs(s, components[0]);
  mspskel::test::Random random(3);
  std::size_t looked_at = 0, met = 0;
  constexpr int kFirst = 100, kSlabs = 200;
  for (int i = 0; i < kSlabs; ++i) {
    const Vector3 normal = random.in_ball().normalized();
    const double low = 0.2 * random.in_ball().x(), high = low + 0.002;
    const detail::ComponentElements& near = slabs(normal, low, high);
    CHECK(std::is_sorted(near.faces.begin(), near.faces.end()));
    std::vector<bool> is_near(s.face_count(), false), has_corner(s.vertex_count(), false);
    for (const Index f : near.faces) is_near[f] = true;
    for (const Index v : near.vertices) has_corner[v] = true;
    bool all = true;
    for (Index f = 0; f < s.face_count(); ++f) {
      double least = 1e9, most = -1e9;
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const double height = normal.dot(s.position[s.origin[h]]);
        least = std::min(least, height), most = std::max(most, height);
        all = all && (!is_near[f] || has_corner[s.origin[h]]);
      }
      if (most < low || least > high) continue;
      all = all && is_near[f];
      met += i >= kFirst;
    }
    CHECK(all);
    if (i >= kFirst) looked_at += near.faces.size();
  }
  CHECK(met > 5000);
  CHECK(looked_at < 6 * met);
}
