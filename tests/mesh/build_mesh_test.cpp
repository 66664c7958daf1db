// Soups that are surfaces become meshes that are closed and face outward; the others are refused, counted and
// named.
#include "mspskel/mesh/build_mesh.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "mspskel/base/error.h"
#include "mspskel/mesh/surface_snapshot.h"

using namespace mspskel;
using Catch::Contains;

namespace {

using Polygons = std::vector<std::vector<Index>>;

PolygonSoup soup_of(const std::vector<Vector3>& points, const Polygons& polygons) {
  PolygonSoup soup;
  soup.points = points;
  for (const auto& polygon : polygons) {
    soup.corners.insert(soup.corners.end(), polygon.begin(), polygon.end());
    soup.begin.push_back(static_cast<Index>(soup.corners.size()));
  }
  return soup;
}
const std::vector<Vector3> kTetrahedronPoints{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Polygons kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

// An axis-parallel box of quads.
PolygonSoup box(const Vector3& low, const Vector3& high) {
  std::vector<Vector3> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
  return soup_of(points,
                 {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}
// A prism over a polygon in the plane, its caps left whole.
PolygonSoup prism(const std::vector<Vector3>& outline) {
  std::vector<Vector3> points = outline;
  const auto n = static_cast<Index>(outline.size());
  for (const Vector3& p : outline) points.push_back(p + Vector3::UnitZ());
  Polygons polygons(2);
  for (Index i = 0; i < n; ++i) {
    polygons[0].insert(polygons[0].begin(), i);
    polygons[1].push_back(n + i);
    polygons.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  return soup_of(points, polygons);
}
void append(PolygonSoup& soup, const PolygonSoup& more) {
  const auto shift = static_cast<Index>(soup.points.size()),
             corner_shift = static_cast<Index>(soup.corners.size());
  soup.points.insert(soup.points.end(), more.points.begin(), more.points.end());
  for (const Index v : more.corners) soup.corners.push_back(v + shift);
  for (std::size_t f = 1; f < more.begin.size(); ++f) soup.begin.push_back(more.begin[f] + corner_shift);
}
void reverse_polygon(PolygonSoup& soup, std::size_t f) {
  std::reverse(soup.corners.begin() + soup.begin[f], soup.corners.begin() + soup.begin[f + 1]);
}
void reverse_all(PolygonSoup& soup) {
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) reverse_polygon(soup, f);
}

double volume(const DefaultMesh& mesh) {
  double six = 0;
  for (const auto f : mesh.faces()) {
    auto v = mesh.cfv_iter(f);
    const Vector3 a = to_vector3(mesh.point(*v)), b = to_vector3(mesh.point(*++v)),
                  c = to_vector3(mesh.point(*++v));
    six += a.dot(b.cross(c));
  }
  return six / 6;
}
double area(const DefaultMesh& mesh) {
  double twice = 0;
  for (const auto f : mesh.faces()) {
    auto v = mesh.cfv_iter(f);
    const Vector3 a = to_vector3(mesh.point(*v)), b = to_vector3(mesh.point(*++v)),
                  c = to_vector3(mesh.point(*++v));
    twice += (b - a).cross(c - a).norm();
  }
  return twice / 2;
}

}  // namespace

TEST_CASE("a tetrahedron keeps its vertices, faces and their order") {
  const BuiltMesh built = build_mesh_with_report(soup_of(kTetrahedronPoints, kTetrahedron));
  CHECK(built.warnings.empty());
  CHECK(built.component_count == 1);
  REQUIRE(built.mesh.n_vertices() == 4);
  REQUIRE(built.mesh.n_edges() == 6);
  REQUIRE(built.mesh.n_faces() == 4);
  CHECK(volume(built.mesh) == Approx(1.0 / 6));
  for (const auto f : built.mesh.faces()) {
    std::vector<Index> corners;
    for (const auto v : f.vertices()) corners.push_back(v.idx());
    CHECK(corners == kTetrahedron[static_cast<std::size_t>(f.idx())]);
  }
  for (const auto h : built.mesh.halfedges()) {
    CHECK_FALSE(h.is_boundary());
    CHECK(h.next().prev() == h);
    CHECK(h.next().next().next() == h);
    CHECK(h.to() == h.next().from());
  }
  for (const auto v : built.mesh.vertices()) CHECK(v.valence() == 3);
  CHECK(make_snapshot(built.mesh).face_count() == 4);
}

TEST_CASE("polygons are cut in their plane, concave ones too: volume and area stay") {
  const BuiltMesh cube = build_mesh_with_report(box({0, 0, 0}, {1, 2, 3}));
  CHECK(cube.triangulated_polygons == 6);
  CHECK(volume(cube.mesh) == Approx(6));
  CHECK(area(cube.mesh) == Approx(22));

  std::vector<Vector3> star, comb;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * kPi * i / 24, radius = i % 2 ? 1 : 0.2;
    star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  for (int i = 0; i < 10; ++i) comb.emplace_back(i, i % 2 ? 0.1 : 3.0, 0);
  comb.emplace_back(9, -1, 0);
  comb.emplace_back(0, -1, 0);
  std::reverse(comb.begin(), comb.end());
  const std::vector<Vector3> l_shape{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const std::vector<Vector3> arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  for (const auto& outline : {star, comb, l_shape, arrow}) {
    double twice = 0, length = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
      twice += a.cross(b)[2];
      length += (b - a).norm();
    }
    const BuiltMesh built = build_mesh_with_report(prism(outline));
    CHECK(volume(built.mesh) == Approx(twice / 2));
    CHECK(area(built.mesh) == Approx(twice + length));
    CHECK(built.degenerate_faces == 0);
  }
}

TEST_CASE("no diagonal runs along an edge that exists already") {
  // Two quads over the same four vertices: equal diagonals would give one edge four faces.
  const std::vector<Vector3> points{{0, 0, 0}, {1, 0, 0.2}, {1, 1, 0}, {0, 1, 0.2}};
  const BuiltMesh built = build_mesh_with_report(soup_of(points, {{0, 1, 2, 3}, {0, 3, 2, 1}}));
  CHECK(built.mesh.n_faces() == 4);
  CHECK(built.mesh.n_edges() == 6);
}

TEST_CASE("faces are turned to agree and to face outward") {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    PolygonSoup soup = box({0, 0, 0}, {1, 1, 1});
    for (std::size_t f = 0; f < 6; ++f)
      if (random() & 1) reverse_polygon(soup, f);
    const BuiltMesh built = build_mesh_with_report(soup);
    CHECK(volume(built.mesh) == Approx(1));
    CHECK(built.reoriented_faces <= 6);
  }
  PolygonSoup one = box({0, 0, 0}, {1, 1, 1});
  reverse_polygon(one, 2);
  const BuiltMesh built = build_mesh_with_report(one);
  CHECK(built.reoriented_faces == 2);
  REQUIRE(built.warnings.size() == 1);
  CHECK_THAT(built.warnings[0], Contains("2 faces were turned over"));
}

TEST_CASE("an inside-out component is turned unless it is a cavity") {
  PolygonSoup outer = box({0, 0, 0}, {4, 4, 4}), inner = box({1, 1, 1}, {2, 2, 2}),
              apart = box({9, 0, 0}, {10, 1, 1});
  reverse_all(inner);
  reverse_all(apart);
  PolygonSoup soup = outer;
  append(soup, inner);
  append(soup, apart);
  BuiltMesh built = build_mesh_with_report(soup);
  CHECK(built.component_count == 3);
  CHECK(built.flipped_components == 1);
  CHECK(built.nested_components == 1);
  CHECK(volume(built.mesh) == Approx(64 - 1 + 1));

  reverse_all(soup);  // all of it inside out
  built = build_mesh_with_report(soup);
  CHECK(volume(built.mesh) == Approx(64 - 1 + 1));
  CHECK(built.nested_components == 1);
}

TEST_CASE("isolated vertices keep their numbers") {
  std::vector<Vector3> points{{7, 7, 7}};
  points.insert(points.end(), kTetrahedronPoints.begin(), kTetrahedronPoints.end());
  Polygons polygons = kTetrahedron;
  for (auto& polygon : polygons)
    for (Index& v : polygon) ++v;
  const BuiltMesh built = build_mesh_with_report(soup_of(points, polygons));
  CHECK(built.isolated_vertices == 1);
  REQUIRE(built.mesh.n_vertices() == 5);
  CHECK(to_vector3(built.mesh.point(OpenMesh::VertexHandle(0))) == points[0]);
  CHECK(make_snapshot(built.mesh).vertex_halfedge[0] == kNone);
}

TEST_CASE("what is no closed manifold is refused with counts and names") {
  const auto refused = [](const std::vector<Vector3>& points, const Polygons& polygons,
                          const std::string& what) {
    CHECK_THROWS_AS(build_mesh(soup_of(points, polygons)), MeshError);
    CHECK_THROWS_WITH(build_mesh(soup_of(points, polygons)), Contains(what));
  };
  const auto& t = kTetrahedronPoints;
  refused(t, {}, "no faces");
  refused(t, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}},
          "not closed: 3 boundary edges in 1 loop, first 0-2, 0-3, 2-3");
  refused(t, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {2, 0, 3}},
          "3 edges have more than two faces, first 0-2 (3 faces)");
  refused(t, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {2, 0, 3}},
          "1 face is given twice, first 4 (as 3)");
  refused(t, {{0, 1, 2}, {2, 1, 0}}, "1 face is given twice, first 1 (as 0)");
  refused(t, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 2}}, "1 face repeats a vertex, first 3");
  refused(t, {{0, 2, 1}, {0, 1}, {1, 2, 3}, {2}}, "2 faces have fewer than three corners, first 1, 3");
  refused(t, {{0, 2, 1}, {0, 1, 4}}, "1 face has a vertex index out of range, first 1");
  auto infinite = t;
  infinite[2][1] = std::numeric_limits<double>::infinity();
  refused(infinite, kTetrahedron, "1 vertex has a coordinate that is not finite, first 2");

  // Two tetrahedra that share one vertex.
  std::vector<Vector3> points = t;
  points.insert(points.end(), {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  Polygons polygons = kTetrahedron;
  for (auto polygon : kTetrahedron) {
    for (Index& v : polygon) v = v == 0 ? 0 : v + 3;
    polygons.push_back(polygon);
  }
  refused(points, polygons, "several fans of faces meet at 1 vertex, first 0");
}

TEST_CASE("a closed surface with one side only is refused") {
  // The projective plane on six vertices: every two vertices share an edge.
  std::vector<Vector3> points;
  for (int i = 0; i < 6; ++i) points.emplace_back(i, i * i, i * i * i);
  const Polygons polygons{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                          {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  CHECK_THROWS_WITH(build_mesh(soup_of(points, polygons)), Contains("only one side"));
}

TEST_CASE("a mesh of any size is turned and reported like one of size 1") {
  for (const double scale : {1e-300, 1e-160, 1e-80, 1.0, 1e80, 1e150}) {
    PolygonSoup soup;
    soup.points = {{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}, {0, 0, scale}};
    for (const auto& f : {std::array<Index, 3>{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}})
      soup.add_triangle(f[0], f[1], f[2]);  // inside out
    const BuiltMesh built = build_mesh_with_report(soup);
    INFO(scale);
    CHECK(built.flipped_components == 1);
    CHECK(built.degenerate_faces == 0);
    CHECK(to_vector3(built.mesh.point(OpenMesh::VertexHandle(1))) == soup.points[1]);
  }
}
