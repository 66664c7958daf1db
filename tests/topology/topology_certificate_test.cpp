// The certificate on skeletons that are right, and on ones that are wrong in one way each.
#include "mspskel/collapse/topology_certificate.h"

#include <algorithm>
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
                            const CocycleOptions& cocycles = {}, const CertificateOptions& options = {},
                            const Execution& execution = {}) {
  return certify_topology(s, compute_volume_cocycles(s, {}, cocycles), BoundingVolumeHierarchy(s), graph,
                          options, execution);
}

// The graphs side by side.
PolylineGraph joined(const PolylineGraph& a, const PolylineGraph& b) {
  PolylineGraph both = a;
  const auto n = static_cast<Index>(a.position.size());
  both.position.insert(both.position.end(), b.position.begin(), b.position.end());
  for (const auto& [p, q] : b.edges) both.edges.push_back({p + n, q + n});
  return both;
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

TEST_CASE("shells inside others are solids of their own, and no part of the solid round them") {
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
  const auto line = [&](int z) {
    return cell_graph(s, VoxelSolid::path({{1, 1, z}, {13, 1, z}, {13, 13, z}, {1, 13, z}, {1, 1, z}}));
  };
  const PolylineGraph in_wall = line(0), in_hollow = line(1);
  const auto with_components = [&](PolylineGraph graph, Index first, Index second) {
    graph.component.assign(in_wall.position.size(), first);
    graph.component.resize(graph.position.size(), second);
    return graph;
  };
  const Index outer = s.component[static_cast<std::size_t>(
      std::min_element(s.position.begin(), s.position.end(),
                       [](const Vector3& a, const Vector3& b) { return a.x() < b.x(); }) -
      s.position.begin())];
  // Which is which is found where it is not said.
  for (const PolylineGraph& both : {joined(in_wall, in_hollow), joined(in_hollow, in_wall),
                                    with_components(joined(in_wall, in_hollow), outer, 1 - outer)}) {
    const TopologyCertificate c = certify(s, both);
    INFO(c.reason);
    CHECK(c.nested_components == 1);
    CHECK(c.inside == 1.0);
    CHECK(c.verdict == TopologyVerdict::kProved);
  }
  const TopologyCertificate wrong =
      certify(s, with_components(joined(in_hollow, in_hollow), outer, 1 - outer));
  CHECK(wrong.inside == Approx(0.5));
  CHECK(wrong.verdict == TopologyVerdict::kKept);
  CHECK(certify(s, with_components(joined(in_wall, in_hollow), 1 - outer, outer)).inside == 0.0);
}

TEST_CASE("pieces of bodies in one place stand for one body each") {
  const VoxelSolid solid = three_rings();
  PolygonSoup twice = boundary(solid, 1);
  append(twice, boundary(solid, 1));
  const SurfaceSnapshot s = make_snapshot(to_mesh(twice));
  REQUIRE(s.component_count == 2);
  const PolylineGraph one = cell_graph(s, solid.cells);
  const TopologyCertificate c = certify(s, joined(one, one), {}, {false});
  INFO(c.reason);
  CHECK(c.inside == 1.0);
  CHECK(c.verdict == TopologyVerdict::kProved);
}

TEST_CASE("the certificate asks whether to stop") {
  const VoxelSolid solid = three_rings();
  const SurfaceSnapshot s = snapshot_of(solid, 1);
  const PolylineGraph graph = cell_graph(s, solid.cells);
  Execution execution;
  int all = 0;
  execution.progress = [&](const char*, double share) {
    CHECK((share >= 0 && share <= 1));
    return ++all, true;
  };
  certify(s, graph, {}, {}, execution);
  constexpr int kAlways = 3;
  CHECK(all >= kAlways);
  // How often loops ask depends on the time that they take, so that a run may ask less often than the first.
  for (int last = 1; last <= all; ++last) {
    int asked = 0;
    execution.progress = [&](const char*, double) { return ++asked < last; };
    bool cancelled = false;
    try {
      certify(s, graph, {}, {}, execution);
    } catch (const Cancelled&) {
      cancelled = true;
    }
    CHECK(cancelled == (asked == last));
    CHECK(asked <= last);
    if (last <= kAlways) CHECK(cancelled);
  }
}
