// Every term of the cost by hand, merging sets as sums, saturation.
#include "mspskel/collapse/collapse_cost.h"

#include <catch2/catch.hpp>
#include <random>

#include "mspskel/collapse/collapse_options.h"
#include "mspskel/collapse/saturation.h"

using namespace mspskel;

namespace {
MergingVertex vertex(const Vector3& position, double perimeter, const Vector3& normal, double error,
                     double area = 1.0) {
  return {position, perimeter, normal, error, area, true};
}
}  // namespace

TEST_CASE("compactness by hand: the product of the three terms of Eq. 4.2") {
  CostTerms t;
  t.perimeter_ratio = perimeter_ratio(2.0, 3.0);
  t.relative_length = 0.5;
  t.angle = kPi / 3;
  CHECK(t.perimeter_ratio == Approx(1.5));
  CHECK(compactness_metric(t) == Approx(2.25 * 0.25 / 3));
  t.slice_error = 0.4;
  CHECK(total_cost(t, 0.1) == Approx(2.25 * 0.25 / 3 + 0.06));
  CHECK(total_cost(t, 0.0) == Approx(compactness_metric(t)));
}

TEST_CASE("an angle floor keeps the product from vanishing") {
  CostTerms t;
  t.relative_length = 0.5;
  CHECK(compactness_metric(t) == 0.0);
  CHECK(compactness_metric(t, kPi / 10) == Approx(0.025));
  t.angle = kPi / 2;
  CHECK(compactness_metric(t, kPi / 10) == Approx(0.125));
}

TEST_CASE("an unknown perimeter or normal is no evidence of a difference") {
  CHECK(perimeter_ratio(0.0, 3.0) == 1.0);
  CHECK(perimeter_ratio(0.0, 0.0) == 1.0);
  CHECK(axis_angle(Vector3::Zero(), Vector3::UnitX()) == 0.0);
}

TEST_CASE("normals have no sign") {
  const Vector3 a = Vector3(1, 2, 3).normalized(), b = Vector3(-2, 1, 1).normalized();
  CHECK(axis_angle(a, b) == Approx(std::acos(std::abs(a.dot(b)))));
  CHECK(axis_angle(a, -b) == Approx(axis_angle(a, b)));
  CHECK(axis_angle(a, -a) == Approx(0.0).margin(1e-12));
}

TEST_CASE("means over a merging set are weighted by 1 - E_s") {
  MergingSet set(vertex({0, 0, 0}, 1.0, Vector3::UnitX(), 0.0, 2.0));
  set.merge(MergingSet(vertex({1, 0, 0}, 4.0, Vector3::UnitX(), 0.5, 3.0)));
  CHECK(set.count() == 2);
  CHECK(set.area() == Approx(5.0));
  CHECK(set.error() == Approx(0.25));
  CHECK(set.perimeter() == Approx((1.0 + 0.5 * 4.0) / 1.5));
  CHECK(set.position().x() == Approx(0.5 / 1.5));
  CHECK(axis_angle(set.axis(), Vector3::UnitX()) == Approx(0.0).margin(1e-9));
}

TEST_CASE("opposite normals are one axis, and their mean does not cancel") {
  MergingSet set(vertex({0, 0, 0}, 1.0, Vector3(1, 0.1, 0).normalized(), 0.0));
  set.merge(MergingSet(vertex({0, 0, 0}, 1.0, Vector3(-1, 0.1, 0).normalized(), 0.0)));
  CHECK(axis_angle(set.axis(), Vector3::UnitX()) == Approx(0.0).margin(1e-7));
}

TEST_CASE("where all weights vanish the means are plain, over vertices with a slice first") {
  MergingSet zero(vertex({0, 0, 0}, 1.0, Vector3::UnitX(), 1.0)),
      other(vertex({2, 0, 0}, 3.0, Vector3::UnitX(), 1.0));
  MergingVertex none = vertex({9, 9, 9}, 0.0, Vector3::Zero(), 1.0);
  none.valid = false;
  MergingSet set{none};
  CHECK(set.perimeter() == 0.0);
  CHECK(set.position().x() == Approx(9.0));
  set.merge(zero);
  set.merge(other);
  CHECK(set.perimeter() == Approx(2.0));
  CHECK(set.position().x() == Approx(1.0));
  CHECK(set.count() == 3);
  set.merge(MergingSet(vertex({5, 0, 0}, 7.0, Vector3::UnitX(), 0.9)));
  CHECK(set.perimeter() == Approx(7.0));
  CHECK(set.position().x() == Approx(5.0));
}

TEST_CASE("the order of merges does not matter") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<MergingSet> sets;
  for (int i = 0; i < 12; ++i) {
    const Vector3 position{uniform(random), uniform(random), uniform(random)};
    const Vector3 normal{uniform(random), uniform(random), 0.1};
    const double perimeter = uniform(random), error = uniform(random);
    MergingVertex v = vertex(position, perimeter, normal.normalized(), i % 4 == 0 ? 1.0 : error);
    v.valid = i % 5 != 0;
    sets.emplace_back(v);
  }
  MergingSet forward, backward, halves, right;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    forward.merge(sets[i]);
    backward.merge(sets[sets.size() - 1 - i]);
    (i % 2 == 0 ? halves : right).merge(sets[i]);
  }
  halves.merge(right);
  for (const MergingSet& set : {backward, halves}) {
    CHECK(set.perimeter() == Approx(forward.perimeter()));
    CHECK((set.position() - forward.position()).norm() < 1e-12);
    CHECK(axis_angle(set.axis(), forward.axis()) < 1e-6);
    CHECK(set.error() == Approx(forward.error()));
  }
}

TEST_CASE("M_s is the mean error over both sets") {
  MergingSet u(vertex({0, 0, 0}, 1, Vector3::UnitX(), 0.2)), v(vertex({0, 0, 0}, 1, Vector3::UnitX(), 0.5));
  u.merge(MergingSet(vertex({0, 0, 0}, 1, Vector3::UnitX(), 0.8)));
  CHECK(slice_error_metric(u, v) == Approx(0.5));
}

TEST_CASE("saturation by hand: the squared ratio of perimeters times the ratio of areas") {
  const MergingSet small(vertex({0, 0, 0}, 2.0, Vector3::UnitX(), 0.0, 1.0)),
      large(vertex({0, 0, 0}, 6.0, Vector3::UnitX(), 0.0, 4.0));
  CHECK(edge_saturation(small, large) == Approx(9.0 / 4.0));
  CHECK(edge_saturation(large, small) == Approx(9.0 / 4.0));
  CHECK(edge_saturation(small, small) == Approx(1.0));
  CHECK(edge_saturation(MergingSet(), MergingSet()) == 0.0);
}

TEST_CASE("options out of range are refused by name") {
  CollapseOptions options;
  CHECK_NOTHROW(validate(options));
  options.lambda = -1;
  CHECK_THROWS_WITH(validate(options), Catch::Contains("lambda"));
  options = {};
  options.saturation_threshold = std::nan("");
  CHECK_THROWS_WITH(validate(options), Catch::Contains("saturation_threshold"));
  options = {};
  options.angle_floor = 2;
  CHECK_THROWS_WITH(validate(options), Catch::Contains("angle_floor"));
}
