#include "mspskel/mesh/subdivide_surface.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "mspskel/base/error.h"
#include "mspskel/extract_skeleton.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

double longest_edge(const SurfaceSnapshot& s) {
  double longest = 0;
  for (Index h = 0; h < s.halfedge_count(); ++h)
    longest = std::max(longest, (s.position[s.origin[h]] - s.position[s.target(h)]).norm());
  return longest;
}

double area(const SurfaceSnapshot& s) {
  return std::accumulate(s.vertex_area.begin(), s.vertex_area.end(), 0.0);
}

// A bar of square section along each axis, with no vertices but its corners and those where the bars meet.
DefaultMesh sparse_cross(double length) {
  std::vector<Vector3> points;
  std::vector<std::array<Index, 3>> faces;
  for (Index i = 0; i < 8; ++i) points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  };
  const std::array<std::array<Index, 4>, 6> sides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& side : sides) {
    Vector3 out = Vector3::Zero();
    for (const Index v : side) out += points[v] / 4;
    std::array<Index, 4> end;
    for (std::size_t k = 0; k < 4; ++k) {
      end[k] = static_cast<Index>(points.size());
      points.push_back(points[side[k]] + length * out);
    }
    for (std::size_t k = 0; k < 4; ++k) quad(side[k], side[(k + 1) % 4], end[(k + 1) % 4], end[k]);
    quad(end[0], end[1], end[2], end[3]);
  }
  return from_triangles(points, faces);
}

// A gear with a bore, one facet long: its teeth are ridges along the whole of it.
DefaultMesh sparse_gear(int teeth, double length) {
  constexpr int kPerTooth = 16;
  constexpr double kBore = 0.4, kFoot = 0.7, kHead = 1;
  const int n = teeth * kPerTooth;
  std::vector<Vector3> points;  // the outline below and above, the bore below and above
  for (const bool bore : {false, true})
    for (const double z : {0.0, length})
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * kPi * i / n, along = static_cast<double>(i % kPerTooth) / kPerTooth;
        const double radius = bore ? kBore : kFoot + (kHead - kFoot) * std::pow(std::sin(kPi * along), 0.7);
        points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
      }
  std::vector<std::array<Index, 3>> faces;
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  };
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    quad(i, j, n + j, n + i);
    quad(2 * n + j, 2 * n + i, 3 * n + i, 3 * n + j);
    quad(i, 2 * n + i, 2 * n + j, j);
    quad(n + i, n + j, 3 * n + j, 3 * n + i);
  }
  return from_triangles(points, faces);
}

}  // namespace

TEST_CASE("A turned surface is cut in as many places") {
  const DefaultMesh cross = sparse_cross(7);
  const Index cuts = subdivide_surface(make_snapshot(cross)).cuts;
  REQUIRE(cuts > 0);
  for (const double angle : {0.3, 0.8, 2.0})
    CHECK(subdivide_surface(make_snapshot(rotated(cross, {1, 2, 3}, angle))).cuts == cuts);
}

TEST_CASE("Cutting edges keeps the surface, its frame and its vertices") {
  for (const DefaultMesh& mesh : {cube(), tetrahedron(), torus(1, 0.4, 8, 5), prism(3, 9, 1)}) {
    const SurfaceSnapshot before = make_snapshot(mesh);
    const SurfaceSnapshot after = subdivide_surface(before).surface;
    REQUIRE(after.vertex_count() > before.vertex_count());
    CHECK(after.vertex_count() <= before.vertex_count() + SubdivisionOptions().most_added);
    CHECK(area(after) == Approx(area(before)));
    CHECK(after.frame.scale == before.frame.scale);
    CHECK(after.component_count == before.component_count);
    CHECK(twice_euler_characteristics(after) == twice_euler_characteristics(before));
    for (Index v = 0; v < before.vertex_count(); ++v) CHECK(after.position[v] == before.position[v]);
    for (Index h = 0; h < after.halfedge_count(); ++h) {
      REQUIRE(after.twin[after.twin[h]] == h);
      REQUIRE(after.origin[after.twin[h]] == after.target(h));
    }
    CHECK(longest_edge(after) < 0.5 * longest_edge(before));
  }
}

TEST_CASE("What is fine enough, or has been given its vertices, stays") {
  const SurfaceSnapshot box = make_snapshot(cube());
  const SurfaceSnapshot fine = subdivide_surface(box).surface;
  CHECK_FALSE(has_long_edge(fine));
  CHECK(subdivide_surface(fine).cuts == 0);
  SubdivisionOptions options;
  options.longest = 1;
  CHECK(subdivide_surface(box, options).cuts == 0);
  options = {};
  options.most_added = 12;
  CHECK(has_long_edge(box, options));
  CHECK(subdivide_surface(box, options).surface.vertex_count() == 20);
  options.most_added_in_all = 4;
  CHECK(subdivide_surface(box, options).surface.vertex_count() == 12);
  options = {};
  options.enough = 8;
  CHECK_FALSE(has_long_edge(box, options));
  CHECK(subdivide_surface(box, options).cuts == 0);
}

TEST_CASE("Subdivision options out of range are named") {
  SubdivisionOptions options;
  options.longest = 0;
  CHECK_THROWS_AS(validate(options), UsageError);
  options = {};
  options.enough = 0;
  CHECK_THROWS_AS(validate(options), UsageError);
  options = {};
  options.most_added = 0;
  CHECK_THROWS_AS(validate(options), UsageError);
  options = {};
  options.most_added_in_all = 0;
  CHECK_THROWS_AS(validate(options), UsageError);
}

TEST_CASE("A cross of long triangles has all its six arms, and the result is the input's") {
  const DefaultMesh mesh = sparse_cross(9);
  const ExtractResult result = extract_skeleton(mesh);
  CHECK(count_graph(result.skeleton).leaves == 6);
  CHECK(result.surface.vertex_count() == static_cast<Index>(mesh.n_vertices()));
  CHECK(result.skeleton.node_of_vertex.size() == mesh.n_vertices());
  CHECK(result.slices.valid.size() == mesh.n_vertices());
  CHECK(result.skeleton_mesh.position.size() == mesh.n_vertices());
  CHECK(result.cocycles.label.size() == 6 * mesh.n_faces() / 2);
}

TEST_CASE("Long facets are cut all along, however many there are round a shape") {
  for (const int teeth : {3, 6}) {
    const SurfaceSnapshot gear = make_snapshot(sparse_gear(teeth, 2.5));
    CHECK(longest_edge(subdivide_surface(gear).surface) < 0.13 * longest_edge(gear));
  }
}

TEST_CASE("Isolated vertices are left out, wherever they stand, and change nothing else") {
  DefaultMesh mesh = cube();
  const SubdividedSurface alone = subdivide_surface(make_snapshot(mesh));
  mesh.add_vertex({99, 0, 0});
  const SubdividedSurface beside = subdivide_surface(make_snapshot(mesh));
  CHECK(beside.vertex.back() == kNone);
  CHECK(beside.surface.position.size() == alone.surface.position.size());
  CHECK(beside.surface.origin == alone.surface.origin);
}
