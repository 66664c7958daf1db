// Points inside the solid that several threads ask for.
#include "mspskel/arcs/detail/chord_points.h"

#include <catch2/catch.hpp>

#include "support/meshes.h"

using namespace mspskel;

TEST_CASE("the points inside are the same whoever asks, and stay where they are") {
  const SurfaceSnapshot surface = make_snapshot(test::torus(2, 0.7, 48, 24));
  const BoundingVolumeHierarchy solid(surface);
  const CrossingLabels none;
  const detail::ChordPoints alone(surface, solid, none), shared(surface, solid, none);
  using Layer = detail::ChordPoints::Layer;
  const Index asked = 2 * surface.vertex_count();
  const auto point = [&](const detail::ChordPoints& points, Index i) -> const detail::ChordPoints::Point& {
    return points(i / 2, i % 2 == 0 ? Layer::kMiddle : Layer::kShallow);
  };
  // Each point is asked for four times, by whichever thread comes by.
  std::vector<const detail::ChordPoints::Point*> found(4 * static_cast<std::size_t>(asked));
  parallel_for(
      4 * asked, "points", {4, {}}, [] { return 0; }, [&](Index i, int) { found[i] = &point(shared, i / 4); },
      1);
  for (Index i = 0; i < 4 * asked; ++i) {
    const detail::ChordPoints::Point& expected = point(alone, i / 4);
    REQUIRE(found[i] == &point(shared, i / 4));
    REQUIRE(found[i]->x == expected.x);
    REQUIRE(found[i]->clearance == expected.clearance);
    REQUIRE(expected.clearance > 0);
  }
}
