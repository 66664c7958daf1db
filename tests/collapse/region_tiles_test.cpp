// Flat regions in tiles: what lies inside is told by the outlines near a point.
#include "mspskel/collapse/detail/region_tiles.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "mspskel/collapse/crossing_labels.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;
using detail::Polygon2;
using detail::RegionTile;

namespace {

Polygon2 star(const Eigen::Vector2d& middle, double radius, double uneven, int points, Random& random) {
  Polygon2 polygon;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * kPi * i / points, r = radius * (1 + uneven * random.in_ball().x());
    polygon.push_back(middle + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

// Radii of 1.2 to 2.8 round the origin, with two holes in it.
std::vector<Polygon2> region_with_holes(int points, Random& random) {
  return {star({0, 0}, 2, 0.4, points, random), star({-0.5, 0.1}, 0.3, 0.5, points, random),
          star({0.5, -0.2}, 0.3, 0.5, points, random)};
}

// The sum of the angles under which the polygon is seen is a turn from inside.
bool encloses(const Polygon2& polygon, const Eigen::Vector2d& x) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i] - x, b = polygon[(i + 1) % polygon.size()] - x;
    sum += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(sum) > kPi;
}

bool encloses(const std::vector<Polygon2>& outlines, const Eigen::Vector2d& x) {
  bool inside = false;
  for (const Polygon2& outline : outlines) inside = inside != encloses(outline, x);
  return inside;
}

std::vector<RegionTile> tiles_of(const std::vector<Polygon2>& outlines) {
  std::vector<RegionTile> tiles;
  detail::tile_region(outlines, [&](RegionTile tile) { tiles.push_back(std::move(tile)); });
  return tiles;
}

// One handle whose cocycle is crossings with the region, in the plane z = 0.2.
VolumeCocycles crossings_with(const std::vector<Polygon2>& outlines) {
  VolumeCocycles cocycles;
  cocycles.rank = 1;
  cocycles.cocycle.resize(1);
  VolumeCocycle& cocycle = cocycles.cocycle[0];
  cocycle.source = CocycleSource::kHoledRegion;
  cocycle.component = 0;
  cocycle.plane = {Vector3::UnitZ(), 0.2};
  for (const Polygon2& outline : outlines) {
    Contour& contour = cocycle.contours.emplace_back();
    for (const Eigen::Vector2d& p : outline) contour.point.emplace_back(p.x(), p.y(), 0.2);
  }
  return cocycles;
}

}  // namespace

TEST_CASE("A point of a flat region lies in one tile, which tells it, and others in none that does") {
  Random random(4);
  for (const int points : {3, 8, 40, 300}) {
    const std::vector<Polygon2> outlines = region_with_holes(points, random);
    const std::vector<RegionTile> tiles = tiles_of(outlines);
    int inside = 0;
    for (int k = 0; k < 400; ++k) {
      const Eigen::Vector2d x = 3 * random.in_ball().head<2>();
      int holding = 0, telling = 0;
      for (const RegionTile& tile : tiles)
        if (tile.holds(x)) {
          ++holding;
          telling += tile.inside(x);
        }
      CHECK(holding <= 1);
      CHECK(telling == encloses(outlines, x));
      inside += telling;
    }
    CHECK(inside > 40);
    CHECK(inside < 360);
  }
}

// Of regular polygons with sides parted at their middles, at binary shares of their boxes.
TEST_CASE("Tiles tell regular outlines at places where these are even") {
  for (const int sides : {4, 6, 8, 12, 16})
    for (const double turn : {0.0, 0.125, 0.25, 0.5}) {
      Polygon2 outline;
      const auto corner = [&](int i) {
        const double angle = 2 * kPi * (i + turn) / sides;
        return Eigen::Vector2d(3 + std::cos(angle), 2 + std::sin(angle));
      };
      for (int i = 0; i < sides; ++i) {
        outline.push_back(corner(i));
        outline.push_back((corner(i) + corner(i + 1)) / 2);
      }
      const std::vector<RegionTile> tiles = tiles_of({outline});
      const Eigen::AlignedBox2d box = RegionTile({outline}).box();
      const double inner = std::cos(kPi / sides);
      for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
          const Eigen::Vector2d x = box.min() + Eigen::Vector2d(i, j).cwiseProduct(box.sizes()) / 64;
          const double distance = (x - Eigen::Vector2d(3, 2)).norm();
          if (distance > inner - 1e-6 && distance < 1 + 1e-6) continue;
          const auto telling = std::count_if(tiles.begin(), tiles.end(), [&](const RegionTile& tile) {
            return tile.holds(x) && tile.inside(x);
          });
          if (telling != (distance < 1)) FAIL(sides << " sides, turn " << turn << ", at " << i << ' ' << j);
        }
    }
}

TEST_CASE("A region has no more tiles than its outlines have points, and few pieces of them in each") {
  Random random(5);
  for (const int points : {8, 40, 300, 2000}) {
    const std::vector<Polygon2> outlines = region_with_holes(points, random);
    const std::vector<RegionTile> tiles = tiles_of(outlines);
    CHECK(tiles.size() <= static_cast<std::size_t>(3 * points) + 4);
    const Polygon2 round = star({0, 0}, 1, 0, points, random);
    std::size_t uneven = 0;
    for (const RegionTile& tile : tiles_of({round})) uneven += !tile.is_even();
    CHECK(uneven <= 6 * static_cast<std::size_t>(std::sqrt(points)) + 8);
  }
}

TEST_CASE("A ring goes round where it crosses a flat region with holes, whatever lies near") {
  Random random(6);
  const std::vector<Polygon2> outlines = region_with_holes(30, random);
  const CrossingLabels labels(crossings_with(outlines));
  int round = 0, null = 0;
  for (int k = 0; k < 600; ++k) {
    const Vector3 middle = 2 * random.in_ball();
    const double size = k % 2 == 0 ? 0.3 : 2.0;
    std::vector<Vector3> ring;
    int expected = 0;
    for (int i = 0; i < 5; ++i) ring.push_back(middle + size * random.in_ball());
    for (int i = 0; i < 5; ++i) {
      const Vector3 &a = ring[i], &b = ring[(i + 1) % 5];
      if ((a.z() >= 0.2) == (b.z() >= 0.2)) continue;
      const Vector3 x = a + (0.2 - a.z()) / (b.z() - a.z()) * (b - a);
      if (encloses(outlines, x.head<2>())) expected += b.z() > a.z() ? 1 : -1;
    }
    std::vector<Vector3> closed = ring;
    closed.push_back(ring.front());
    CHECK(labels.along(closed)[0] == expected);
    CHECK(labels.goes_round(ring) == (expected != 0));
    (expected != 0 ? round : null) += 1;
  }
  CHECK(round > 30);
  CHECK(null > 300);
}
