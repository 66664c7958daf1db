// Counts, measures and flaws of surfaces for which they are known.
#include "mspskel/mesh/mesh_report.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/self_intersection.h"
#include "support/meshes.h"

using namespace mspskel;

namespace {

SurfaceSnapshot snapshot(const std::vector<DefaultMesh>& parts) {
  PolygonSoup soup;
  for (const DefaultMesh& part : parts) append(soup, test::to_soup(part));
  return make_snapshot(test::to_mesh(soup));
}

Index intersections(const SurfaceSnapshot& s) {
  return count_self_intersections(s, BoundingVolumeHierarchy(s));
}

}  // namespace

TEST_CASE("a cube's report holds the cube's measures") {
  const MeshReport r = report_mesh(make_snapshot(test::cube()));
  CHECK(r.vertices == 8);
  CHECK(r.edges == 18);
  CHECK(r.faces == 12);
  CHECK(r.genus == 0);
  CHECK(r.isolated_vertices == 0);
  CHECK(r.diagonal == Approx(2 * std::sqrt(3.0)));
  CHECK(r.area == Approx(24));
  CHECK(r.signed_volume == Approx(8));
  CHECK(r.shortest_edge == Approx(2));
  CHECK(r.longest_edge == Approx(2 * std::sqrt(2.0)));
  CHECK(r.mean_edge == Approx((12 * 2 + 6 * 2 * std::sqrt(2.0)) / 18));
  CHECK(r.degenerate_faces == 0);
  CHECK(r.self_intersections == 0);
}

TEST_CASE("genus and counts add up over the components; isolated vertices belong to none") {
  DefaultMesh torus = test::torus(2, 0.5, 16, 8);
  torus.add_vertex({9, 9, 9});
  const MeshReport r = report_mesh(
      snapshot({torus, test::translated(test::sphere(200), {5, 0, 0}), test::translated(torus, {0, 0, 4})}));
  REQUIRE(r.components.size() == 3);
  CHECK(r.components[0].genus == 1);
  CHECK(r.components[1].genus == 0);
  CHECK(r.components[2].genus == 1);
  CHECK(r.genus == 2);
  CHECK(r.isolated_vertices == 2);
  CHECK(r.cavities == 0);
  Index vertices = r.isolated_vertices, faces = 0;
  double area = 0;
  for (const ComponentReport& c : r.components) {
    vertices += c.vertices;
    faces += c.faces;
    area += c.area;
    CHECK(c.vertices - c.edges + c.faces == 2 - 2 * c.genus);
    CHECK(c.directly_inside == kNone);
  }
  CHECK(vertices == r.vertices);
  CHECK(faces == r.faces);
  CHECK(area == Approx(r.area));
}

TEST_CASE("shells inside shells are told by depth") {
  const auto ball = [](double radius) { return test::scaled(test::sphere(200), radius); };
  const MeshReport r =
      report_mesh(snapshot({ball(1), ball(4), test::translated(ball(0.5), {0, 3, 0}), ball(2), ball(8)}));
  CHECK(r.components[4].depth == 0);
  CHECK(r.components[1].depth == 1);
  CHECK(r.components[3].depth == 2);
  CHECK(r.components[0].depth == 3);
  CHECK(r.components[2].depth == 2);
  CHECK(r.components[4].directly_inside == kNone);
  CHECK(r.components[1].directly_inside == 4);
  CHECK(r.components[3].directly_inside == 1);
  CHECK(r.components[0].directly_inside == 3);
  CHECK(r.components[2].directly_inside == 1);
  CHECK(r.cavities == 2);
}

TEST_CASE("surfaces without self-intersections have none, flat, thin or jittered") {
  CHECK(intersections(make_snapshot(test::cube())) == 0);
  CHECK(intersections(make_snapshot(test::prism(6, 3, 10))) == 0);
  CHECK(intersections(make_snapshot(test::torus(2, 0.5, 32, 16))) == 0);
  CHECK(intersections(make_snapshot(test::rotated(test::prism(4, 3, 30), {1, 2, 3}, 0.7))) == 0);
  CHECK(intersections(make_snapshot(test::jittered(test::sphere(500), 3, 0.1))) == 0);
  CHECK(intersections(snapshot({test::cube(), test::translated(test::cube(), {2 + 1e-9, 0, 0})})) == 0);
}

TEST_CASE("crossing, touching and overlapping parts intersect") {
  const DefaultMesh ball = test::sphere(300);
  CHECK(intersections(snapshot({ball, test::translated(ball, {1.5, 0.1, 0.2})})) > 0);
  CHECK(intersections(snapshot({ball, ball})) > 0);
  CHECK(intersections(snapshot({test::cube(), test::translated(test::cube(), {2, 0.5, 0.5})})) >
        0);  // faces overlap
  CHECK(intersections(snapshot({test::octahedron(), test::translated(test::octahedron(), {2, 0, 0})})) >
        0);  // corners
}

TEST_CASE("a fold is a self-intersection") {
  // The upper apex laid into the plane of the other corners: its faces fold back flat over each other.
  DefaultMesh mesh = test::octahedron();
  for (const auto v : mesh.vertices())
    if (mesh.point(v)[2] > 0.5) mesh.point(v) = {2, 0, 0};
  CHECK(intersections(make_snapshot(mesh)) > 0);
}

TEST_CASE("the count stops at the limit and does not depend on the threads") {
  const DefaultMesh ball = test::sphere(300);
  const SurfaceSnapshot s = snapshot({ball, test::translated(ball, {1.0, 0.1, 0.2})});
  const BoundingVolumeHierarchy tree(s);
  const Index all = count_self_intersections(s, tree);
  REQUIRE(all > 5);
  CHECK(count_self_intersections(s, tree, 1) == 1);
  CHECK(count_self_intersections(s, tree, 5) == 5);
  CHECK(count_self_intersections(s, tree, all + 1, {1, {}}) == all);
  CHECK(count_self_intersections(s, tree, all + 1, {2, {}}) == all);
  const std::vector<Index> faces = find_self_intersecting_faces(s, tree, {1, {}});
  CHECK(find_self_intersecting_faces(s, tree, {2, {}}) == faces);
  CHECK(std::is_sorted(faces.begin(), faces.end()));
  // All pairs are among them.
  std::vector<Index> others;
  for (Index f = 0; f < s.face_count(); ++f)
    if (!std::binary_search(faces.begin(), faces.end(), f)) others.push_back(f);
  CHECK(count_self_intersections(s, BoundingVolumeHierarchy(s, faces)) == all);
  CHECK(count_self_intersections(s, BoundingVolumeHierarchy(s, others)) == 0);
  MeshReportOptions wrong;
  wrong.self_intersection_limit = -1;
  CHECK_THROWS_AS(validate(wrong), UsageError);
}

TEST_CASE("triangles without area are counted") {
  // One corner on the line between two of its neighbours.
  DefaultMesh mesh = test::octahedron();
  for (const auto v : mesh.vertices())
    if (mesh.point(v)[0] > 0.5)
      mesh.point(v) = (DefaultMesh::Point(0, 1, 0) + DefaultMesh::Point(0, 0, 1)) * 0.5;
  CHECK(report_mesh(make_snapshot(mesh)).degenerate_faces == 1);
}
