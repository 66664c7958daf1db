// The whole way from surface to graph: with volume cocycles as labels the collapse ends with b0 = components
// and b1 = genus on every mesh, whatever the positions and costs.
#include <catch2/catch.hpp>
#include <cstdlib>

#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/collapse/skeleton_decimater.h"
#include "mspskel/collapse/volume_cocycles.h"
#include "mspskel/extract_skeleton.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

struct Betti {
  Index b0 = 0, b1 = 0, label_rank = 0;
  bool operator==(const Betti& o) const { return b0 == o.b0 && b1 == o.b1 && label_rank == o.label_rank; }
};

Betti betti(const CollapsedSkeleton& skeleton) {
  Betti result;
  LabelledForest forest(static_cast<Index>(skeleton.nodes.size()));
  LabelRank rank;
  CocycleLabel loop;
  result.b0 = static_cast<Index>(skeleton.nodes.size());
  for (const CollapsedEdge& e : skeleton.edges) {
    if (forest.join(e.first, e.second, e.label, loop)) {
      --result.b0;
    } else {
      ++result.b1;
      rank.insert(loop);
    }
  }
  result.label_rank = rank.rank();
  return result;
}

// Skeletal points pulled toward the inside by a random share, random slice data: the topology may not depend
// on them.
std::vector<MergingSet> random_sets(const SurfaceSnapshot& s, mspskel::test::Random& random) {
  std::vector<MergingSet> sets;
  const double depth = random.uniform(0, 0.05);
  for (Index v = 0; v < s.vertex_count(); ++v) {
    MergingVertex m;
    m.position = s.position[v] - depth * s.normal[v];
    m.perimeter = random.uniform(0.1, 0.2);
    m.normal = random.in_ball().normalized();
    m.error = random.uniform();
    m.area = s.vertex_area[v];
    m.valid = random.below(20) > 0;
    sets.push_back(MergingSet(m));
  }
  return sets;
}

Betti collapse(const SurfaceSnapshot& s, const CollapseOptions& options, std::uint64_t seed) {
  mspskel::test::Random random(seed);
  const VolumeCocycles cocycles = compute_volume_cocycles(s);
  return betti(collapse_complex(make_complex(s, cocycles.label), random_sets(s, random), options));
}

Betti expected(const SurfaceSnapshot& s) {
  Betti result;
  result.b0 = s.component_count;
  for (const auto& component : detail::component_elements(s)) result.b1 += component.genus();
  result.label_rank = result.b1;
  return result;
}

// A random solid: a lattice of bars, or a block with a lattice of tunnels.
SurfaceSnapshot random_surface(std::uint64_t seed) {
  mspskel::test::Random random(seed);
  VoxelSolid solid;
  do {
    const Index nodes = 2 + random.below(2);
    const double share = random.uniform(0.4, 0.95);
    const std::set<Cell> lattice = random_lattice(nodes, share, random);
    if (random.below(2) == 0) {
      solid.add(lattice);
    } else {
      const Index bottom = random.below(2) - 1, top = 5 + random.below(2);
      solid.box({-1, -1, bottom}, {6, 6, top});
      solid.remove(lattice);
    }
  } while (solid.cells.empty());
  const int fine = random.below(4) == 0 ? 2 : 1;
  return snapshot_of(solid, fine, random.uniform(0, 0.15), seed);
}

// Bars or tunnels along some edges of a cube, for tests that go the whole way.
SurfaceSnapshot small_random_surface(std::uint64_t seed) {
  mspskel::test::Random random(seed);
  VoxelSolid solid;
  do {
    solid = {};
    const std::set<Cell> lattice = random_lattice(2, random.uniform(0.7, 1.0), random);
    if (random.below(2) == 0) {
      solid.add(lattice);
    } else {
      solid.box({-1, -1, 0}, {4, 4, 3});
      solid.remove(lattice);
    }
  } while (solid.cells.empty());
  return snapshot_of(solid, 1, random.uniform(0, 0.15), seed);
}

int environment_count(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::max(1, std::atoi(text)) : otherwise;
}

}  // namespace

// Of each two random meshes one goes through the collapse alone, with random data, and one the whole way by a
// coarser surface and refined arcs. MSPSKEL_RANDOM_MESHES sets how many.
TEST_CASE("b0 and b1 are exact on random closed meshes") {
  const int count = environment_count("MSPSKEL_RANDOM_MESHES", 500) / 2;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const SurfaceSnapshot s = random_surface(seed);
    CollapseOptions options;
    options.lambda = i % 3 * 0.5;
    options.one_dimensional = i % 2 ? EdgePolicy::kSaturation : EdgePolicy::kKeep;
    options.saturation_threshold = i % 5 ? 0.1 : 2.0;
    options.dead_end = i % 4 < 2 ? DeadEnd::kOpenFaces : DeadEnd::kParallelEdges;
    INFO("seed " << seed << ", genus " << expected(s).b1);
    CHECK(collapse(s, options, seed) == expected(s));
  }
}

TEST_CASE("b0, b1 and the cycles' rank are exact on random meshes that are coarsened and refined") {
  const int count = environment_count("MSPSKEL_RANDOM_MESHES", 500) / 2;
  for (int i = 0; i < count; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const SurfaceSnapshot s = small_random_surface(seed);
    ExtractOptions options = default_options();
    options.coarsening.vertices = std::max(20, s.vertex_count() / 3);
    options.execution.threads = 1;  // threads of small meshes wait longer for each other than they work
    INFO("seed " << seed << ", genus " << expected(s).b1);
    const ExtractResult result = extract_skeleton_of_snapshot(s, options);
    const GraphCounts counts = count_graph(result.skeleton);
    CHECK(Betti{counts.components, counts.cycles, result.cycles.rank} == expected(s));
  }
}

TEST_CASE("the torus with seven vertices collapses to one loop") {
  const SurfaceSnapshot s = snapshot_of(csaszar_torus());
  for (std::uint64_t seed = 0; seed < 50; ++seed) CHECK(collapse(s, {}, seed) == expected(s));
}

TEST_CASE("the literal rule loses handles that the labels keep") {
  CollapseOptions literal;
  literal.keep_topology = false;
  const SurfaceSnapshot small = make_snapshot(torus(1.0, 0.3, 3, 3));
  int lost = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    lost += collapse(small, literal, seed).b1 == 0;
    CHECK(collapse(small, {}, seed) == expected(small));
  }
  CHECK(lost > 0);

  VoxelSolid plate;
  plate.box({0, 0, 0}, {9, 9, 1});
  for (int i = 0; i < 16; ++i) plate.cells.erase({2 * (i % 4) + 1, 2 * (i / 4) + 1, 0});
  const SurfaceSnapshot large = snapshot_of(plate, 2);
  CHECK(collapse(large, literal, 1).b1 < 16);
  CHECK(collapse(large, {}, 1) == expected(large));
}
