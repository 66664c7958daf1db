// The measures of a skeleton, on solids whose axis is known.
#include "mspskel/skeleton/check_skeleton.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/skeleton/radius.h"
#include "support/meshes.h"

using namespace mspskel;

namespace {

// A chain of nodes through the points, each edge cut in `pieces`.
CurveSkeleton chain(const std::vector<Vector3>& points, int pieces, bool closed = false) {
  CurveSkeleton s;
  const auto add = [&](const Vector3& p) {
    s.nodes.emplace_back();
    s.nodes.back().position = p;
  };
  const std::size_t count = points.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < pieces; ++k)
      add(points[i] + static_cast<double>(k) / pieces * (points[(i + 1) % points.size()] - points[i]));
  if (!closed) add(points.back());
  for (Index i = 1; i < static_cast<Index>(s.nodes.size()); ++i) s.edges.push_back({i - 1, i});
  if (closed) s.edges.push_back({0, static_cast<Index>(s.nodes.size()) - 1});
  return s;
}

SkeletonChecks check(const DefaultMesh& mesh, CurveSkeleton skeleton) {
  const SurfaceSnapshot s = make_snapshot(mesh);
  const BoundingVolumeHierarchy tree(s);
  set_radii(s, tree, skeleton);
  return check_skeleton(s, tree, skeleton);
}

}  // namespace

TEST_CASE("the axis of a tube is centred, inside and straight; beside it, it is off") {
  const DefaultMesh tube = test::tube(1, 8, 48, 60);
  const SkeletonChecks axis = check(tube, chain({{0, 0, 1}, {0, 0, 7}}, 12));
  CHECK(axis.topology);
  CHECK(axis.contained);
  CHECK(axis.inside == Approx(1));
  CHECK(axis.off_centre_mean < 0.005);
  CHECK(axis.bend < 1e-5);
  CHECK(axis.radius_error < 1e-15);
  CHECK(axis.leaves == 2);
  CHECK(axis.spurs == 0);
  CHECK(axis.length == Approx(6 / axis.diagonal));
  CHECK(axis.longest_edge == Approx(0.5 / axis.diagonal));
  // The balls touch the wall along the axis; the rims are √2 − 1 from the last ball.
  CHECK(axis.cover_mean < 0.05);
  CHECK(axis.cover_p95 * axis.diagonal < 0.5);
  // At a shift e the moment of the rays is e/2, and their mean close to the radius less e²/4.
  const SkeletonChecks beside = check(tube, chain({{0.4, 0, 1}, {0.4, 0, 7}}, 12));
  CHECK(beside.off_centre_mean == Approx(0.2 / 0.96).epsilon(0.02));
  CHECK(beside.contained);
}

TEST_CASE("what leaves the solid is seen, however briefly") {
  const DefaultMesh tube = test::tube(1, 8, 48, 60);
  const SkeletonChecks out = check(tube, chain({{0, 0, 2}, {0, 0, 4}, {0, 3, 6}}, 2));
  CHECK(out.outside_nodes == 2);
  CHECK(out.crossing_edges == 1);
  CHECK_FALSE(out.contained);
  CHECK(out.inside < 1);
  CHECK(out.inside > 0.3);
  // Both ends inside, the middle outside: a chord across a torus's hole.
  const SkeletonChecks chord = check(test::torus(2, 0.5, 48, 24), chain({{2, 0, 0}, {-2, 0, 0}}, 1));
  CHECK(chord.outside_nodes == 0);
  CHECK(chord.crossing_edges == 1);
  CHECK_FALSE(chord.contained);
  CHECK_FALSE(chord.topology);
}

TEST_CASE("the core of a torus has its topology") {
  std::vector<Vector3> circle;
  for (int i = 0; i < 60; ++i) circle.emplace_back(2 * std::cos(kPi * i / 30), 2 * std::sin(kPi * i / 30), 0);
  const SkeletonChecks core = check(test::torus(2, 0.5, 48, 24), chain(circle, 1, true));
  CHECK(core.genus == 1);
  CHECK(core.b1 == 1);
  CHECK(core.b0 == 1);
  CHECK(core.topology);
  CHECK(core.contained);
  CHECK(core.leaves == 0);
  CHECK(core.bend == Approx(6).epsilon(0.01));
}

TEST_CASE("a hair that stays in its joint's ball is a spur, a limb is none") {
  CurveSkeleton s = chain({{0, 0, 1}, {0, 0, 7}}, 2);
  s.nodes.emplace_back();
  s.nodes.back().position = {0.5, 0, 4};
  s.edges.push_back({1, 3});
  const SkeletonChecks r = check(test::tube(1, 8, 48, 60), s);
  CHECK(r.leaves == 3);
  CHECK(r.joints == 1);
  CHECK(r.spurs == 1);
}

