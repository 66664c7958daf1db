// Ways out of limbs of few triangles.
#include "mspskel/refine/detail/way_below.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/build_mesh.h"
#include "mspskel/repair/mend_soup.h"

using namespace mspskel;

TEST_CASE("A way below the surface leads round the bends of a tube of few triangles") {
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
  const auto sees_goal = [&](const Vector3& x) { return !solid.segment_crosses(x, goal); };
  std::vector<Vector3> way = detail::WayBelow(surface, solid).run(top, 1000, sees_goal);
  REQUIRE(way.size() > 3);
  way.insert(way.begin(), goal);
  for (std::size_t i = 1; i < way.size(); ++i) CHECK_FALSE(solid.segment_crosses(way[i - 1], way[i]));
  CHECK_FALSE(solid.segment_crosses(way.back(), way.back() + 0.98 * (surface.position[top] - way.back())));
  CHECK(detail::WayBelow(surface, solid).run(top, 5, sees_goal).empty());
}
