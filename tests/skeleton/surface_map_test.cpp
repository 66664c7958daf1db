// The surface map stays a partition, and its patches become connected.
#include "mspskel/skeleton/surface_map.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "support/meshes.h"

using namespace mspskel;

namespace {

// A tube along z from 0 to 8 and a chain of `count` nodes on its axis.
struct Tube {
  SurfaceSnapshot surface = make_snapshot(test::tube(1, 8, 16, 40));
  CurveSkeleton skeleton;
  std::vector<Index> one_branch = std::vector<Index>(surface.vertex_count(), 0);

  explicit Tube(Index count) {
    for (Index k = 0; k < count; ++k) {
      skeleton.nodes.emplace_back();
      skeleton.nodes.back().position = {0, 0, 8 * (k + 0.5) / count};
      if (k > 0) skeleton.edges.push_back({k - 1, k});
    }
  }
  double height(Index v) const { return surface.frame.to_model(surface.position[v])[2]; }
  Branch whole() const {
    Branch branch;
    branch.nodes.resize(skeleton.nodes.size());
    std::iota(branch.nodes.begin(), branch.nodes.end(), 0);
    return branch;
  }
};

}  // namespace

TEST_CASE("vertices of a tube go to the node at their height") {
  Tube t(7);
  assign_vertices_to_branch_nodes(t.surface, t.skeleton, t.one_branch, {t.whole()});
  double area = 0, nodes_area = 0;
  for (Index v = 0; v < t.surface.vertex_count(); ++v) {
    const double offset = t.height(v) - t.skeleton.nodes[t.skeleton.node_of_vertex[v]].position[2];
    CHECK(std::abs(offset) < 8.0 / 14 + 0.05);
    area += t.surface.vertex_area[v] * t.surface.frame.scale * t.surface.frame.scale;
  }
  const SurfaceMapReport r = report_surface_map(t.surface, t.skeleton);
  CHECK(r.partition);
  CHECK(r.nodes_in_one_patch == 7);
  CHECK(r.share_in_one_patch == 1.0);
  for (const SkeletonNode& n : t.skeleton.nodes) nodes_area += n.area;
  CHECK(nodes_area == Approx(area));
}

TEST_CASE("vertices without a branch keep their node") {
  Tube t(4);
  t.skeleton.node_of_vertex.assign(t.surface.vertex_count(), 0);
  std::vector<Index> branch(t.surface.vertex_count(), 0);
  for (Index v = 0; v < t.surface.vertex_count(); ++v)
    if (t.height(v) < 2) branch[v] = kNone;
  assign_vertices_to_branch_nodes(t.surface, t.skeleton, branch, {Branch{{1, 2, 3}}});
  for (Index v = 0; v < t.surface.vertex_count(); ++v)
    CHECK((t.skeleton.node_of_vertex[v] == 0) == (t.height(v) < 2));
}

TEST_CASE("scattered maps become one patch a node and stay partitions") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Tube t(6);
    test::Random random(seed);
    for (Index v = 0; v < t.surface.vertex_count(); ++v) t.skeleton.node_of_vertex.push_back(random.below(6));
    CurveSkeleton again = t.skeleton;
    const PatchRepair repair = make_patches_connected(t.surface, t.skeleton);
    const SurfaceMapReport r = report_surface_map(t.surface, t.skeleton);
    CHECK(r.partition);
    CHECK(r.nodes_in_one_patch == 6);
    CHECK(repair.nodes_left == 0);
    CHECK(repair.moved_vertices > 0);
    make_patches_connected(t.surface, again);
    CHECK(again.node_of_vertex == t.skeleton.node_of_vertex);
    CHECK(make_patches_connected(t.surface, t.skeleton).moved_vertices == 0);
  }
}

TEST_CASE("a stray patch goes to the node round it, and the right map is left alone") {
  Tube t(8);
  assign_vertices_to_branch_nodes(t.surface, t.skeleton, t.one_branch, {t.whole()});
  const std::vector<Index> right = t.skeleton.node_of_vertex;
  // One vertex in the middle of node 5's band, claimed by node 1 far away.
  Index stray = kNone;
  for (Index v = 0; v < t.surface.vertex_count() && stray == kNone; ++v) {
    Index h = t.surface.vertex_halfedge[v];
    bool deep = right[v] == 5;
    do {
      deep = deep && right[t.surface.target(h)] == 5;
      h = t.surface.next_outgoing(h);
    } while (h != t.surface.vertex_halfedge[v]);
    if (deep) stray = v;
  }
  REQUIRE(stray != kNone);
  t.skeleton.node_of_vertex[stray] = 1;
  CHECK(report_surface_map(t.surface, t.skeleton).patches[1] == 2);
  CHECK(make_patches_connected(t.surface, t.skeleton).moved_vertices == 1);
  CHECK(t.skeleton.node_of_vertex == right);
}

TEST_CASE("a node may keep a patch on each shell, and isolated vertices map nowhere") {
  PolygonSoup soup = test::to_soup(test::scaled(test::sphere(200), 3));
  append(soup, test::to_soup(test::sphere(200)));
  DefaultMesh mesh = test::to_mesh(soup);
  mesh.add_vertex({0, 0, 0});
  const SurfaceSnapshot s = make_snapshot(mesh);
  CurveSkeleton k;
  k.nodes.resize(1);
  k.node_of_vertex.assign(s.vertex_count(), 0);
  CHECK_FALSE(report_surface_map(s, k).partition);
  CHECK_THROWS_AS(make_patches_connected(s, k), UsageError);
  k.node_of_vertex.back() = kNone;
  CHECK(report_surface_map(s, k).partition);
  const PatchRepair repair = make_patches_connected(s, k);
  CHECK(repair.nodes_left == 1);
  CHECK(repair.moved_vertices == 0);
}

TEST_CASE("wrong maps are reported, and wrong branches refused") {
  Tube t(3);
  CHECK(report_surface_map(t.surface, t.skeleton).unmapped_vertices == t.surface.vertex_count());
  t.skeleton.node_of_vertex.assign(t.surface.vertex_count(), 1);
  t.skeleton.node_of_vertex[4] = 3;
  const SurfaceMapReport r = report_surface_map(t.surface, t.skeleton);
  CHECK_FALSE(r.partition);
  CHECK(r.unmapped_vertices == 1);
  CHECK(r.empty_nodes == 2);
  CHECK_THROWS_AS(assign_vertices_to_branch_nodes(t.surface, t.skeleton, t.one_branch, {}), UsageError);
  CHECK_THROWS_AS(assign_vertices_to_branch_nodes(t.surface, t.skeleton, t.one_branch, {Branch{}}),
                  UsageError);
  CHECK_THROWS_AS(assign_vertices_to_branch_nodes(t.surface, t.skeleton, t.one_branch, {Branch{{7}}}),
                  UsageError);
}
