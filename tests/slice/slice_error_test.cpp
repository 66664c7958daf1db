// The slice error (Eq. 3.2) computed by hand on an octahedron, and its normalisations.
#include "mspskel/slice/slice_error.h"

#include <catch2/catch.hpp>

#include "mspskel/slice/minimum_slice_perimeter.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// The octahedron's slice x + 2z = 1 through vertex 0 = (1, 0, 0). It passes the middles of the edges from 4 =
// (0, 0, 1) to 1 and 3 = (0, ±1, 0) and the point (−1/3, 0, 2/3) on the edge from 2 = (−1, 0, 0) to 4. The
// slices at 0, …, 5 stand at these angles to that at 0.
struct ByHand {
  SurfaceSnapshot surface = make_snapshot(octahedron());
  SliceTracer tracer{surface};
  VertexSlices slices;
  Contour contour;

  explicit ByHand(const std::array<double, 6>& angle) {
    slices.resize(6);
    const Vector3 normal = Vector3(1, 0, 2).normalized();
    for (Index v = 0; v < 6; ++v) {
      slices.valid[v] = 1;
      // Of either sign: plane normals have none.
      slices.normal[v] =
          (v % 2 ? -1 : 1) * (Eigen::AngleAxisd(angle[v], Vector3::UnitY()).toRotationMatrix() * normal);
    }
    REQUIRE(slice_contour(tracer, slices, 0, contour));
    REQUIRE(contour.perimeter * surface.frame.scale == Approx(2 * side + 2 * top));
  }
  double error(SliceErrorAverage average) const {
    return detail::raw_slice_error(surface, slices, 0, contour, average);
  }

  static const double side, top;  // lengths from 0 to a middle and from there to (−1/3, 0, 2/3)
};
const double ByHand::side = std::sqrt(1.5);
const double ByHand::top = std::sqrt(14.0) / 6;

}  // namespace

TEST_CASE("both averages and the sum of Eq. 3.2 by hand") {
  const ByHand hand({0, 0.1, 0.4, 0.3, 0.6, 1.0});
  // At the crossings: 0 at the vertex itself, then the ends' angles in the crossing's shares.
  const double m1 = (0.1 + 0.6) / 2, m3 = (0.3 + 0.6) / 2, k = 0.4 / 3 + 0.6 * 2 / 3;
  CHECK(hand.error(SliceErrorAverage::kSum) == Approx(m1 + k + m3));
  CHECK(hand.error(SliceErrorAverage::kMean) == Approx((m1 + k + m3) / 4));
  const double integral = ByHand::side * (m1 / 2 + m3 / 2) + ByHand::top * ((m1 + k) / 2 + (k + m3) / 2);
  CHECK(hand.error(SliceErrorAverage::kArcMean) == Approx(integral / (2 * ByHand::side + 2 * ByHand::top)));
}

TEST_CASE("an edge's end without a slice leaves the word to the other, and two such count as a right angle") {
  ByHand hand({0, 0.1, 0.4, 0.3, 0.6, 1.0});
  hand.slices.valid[4] = 0;
  CHECK(hand.error(SliceErrorAverage::kSum) == Approx(0.1 + 0.4 + 0.3));
  hand.slices.valid[2] = 0;
  CHECK(hand.error(SliceErrorAverage::kSum) == Approx(0.1 + kPi / 2 + 0.3));
}

TEST_CASE("slices that agree have no error") {
  const ByHand hand({0, 0, 0, 0, 0, 0});
  for (const auto average : {SliceErrorAverage::kMean, SliceErrorAverage::kSum, SliceErrorAverage::kArcMean})
    CHECK(hand.error(average) == Approx(0).margin(1e-7));
}

TEST_CASE("angles between slices have no sign and end at a right angle") {
  const Vector3 x = Vector3::UnitX();
  for (const double angle : {0.0, 0.5, 1.5})
    for (const double sign : {1.0, -1.0}) {
      const Vector3 y = sign * Vector3(std::cos(angle), std::sin(angle), 0);
      CHECK(axis_angle(x, y) == Approx(angle).margin(1e-7));
    }
  CHECK(axis_angle(x, Vector3::UnitY()) == Approx(kPi / 2));
}

TEST_CASE("errors are normalised over the mesh or by the right angle") {
  const SurfaceSnapshot s = make_snapshot(jittered(tube(1.0, 4.0, 16, 10), 3, 0.15));
  const SliceTracer tracer(s);
  const VertexSlices slices = compute_minimum_slice_perimeters(tracer, {});
  for (const auto average :
       {SliceErrorAverage::kMean, SliceErrorAverage::kSum, SliceErrorAverage::kArcMean}) {
    VertexSlices range = slices, right = slices;
    compute_slice_errors(tracer, {average, SliceErrorScale::kMinMax}, range);
    compute_slice_errors(tracer, {average, SliceErrorScale::kRightAngle}, right);
    CHECK(*std::min_element(range.error.begin(), range.error.end()) == 0);
    CHECK(*std::max_element(range.error.begin(), range.error.end()) == 1);
    Contour contour;
    std::vector<double> raw;
    for (Index v = 0; v < s.vertex_count(); ++v) {
      REQUIRE(slice_contour(tracer, slices, v, contour));
      raw.push_back(detail::raw_slice_error(s, slices, v, contour, average));
      CHECK(right.error[v] == Approx(std::min(1.0, raw[v] / (kPi / 2))));
    }
    const auto [low, high] = std::minmax_element(raw.begin(), raw.end());
    for (Index v = 0; v < s.vertex_count(); ++v)
      CHECK(range.error[v] == Approx((raw[v] - *low) / (*high - *low)).margin(1e-12));
  }
}

TEST_CASE("where all errors are equal their range gives 0") {
  ByHand hand({0, 0, 0, 0, 0, 0});
  for (Index v = 1; v < 6; ++v) hand.slices.valid[v] = 0;
  compute_slice_errors(hand.tracer, {SliceErrorAverage::kMean, SliceErrorScale::kMinMax}, hand.slices);
  CHECK(hand.slices.error[0] == 0);
  for (Index v = 1; v < 6; ++v) CHECK(hand.slices.error[v] == 1);
}
