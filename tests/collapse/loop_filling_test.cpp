// Surfaces that fill closed polygons: signed crossings are linking numbers, and only what is near is met.
#include "mspskel/collapse/detail/loop_filling.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "mspskel/collapse/crossing_labels.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Gauss's integral: the solid angles that pairs of edges span, over 4π (Klenin and Langowski 2000).
double linking_number(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vector3 &a0 = a[i], &a1 = a[(i + 1) % a.size()], &b0 = b[j], &b1 = b[(j + 1) % b.size()];
      const Vector3 r[4] = {b0 - a0, b1 - a0, b1 - a1, b0 - a1};
      Vector3 n[4];
      for (int k = 0; k < 4; ++k) n[k] = r[k].cross(r[(k + 1) % 4]).normalized();
      double angle = 0;
      for (int k = 0; k < 4; ++k) angle += std::asin(std::max(-1.0, std::min(1.0, n[k].dot(n[(k + 1) % 4]))));
      const double side = (b1 - b0).cross(a1 - a0).dot(r[0]);
      sum += side > 0 ? angle : -angle;
    }
  return sum / (4 * kPi);
}

std::vector<Vector3> random_polygon(int points, Random& random) {
  std::vector<Vector3> polygon;
  for (int i = 0; i < points; ++i) polygon.push_back(0.5 * random.in_ball());
  return polygon;
}

// One handle whose cocycle is the linking number with the loop.
VolumeCocycles linked_with(const std::vector<Vector3>& loop) {
  VolumeCocycles cocycles;
  cocycles.rank = 1;
  cocycles.cocycle.resize(1);
  cocycles.cocycle[0].source = CocycleSource::kLinking;
  cocycles.cocycle[0].component = 0;
  cocycles.cocycle[0].loop = loop;
  return cocycles;
}

}  // namespace

TEST_CASE("Signed crossings with a surface that fills a loop are the linking number, whichever surface") {
  Random random(2);
  Index linked = 0;
  for (int k = 0; k < 40; ++k) {
    const std::vector<Vector3> loop = random_polygon(3 + k, random), other = random_polygon(7, random);
    const double expected = linking_number(loop, other);
    linked += std::abs(expected) > 0.5;
    for (const int attempt : {0, 1, 5}) {
      const CrossingLabels labels(linked_with(loop), attempt);
      REQUIRE(labels.has_loops());
      bool clear = true;
      CocycleLabel sum, by_others;
      for (std::size_t i = 0; i < other.size(); ++i) {
        const Vector3 &p = other[i], &q = other[(i + 1) % other.size()];
        sum += labels(p, q, clear);
        by_others += labels.by_other_surfaces(p, q, clear);
      }
      CHECK(clear);
      CHECK(std::abs(sum[0] - expected) < 1e-6);
      CHECK(by_others == sum);
      CHECK(labels.goes_round(other) == !sum.is_zero());
    }
  }
  CHECK(linked > 5);
}

TEST_CASE("The axis of a regular loop meets no chord of its surface") {
  for (const int points : {3, 5, 8, 10, 12, 16, 24, 100, 128}) {
    std::vector<Vector3> loop;
    for (int i = 0; i < points; ++i)
      loop.emplace_back(0.3 * std::cos(2 * kPi * i / points), 0.3 * std::sin(2 * kPi * i / points), 0.0);
    const CrossingLabels labels(linked_with(loop));
    bool clear = true;
    CHECK(labels({0, 0, -0.1}, {0, 0, 0.1}, clear) == CocycleLabel::unit(0));
    CHECK(labels({0, 0, 0.1}, {0, 0, -0.1}, clear) == CocycleLabel::unit(0, -1));
    CHECK(clear);
  }
}

// Where crossings with an endless curtain below a loop would count, ways far below it would have labels, and
// sums of them many entries in a solid with many loops.
TEST_CASE("Ways beside a loop's box have no label") {
  Random random(7);
  const std::vector<Vector3> loop = random_polygon(50, random);
  const CrossingLabels labels(linked_with(loop));
  for (int k = 0; k < 2000; ++k) {
    Vector3 away = random.in_ball();
    away *= 0.9 / away.cwiseAbs().maxCoeff();
    bool clear = true;
    CHECK(labels(away, away + 0.3 * random.in_ball(), clear).is_zero());
    CHECK(clear);
  }
}

TEST_CASE("A surface is parted until its triangles are small beside a round loop, and no finer") {
  constexpr int kPoints = 400;
  std::vector<Vector3> loop;
  for (int i = 0; i < kPoints; ++i)
    loop.emplace_back(std::cos(2 * kPi * i / kPoints), std::sin(2 * kPi * i / kPoints), 0.1);
  Index triangles = 0;
  double longest = 0;
  detail::fill_polygon(loop, 17, [&](const detail::FillingTriangle& t) {
    ++triangles;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (t[(k + 1) % 3] - t[k]).norm());
  });
  CHECK(longest < 0.2);
  CHECK(triangles < 6 * kPoints);
}
