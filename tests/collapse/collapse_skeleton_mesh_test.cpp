// The collapse on surfaces with handles: the loops of the result are the handles of the solid.
#include "mspskel/collapse/collapse_skeleton_mesh.h"

#include <catch2/catch.hpp>
#include <random>

#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/collapse/volume_cocycles.h"
#include "mspskel/skeleton/make_curve_skeleton.h"
#include "mspskel/thesis/branch_filter.h"
#include "support/meshes.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Points anywhere near the surface, perimeters and errors at random: the topology must not depend on them.
SkeletonMesh random_skeleton_mesh(const SurfaceSnapshot& surface, unsigned seed, double spread) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  SkeletonMesh mesh;
  mesh.position = surface.position;
  mesh.area = surface.vertex_area;
  for (Vector3& p : mesh.position) {
    p += spread * Vector3{uniform(random), uniform(random), uniform(random)};
    mesh.perimeter.push_back(0.1 + uniform(random));
    mesh.normal.push_back(Vector3{uniform(random), uniform(random), uniform(random) + 0.1}.normalized());
    mesh.error.push_back(uniform(random));
    mesh.valid.push_back(random() % 10 != 0);
  }
  return mesh;
}

void check_exact(const SurfaceSnapshot& surface, Index genus) {
  const VolumeCocycles cocycles = compute_volume_cocycles(surface);
  REQUIRE(cocycles.rank == genus);
  for (unsigned round = 0; round < 8; ++round) {
    CollapseOptions options;
    options.lambda = round % 3 == 0 ? 0.0 : 1.0;
    options.saturation_threshold = round % 2 == 0 ? 0.1 : 2.0;
    options.one_dimensional = round % 4 < 2 ? EdgePolicy::kSaturation : EdgePolicy::kKeep;
    options.dead_end = round < 4 ? DeadEnd::kOpenFaces : DeadEnd::kParallelEdges;
    const SkeletonMesh mesh = random_skeleton_mesh(surface, round, round < 6 ? 0.05 : 1.0);
    const CollapsedSkeleton collapsed = collapse_skeleton_mesh(surface, mesh, cocycles.label, options);
    const BranchFilterResult filtered = filter_branches(collapsed);
    for (const CollapsedSkeleton& skeleton : {collapsed, filtered.skeleton}) {
      const GraphCounts counts = count_graph(make_curve_skeleton(skeleton, surface.frame));
      CHECK(counts.components == surface.component_count);
      CHECK(counts.cycles == genus);
      double area = 0, whole = 0;
      for (const CollapsedNode& node : skeleton.nodes) area += node.area;
      for (const double a : surface.vertex_area) whole += a;
      CHECK(area == Approx(whole));
      for (const Index node : skeleton.node_of_vertex)
        CHECK((node >= 0 && node < static_cast<Index>(skeleton.nodes.size())));
    }
  }
}

}  // namespace

TEST_CASE("a sphere ends as a tree") { check_exact(make_snapshot(sphere(300)), 0); }

TEST_CASE("a torus ends with one loop, thin or fat") {
  const double minor = GENERATE(0.1, 0.9);
  check_exact(make_snapshot(torus(1.0, minor, 24, 8)), 1);
}

TEST_CASE("a plate ends with a loop for each hole, coarse enough for handles to share vertices") {
  const Index holes = GENERATE(2, 7);
  const int fine = GENERATE(1, 2);
  VoxelSolid plate;
  plate.box({0, 0, 0}, {2 * holes + 1, 3, 1});
  for (Index i = 0; i < holes; ++i) plate.cells.erase({2 * i + 1, 1, 0});
  check_exact(make_snapshot(to_mesh(boundary(plate, fine))), holes);
}

TEST_CASE("a grid of handles ends with all of them") {
  VoxelSolid plate;
  plate.box({0, 0, 0}, {9, 9, 1});
  for (Index i = 1; i < 9; i += 2)
    for (Index j = 1; j < 9; j += 2) plate.cells.erase({i, j, 0});
  check_exact(make_snapshot(to_mesh(boundary(plate))), 16);
}

TEST_CASE("renumbering the surface moves no node") {
  const DefaultMesh mesh = torus(1.0, 0.3, 30, 10);
  std::vector<Index> place;
  const SurfaceSnapshot surface = make_snapshot(mesh), other = make_snapshot(renumbered(mesh, 5, &place));
  const SkeletonMesh points = random_skeleton_mesh(surface, 3, 0.2);
  SkeletonMesh moved = points;
  for (std::size_t v = 0; v < place.size(); ++v) {
    moved.position[place[v]] = points.position[v];
    moved.perimeter[place[v]] = points.perimeter[v];
    moved.normal[place[v]] = points.normal[v];
    moved.error[place[v]] = points.error[v];
    moved.area[place[v]] = points.area[v];
    moved.valid[place[v]] = points.valid[v];
  }
  CollapseOptions options;
  options.one_dimensional = EdgePolicy::kKeep;
  const auto a = collapse_skeleton_mesh(surface, points, compute_volume_cocycles(surface).label, options);
  const auto b = collapse_skeleton_mesh(other, moved, compute_volume_cocycles(other).label, options);
  REQUIRE(a.nodes.size() == b.nodes.size());
  CHECK(a.edges.size() == b.edges.size());
  for (std::size_t v = 0; v < place.size(); ++v) {
    const CollapsedNode &p = a.nodes[a.node_of_vertex[v]], &q = b.nodes[b.node_of_vertex[place[v]]];
    CHECK((p.position - q.position).norm() < 1e-9);
    CHECK(p.set.count() == q.set.count());
  }
}

TEST_CASE("without labels a torus ends as a tree") {
  const SurfaceSnapshot surface = make_snapshot(torus(1.0, 0.3, 24, 8));
  const CollapsedSkeleton tree = collapse_skeleton_mesh(surface, random_skeleton_mesh(surface, 1, 0.1));
  CHECK(count_graph(make_curve_skeleton(tree, surface.frame)).cycles == 0);
}

TEST_CASE("labels and points of the wrong number are refused") {
  const SurfaceSnapshot surface = make_snapshot(octahedron());
  SkeletonMesh mesh = random_skeleton_mesh(surface, 1, 0.1);
  CHECK_THROWS_AS(collapse_skeleton_mesh(surface, mesh, std::vector<CocycleLabel>(3)), UsageError);
  std::vector<CocycleLabel> labels(static_cast<std::size_t>(surface.halfedge_count()));
  labels[0] = CocycleLabel::unit(0);
  CHECK_THROWS_AS(collapse_skeleton_mesh(surface, mesh, labels), UsageError);
  mesh.position.pop_back();
  CHECK_THROWS_AS(collapse_skeleton_mesh(surface, mesh), UsageError);
}
