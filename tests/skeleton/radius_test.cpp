// Radii of nodes are distances to the surface, also where the surface is pressed to a line.
#include "mspskel/skeleton/radius.h"

#include <catch2/catch.hpp>
#include <random>

#include "support/meshes.h"

using namespace mspskel;

TEST_CASE("radii in a solid that is pressed to a line are finite, however near the nodes are to each other") {
  PolygonSoup soup = test::to_soup(test::torus(2, 0.7, 24, 12));
  for (Vector3& p : soup.points) p = {p[0], 1e-10 * p[1], 1e-10 * p[2]};
  const SurfaceSnapshot surface = make_snapshot(test::to_mesh(soup));
  const BoundingVolumeHierarchy hierarchy(surface);
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  CurveSkeleton skeleton;
  for (int i = 0; i < 4000; ++i) {
    if (i % 20 == 0) skeleton.nodes.emplace_back().position = {2.5 * uniform(generator), 0, 0};
    const Vector3 last = skeleton.nodes.back().position;
    skeleton.nodes.emplace_back().position =
        last + 1e-14 * Vector3(uniform(generator), uniform(generator), 0);
  }
  set_radii(surface, hierarchy, skeleton);
  for (const SkeletonNode& node : skeleton.nodes) {
    CHECK(std::isfinite(node.radius));
    CHECK(node.radius <= 1e-9);
  }
}
