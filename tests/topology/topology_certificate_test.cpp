// The certificate on skeletons that are right, and on ones that are wrong in one way each.
#include "mspskel/collapse/topology_certificate.h"

#include <catch2/catch.hpp>
#include <map>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// The middles of the cells, joined across shared faces: the skeleton of a solid made of paths.
PolylineGraph cell_graph(const SurfaceSnapshot& s, const std::set<Cell>& cells) {
  PolylineGraph graph;
  std::map<Cell, Index> number;
  for (const Cell& c : cells) {
    number[c] = static_cast<Index>(graph.position.size());
    graph.position.push_back(s.frame.to_normalised(Vector3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5)));
  }
  for (const auto& [c, i] : number)
    for (std::size_t k = 0; k < 3; ++k) {
      Cell next = c;
      ++next[k];
      if (number.count(next)) graph.edges.push_back({i, number[next]});
    }
  return graph;
}

TopologyCertificate certify(const SurfaceSnapshot& s, const PolylineGraph& graph,
                            const CocycleOptions& cocycles = {}, const CertificateOptions& options = {}) {
  return certify_topology(s, compute_volume_cocycles(s, {}, cocycles), BoundingVolumeHierarchy(s), graph,
                          options);
}

CocycleOptions linking_only() {
  CocycleOptions options;
  options.use_discs = options.use_holed_regions = false;
  return options;
}

// The loop of cells round the tunnel that runs along x through the cell.
std::set<Cell> round_tunnel(const Cell& c) {
  std::set<Cell> ring;
  for (int y = -1; y <= 1; ++y)
    for (int z = -1; z <= 1; ++z)
      if (y != 0 || z != 0) ring.insert({c[0], c[1] + y, c[2] + z});
  return ring;
}

VoxelSolid three_rings() {
  VoxelSolid solid;
  for (int i = 0; i < 3; ++i)
    solid.add(VoxelSolid::path(
        {{0, 4 * i, 0}, {4, 4 * i, 0}, {4, 4 * i + 4, 0}, {0, 4 * i + 4, 0}, {0, 4 * i, 0}}));
  return solid;
}

}  // namespace

TEST_CASE("skeletons of solids made of paths are proved") {
  Random random(3);
  for (int round = 0; round < 40; ++round) {
    const std::set<Cell> cells = random_lattice(3, random.uniform(0.3, 0.9), random);
    VoxelSolid solid;
    solid.add(cells);
    const SurfaceSnapshot s = snapshot_of(solid, 1, 0.1, static_cast<std::uint64_t>(round));
    for (const CocycleOptions& options : {CocycleOptions{}, linking_only()}) {
      const TopologyCertificate c = certify(s, cell_graph(s, cells), options);
      INFO(c.reason);
      CHECK(c.verdict == TopologyVerdict::kProved);
      CHECK(c.b1 == c.total_genus);
      CHECK(c.crossing_rank == c.total_genus);
      CHECK(c.inside == 1.0);
    }
  }
}

TEST_CASE("a loop round a knotted tunnel is proved, a loop beside it fails") {
  const SurfaceSnapshot s = snapshot_of(knotted_tunnel(2, 3), 1);
  for (const CocycleOptions& options : {CocycleOptions{}, linking_only()}) {
    CHECK(certify(s, cell_graph(s, round_tunnel({1, 4, 0})), options).verdict == TopologyVerdict::kProved);
    const std::set<Cell> beside{{9, 8, 3}, {9, 9, 3}, {8, 9, 3}, {8, 8, 3}};  // in the block's margin
    const TopologyCertificate c = certify(s, cell_graph(s, beside), options);
    CHECK(c.verdict == TopologyVerdict::kFailed);
    CHECK(c.b1 == 1);
    CHECK(c.crossing_rank == 0);
  }
}

