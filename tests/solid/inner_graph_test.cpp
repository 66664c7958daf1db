// Ways inside where few triangles stand round a limb.
#include "mspskel/solid/detail/inner_graph.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/build_mesh.h"
#include "mspskel/repair/mend_soup.h"
#include "mspskel/solid/detail/way_by_rings.h"
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

TEST_CASE("the middles of rings lead round the bends of a tube of few triangles") {
  // Rings of three along a half circle.
  constexpr int kRings = 9;
  constexpr double kBend = 4, kRadius = 0.6;
  PolygonSoup soup;
  for (int i = 0; i < kRings; ++i) {
    const double angle = kPi * i / (kRings - 1);
    const Vector3 out(std::cos(angle), std::sin(angle), 0);
    for (int k = 0; k < 3; ++k) {
      const double turn = 2 * kPi * k / 3;
      soup.points.push_back(kBend * out +
                            kRadius * (std::cos(turn) * out + std::sin(turn) * Vector3::UnitZ()));
    }
  }
  soup.points.push_back({kBend, -1.5, 0});
  soup.points.push_back({-kBend, -1.5, 0});
  const Index tip = 3 * kRings, root = tip + 1;
  for (Index k = 0; k < 3; ++k) {
    const Index next = (k + 1) % 3;
    soup.add_triangle(tip, k, next);
    soup.add_triangle(root, 3 * (kRings - 1) + next, 3 * (kRings - 1) + k);
    for (Index i = 0; i + 1 < kRings; ++i) {
      soup.add_triangle(3 * i + k, 3 * i + 3 + k, 3 * i + next);
      soup.add_triangle(3 * i + next, 3 * i + 3 + k, 3 * i + 3 + next);
    }
  }
  const SurfaceSnapshot surface = make_snapshot(build_mesh(mend_soup(soup).soup));
  REQUIRE(surface.component_count == 1);
  const BoundingVolumeHierarchy solid(surface);
  const Vector3 goal = surface.frame.to_normalised({-kBend, -0.5, 0});
  REQUIRE(solid.inside(goal));
  Index top = 0;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if ((surface.frame.to_model(surface.position[v]) - Vector3(kBend, -1.5, 0)).norm() < 1e-6) top = v;
  std::vector<Vector3> way = detail::RingWay(surface, solid, top).run(3.0, 48, [&](const Vector3& x) {
    return !solid.segment_crosses(x, goal);
  });
  REQUIRE(way.size() > 3);
  way.insert(way.begin(), goal);
  for (std::size_t i = 1; i < way.size(); ++i) CHECK_FALSE(solid.segment_crosses(way[i - 1], way[i]));
  CHECK_FALSE(solid.segment_crosses(way.back(), way.back() + 0.98 * (surface.position[top] - way.back())));
  // Nowhere within half of that.
  CHECK(detail::RingWay(surface, solid, top)
            .run(0.1, 48, [&](const Vector3& x) { return !solid.segment_crosses(x, goal); })
            .empty());
}