TEST_CASE("measures move and scale with the model and do not depend on threads") {
  const DefaultMesh mesh = test::torus(2, 0.5, 24, 12);
  const CurveSkeleton a = chain({{2, 0, 0}, {1.3, 1.5, 0.1}, {0, 2, 0}}, 4);
  CurveSkeleton b = a;
  for (SkeletonNode& n : b.nodes) n.position = 3.5 * n.position + Vector3(100, -20, 7);
  const SkeletonChecks x = check(mesh, a);
  const SkeletonChecks y = check(test::translated(test::scaled(mesh, 3.5), {100, -20, 7}), b);
  CHECK(y.off_centre_mean == Approx(x.off_centre_mean).epsilon(1e-6));
  CHECK(y.cover_mean == Approx(x.cover_mean).epsilon(1e-6));
  CHECK(y.length == Approx(x.length).epsilon(1e-9));
  CHECK(y.inside == Approx(x.inside));
  const SurfaceSnapshot s = make_snapshot(mesh);
  const BoundingVolumeHierarchy tree(s);
  const SkeletonChecks one = check_skeleton(s, tree, a, {1, {}}), two = check_skeleton(s, tree, a, {2, {}});
  CHECK(one.off_centre_mean == two.off_centre_mean);
  CHECK(one.cover_p95 == two.cover_p95);
}

TEST_CASE("skeletons that make no sense are refused by name") {
  const SurfaceSnapshot s = make_snapshot(test::cube());
  const BoundingVolumeHierarchy tree(s);
  CurveSkeleton k;
  CHECK_THROWS_AS(check_skeleton(s, tree, k), NoSkeletonError);
  k.nodes.resize(2);
  k.edges = {{0, 2}};
  CHECK_THROWS_WITH(check_skeleton(s, tree, k), Catch::Contains("edge 0"));
  k.edges = {{1, 1}};
  CHECK_THROWS_AS(check_skeleton(s, tree, k), UsageError);
  k.edges = {{0, 1}};
  k.nodes[1].position[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(check_skeleton(s, tree, k), Catch::Contains("node 1"));
}

TEST_CASE("a skeleton far beyond the model is judged, not a memory hog") {
  const SkeletonChecks far = check(test::cube(), chain({{0, 0, 0}, {1e9, 1e8, 1e7}}, 1));
  CHECK(far.crossing_edges == 1);
  CHECK(far.outside_nodes == 1);
  CHECK(far.inside < 0.01);
}

TEST_CASE("radii are distances in model units") {
  const SurfaceSnapshot s = make_snapshot(test::scaled(test::cube(), 10));
  const BoundingVolumeHierarchy tree(s);
  CurveSkeleton k;
  k.nodes.resize(2);
  k.nodes[1].position = {4, 0, 0};
  set_radii(s, tree, k);
  CHECK(k.nodes[0].radius == Approx(10));
  CHECK(k.nodes[1].radius == Approx(6));
}

TEST_CASE("a piece is measured in the solid of its component, without its cavities") {
  // A ball with a hollow, and a ball inside another that is turned the same way.
  PolygonSoup outer = test::to_soup(test::sphere(800)), inner = outer;
  for (Vector3& p : inner.points) p *= 0.5;
  for (const bool hollow : {true, false}) {
    PolygonSoup both = outer, second = inner;
    if (hollow) reverse_orientation(second);
    append(both, second);
    const DefaultMesh mesh = test::to_mesh(both);
    // One line in the middle, and one in the wall.
    CurveSkeleton skeleton = chain({{-0.3, 0, 0}, {0.3, 0, 0}}, 10);
    const CurveSkeleton wall = chain({{-0.4, 0, 0.75}, {0.4, 0, 0.75}}, 10);
    const auto n = static_cast<Index>(skeleton.nodes.size());
    skeleton.nodes.insert(skeleton.nodes.end(), wall.nodes.begin(), wall.nodes.end());
    for (const auto& [a, b] : wall.edges) skeleton.edges.push_back({a + n, b + n});
    const SkeletonChecks right = check(mesh, skeleton);
    CHECK(right.contained);
    CHECK(right.inside == 1.0);
    // Both in the middle: a solid round a hollow has nothing there, a solid with another one inside it has.
    for (Index i = n; i < static_cast<Index>(skeleton.nodes.size()); ++i)
      skeleton.nodes[i].position.z() = 0.1;
    const SkeletonChecks moved = check(mesh, skeleton);
    CHECK(moved.contained);  // in the hollow: both stand for it, and the certificate misses a piece
    skeleton.node_of_vertex.assign(mesh.n_vertices(), 0);
    for (std::size_t v = 0; v < outer.points.size(); ++v) skeleton.node_of_vertex[v] = n;
    const SkeletonChecks said = check(mesh, skeleton);
    CHECK(said.contained == !hollow);
    CHECK(said.outside_nodes == (hollow ? static_cast<Index>(wall.nodes.size()) : 0));
  }
}
