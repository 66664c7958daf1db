// Ways inside where few triangles stand round a limb.
#include "mspskel/solid/detail/inner_graph.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/build_mesh.h"
#include "mspskel/repair/mend_soup.h"
#include "support/soups.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// A bar and a chain of two cubes that hangs on it by an edge, so that bridges of three edges join them.
SurfaceSnapshot bar_with_chain() {
  VoxelSolid solid;
  for (int x = 0; x < 9; ++x)
    for (const auto& [y, z] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) solid.cells.insert({x, y, z});
  for (const Cell& c : {Cell{4, 2, 2}, {5, 3, 2}}) solid.cells.insert(c);
  return make_snapshot(build_mesh(mend_soup(boundary(solid)).soup));
}

}  // namespace

TEST_CASE("three edges that close up and are no face are a gate, and a path leads through it") {
  const SurfaceSnapshot surface = bar_with_chain();
  REQUIRE(surface.component_count == 1);
  CHECK(detail::find_gates(surface).size() >= 2);
  const BoundingVolumeHierarchy solid(surface);
  const Vector3 end = surface.frame.to_normalised({5.5, 3.5, 2.5}),
                bar = surface.frame.to_normalised({4.5, 1, 1});
  detail::InnerPaths paths(surface, solid, {}, detail::InnerSurface::kInput);
  paths.prepare();
  std::vector<Vector3> way;
  REQUIRE(paths.path(end, bar, way));
  way.insert(way.begin(), end);
  way.push_back(bar);
  for (std::size_t i = 1; i < way.size(); ++i) CHECK_FALSE(solid.segment_crosses(way[i - 1], way[i]));
}

TEST_CASE("the surface of a voxel block of many faces has no gates") {
  VoxelSolid solid;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y) solid.cells.insert({x, y, 0});
  CHECK(detail::find_gates(make_snapshot(build_mesh(boundary(solid)))).empty());
}