TEST_CASE("what is wrong is found and named") {
  const VoxelSolid solid = three_rings();
  const SurfaceSnapshot s = snapshot_of(solid, 1);
  const PolylineGraph right = cell_graph(s, solid.cells);
  REQUIRE(certify(s, right).verdict == TopologyVerdict::kProved);
  SECTION("a cut loop") {
    PolylineGraph graph = right;
    graph.edges.pop_back();
    const TopologyCertificate c = certify(s, graph);
    CHECK(c.verdict == TopologyVerdict::kFailed);
    CHECK(c.reason == "b1 is 2, not 3");
  }
  SECTION("a piece too many") {
    PolylineGraph graph = right;
    graph.position.push_back(graph.position.front());
    CHECK(certify(s, graph).reason == "b0 is 2, not 1");
  }
  SECTION("one handle twice, another one missed") {
    PolylineGraph graph = right;
    graph.edges.pop_back();
    const auto [a, b] = right.edges.front();
    graph.position.push_back(0.5 * (graph.position[a] + graph.position[b]));
    const auto n = static_cast<Index>(graph.position.size()) - 1;
    graph.edges.push_back({a, n});
    graph.edges.push_back({n, b});
    const TopologyCertificate c = certify(s, graph);
    CHECK(c.verdict == TopologyVerdict::kFailed);
    CHECK(c.b1 == 3);
    CHECK(c.crossing_rank == 2);
  }
  SECTION("a part outside") {
    PolylineGraph graph = right;
    graph.position.back() += Vector3(0, 0, 0.5);
    const TopologyCertificate c = certify(s, graph);
    CHECK(c.verdict == TopologyVerdict::kKept);
    CHECK(c.inside < 1.0);
    CHECK(c.edges_not_inside >= 1);
  }
  SECTION("a surface that crosses itself") {
    const TopologyCertificate told = certify(s, right, {}, {true});
    CHECK(told.verdict == TopologyVerdict::kKept);
    CHECK(told.reason == "the surface intersects itself");
    PolygonSoup soup = boundary(solid, 1);
    for (Vector3& x : soup.points)
      if (x.x() == 5 && x.y() == 5) x.x() = -2;
    CHECK(certify(snapshot_of(soup), right).verdict == TopologyVerdict::kKept);
  }
  SECTION("an edge that names no node") {
    PolylineGraph graph = right;
    graph.edges.push_back({0, 1000});
    CHECK_THROWS_AS(certify(s, graph), UsageError);
  }
}

TEST_CASE("shells inside others are solids of their own") {
  const std::set<Cell> ring = VoxelSolid::path({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}});
  VoxelSolid solid;
  for (const Cell& c : ring) solid.box({3 * c[0], 3 * c[1], 0}, {3 * c[0] + 3, 3 * c[1] + 3, 3});
  for (const Cell& c : ring)
    for (int k = -1; k <= 1; ++k)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        Cell next = c;
        next[axis] += k;
        if (k != 0 && !ring.count(next)) continue;
        Cell cell{3 * c[0] + 1, 3 * c[1] + 1, 1};
        cell[axis] += k;
        solid.cells.erase(cell);
      }
  const SurfaceSnapshot s = snapshot_of(solid, 1);
  REQUIRE(s.component_count == 2);
  // Both shells have a centre line in the same place.
  PolylineGraph graph =
      cell_graph(s, VoxelSolid::path({{1, 1, 1}, {13, 1, 1}, {13, 13, 1}, {1, 13, 1}, {1, 1, 1}}));
  const auto n = static_cast<Index>(graph.position.size());
  PolylineGraph both = graph;
  both.position.insert(both.position.end(), graph.position.begin(), graph.position.end());
  for (const auto& [a, b] : graph.edges) both.edges.push_back({a + n, b + n});
  CHECK(certify(s, both).verdict == TopologyVerdict::kKept);
  both.component.assign(static_cast<std::size_t>(n), 0);
  both.component.insert(both.component.end(), static_cast<std::size_t>(n), 1);
  const TopologyCertificate c = certify(s, both);
  INFO(c.reason);
  CHECK(c.nested_components == 1);
  CHECK(c.inside == 1.0);
  CHECK(c.verdict == TopologyVerdict::kProved);
}
