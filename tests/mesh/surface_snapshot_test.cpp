// The flat half-edge arrays against a tetrahedron that can be checked by hand.
#include "mspskel/mesh/surface_snapshot.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "mspskel/mesh/default_mesh.h"

using namespace mspskel;

namespace {
DefaultMesh tetrahedron() {
  DefaultMesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}), c = mesh.add_vertex({0, 1, 0}),
             d = mesh.add_vertex({0, 0, 1});
  mesh.add_face(a, c, b);
  mesh.add_face(a, b, d);
  mesh.add_face(b, c, d);
  mesh.add_face(c, a, d);
  return mesh;
}
}  // namespace

TEST_CASE("the snapshot of a tetrahedron is a closed half-edge structure") {
  const SurfaceSnapshot s = make_snapshot(tetrahedron());
  REQUIRE(s.face_count() == 4);
  CHECK(s.component_count == 1);
  for (Index h = 0; h < s.halfedge_count(); ++h) {
    CHECK(s.twin[s.twin[h]] == h);
    CHECK(s.origin[s.twin[h]] == s.target(h));
    CHECK(s.next(s.next(s.next(h))) == h);
  }
  const double area =
      std::accumulate(s.vertex_area.begin(), s.vertex_area.end(), 0.0) * s.frame.scale * s.frame.scale;
  CHECK(area == Approx(1.5 + std::sqrt(3.0) / 2));
  for (Index v = 0; v < 4; ++v) CHECK(s.normal[v].dot(s.position[v]) > 0);
}

TEST_CASE("an open mesh is refused and the edge named") {
  DefaultMesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}), c = mesh.add_vertex({0, 1, 0});
  mesh.add_face(a, b, c);
  CHECK_THROWS_AS(make_snapshot(mesh), MeshError);
}

TEST_CASE("a surface of any size has the normalised positions of one of size 1") {
  const SurfaceSnapshot one = make_snapshot(tetrahedron());
  for (const int exponent : {-900, -531, -200, 200, 480}) {
    DefaultMesh mesh = tetrahedron();
    const double scale = std::ldexp(1.0, exponent);
    for (const auto v : mesh.vertices()) mesh.set_point(v, mesh.point(v) * scale);
    const SurfaceSnapshot s = make_snapshot(mesh);
    CHECK(s.position == one.position);
    CHECK(s.frame.scale == one.frame.scale * scale);
    CHECK(s.frame.origin == one.frame.origin * scale);
  }
  DefaultMesh mesh = tetrahedron();
  for (const auto v : mesh.vertices()) mesh.set_point(v, mesh.point(v) * 1e160);
  CHECK_THROWS_WITH(make_snapshot(mesh), Catch::Contains("too large"));
}
