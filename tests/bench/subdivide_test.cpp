#include "../../apps/bench/subdivide.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/build_mesh.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/samples/samples.h"

using namespace mspskel;

namespace {

double volume(const PolygonSoup& soup) {
  double sum = 0;
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    const Index* c = &soup.corners[soup.begin[f]];
    sum += soup.points[c[0]].dot(soup.points[c[1]].cross(soup.points[c[2]])) / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE("subdivision by midpoints keeps the surface, its orientation and its topology") {
  SampleOptions options;
  options.resolution = 500;
  const PolygonSoup torus = make_sample("torus", options);
  const PolygonSoup fine = bench::subdivided(torus);
  CHECK(fine.polygon_count() == 4 * torus.polygon_count());
  // One point an edge more, and a closed triangle mesh has three edges to two faces.
  CHECK(fine.points.size() == torus.points.size() + 3 * torus.polygon_count() / 2);
  CHECK(volume(fine) == Approx(volume(torus)).epsilon(1e-12));
  const SurfaceSnapshot surface = make_snapshot(build_mesh(fine));  // throws if it were not closed
  CHECK(surface.vertex_count() - surface.halfedge_count() / 2 + surface.face_count() == 0);
  for (std::size_t v = 0; v < torus.points.size(); ++v) CHECK(fine.points[v] == torus.points[v]);
}
