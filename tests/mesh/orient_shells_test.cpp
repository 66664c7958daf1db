// Inner shells turn over, everything else stays.
#include "mspskel/mesh/orient_shells.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/build_mesh.h"
#include "mspskel/samples/samples.h"
#include "support/meshes.h"

using namespace mspskel;

TEST_CASE("A surface without inner shells needs no turning") {
  CHECK_FALSE(orient_shells_outward(make_snapshot(test::sphere(300))).has_value());
}

TEST_CASE("The shell of a cavity is turned over and stays a half-edge structure") {
  const SurfaceSnapshot shell = make_snapshot(build_mesh(make_sample("shell", {})));
  const auto turned = orient_shells_outward(shell);
  REQUIRE(turned.has_value());
  REQUIRE(shell.component_count == 2);
  std::vector<double> volume(2, 0.0);
  for (Index h = 0; h < turned->halfedge_count(); ++h) {
    CHECK(turned->twin[turned->twin[h]] == h);
    CHECK(turned->origin[turned->twin[h]] == turned->target(h));
    CHECK(turned->origin[turned->vertex_halfedge[turned->origin[h]]] == turned->origin[h]);
  }
  for (Index f = 0; f < turned->face_count(); ++f) {
    const Vector3 &a = turned->position[turned->origin[3 * f]],
                  &b = turned->position[turned->origin[3 * f + 1]],
                  &c = turned->position[turned->origin[3 * f + 2]];
    volume[turned->component[turned->origin[3 * f]]] += a.dot(b.cross(c)) / 6;
  }
  CHECK(volume[0] > 0);
  CHECK(volume[1] > 0);
  for (Index v = 0; v < shell.vertex_count(); ++v) CHECK(turned->normal[v].dot(turned->position[v]) > 0);
}
