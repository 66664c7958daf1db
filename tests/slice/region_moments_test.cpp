// Half widths of planar regions from their moments.
#include "mspskel/slice/detail/region_moments.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "mspskel/base/types.h"
#include "mspskel/slice/slice_error.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

using Polygon = std::vector<std::array<double, 2>>;

double half_width(const Polygon& polygon) {
  detail::RegionMoments moments;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    moments.add(a[0], a[1], b[0], b[1]);
  }
  return moments.half_width();
}

Polygon rough_disc(double roughness) {
  Polygon polygon;
  for (int i = 0; i < 360; ++i) {
    const double angle = kPi * i / 180, r = 2 + (i % 2 == 0 ? roughness : -roughness);
    polygon.push_back({5 + r * std::cos(angle), -3 + r * std::sin(angle)});
  }
  return polygon;
}

}  // namespace

TEST_CASE("A rectangle is as wide as its longer side, wherever it lies and however it is turned") {
  for (const double angle : {0.0, 0.4, 1.3})
    for (const double b : {0.01, 0.5, 2.0}) {
      Polygon polygon;
      for (const auto& [x, y] : Polygon{{-2, -b}, {2, -b}, {2, b}, {-2, b}})
        polygon.push_back(
            {7 + std::cos(angle) * x - std::sin(angle) * y, 1 + std::sin(angle) * x + std::cos(angle) * y});
      CHECK(half_width(polygon) == Approx(2).epsilon(1e-9));
    }
}

TEST_CASE("A disc counts √3/2 radii, and a rough rim changes that by less than the roughness squared") {
  const double smooth = half_width(rough_disc(0));
  CHECK(smooth == Approx(std::sqrt(3.0)).epsilon(1e-3));
  CHECK(half_width(rough_disc(0.1)) == Approx(smooth).epsilon(0.01));
}

TEST_CASE("Nothing has no width") { CHECK(detail::RegionMoments().half_width() == 0); }

TEST_CASE("The slices of a tube are as wide as its radius says") {
  const SurfaceSnapshot surface = make_snapshot(tube(1, 10, 48, 61));
  const SliceTracer tracer(surface);
  VertexSlices slices;
  slices.resize(surface.vertex_count());
  const double expected = std::sqrt(3.0) / 2 / surface.frame.scale;
  Index checked = 0;
  for (Index v = 0; v < surface.vertex_count(); v += 7) {
    const Vector3 axis = Vector3::UnitZ();
    Contour contour;
    std::int64_t steps = 0;
    if (!tracer.shortest_contour(v, axis, contour, steps)) continue;
    const double radius = std::sqrt(contour.area / kPi);
    CHECK(detail::contour_half_width(contour, axis) == Approx(std::sqrt(3.0) / 2 * radius).epsilon(0.01));
    CHECK(detail::contour_half_width(contour, axis) <= 1.01 * expected);
    ++checked;
  }
  CHECK(checked > 100);
}
