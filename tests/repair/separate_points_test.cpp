// Vertices in one place are drawn apart, by little and whatever lies round them.
#include "mspskel/repair/separate_points.h"

#include <array>
#include <catch2/catch.hpp>
#include <set>

#include "fuzz/fuzzed_meshes.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

std::size_t places(const PolygonSoup& soup) {
  std::set<std::array<double, 3>> all;
  for (const Vector3& p : soup.points) all.insert({p.x(), p.y(), p.z()});
  return all.size();
}

}  // namespace

TEST_CASE("Rounded surfaces get a place for each vertex, hardly beside its own") {
  for (const double grid : {0.1, 0.3, 0.8}) {
    CAPTURE(grid);
    PolygonSoup soup = to_soup(torus(1, 0.4, 80, 40));
    fuzz::round_coordinates(soup, grid);
    REQUIRE(places(soup) < soup.points.size());
    const PolygonSoup apart = separate_points(soup);
    CHECK(places(apart) == apart.points.size());
    CHECK(apart.corners == soup.corners);
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      CHECK((apart.points[v] - soup.points[v]).norm() < 0.05 * grid);
  }
}

TEST_CASE("All vertices in one place come apart, too") {
  PolygonSoup soup = to_soup(sphere(100));
  const std::size_t count = soup.points.size();
  for (std::size_t v = 1; v < count; ++v) soup.points[v] = soup.points[0];
  soup.points[1] += Vector3(1, 0, 0);
  CHECK(places(separate_points(soup)) == count);
}

TEST_CASE("A surface whose vertices lie apart stays as it is, to the bit") {
  const PolygonSoup soup = to_soup(torus(1, 0.4, 40, 20));
  CHECK(separate_points(soup).points == soup.points);
}
