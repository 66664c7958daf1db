#include "mspskel/center/repulsive_force.h"

#include <catch2/catch.hpp>

#include "center/planar_shapes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Gauss-Legendre, eight points on [0, 1].
constexpr double kNode[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
constexpr double kWeight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                               0.1012285362903763};

template <class Function>
void integrate(const Vector2& a, const Vector2& b, Index pieces, Function f) {
  for (Index k = 0; k < pieces; ++k)
    for (int i = 0; i < 4; ++i)
      for (double sign : {-1.0, 1.0}) {
        const double t = (k + 0.5 + 0.5 * sign * kNode[i]) / pieces;
        f(Vector2(a + t * (b - a)), kWeight[i] / 2 / pieces * (b - a).norm());
      }
}

FieldValue repulsive_quadrature(const PlanarRegion& region, const Vector2& p) {
  FieldValue value;
  for (const auto& ring : region.rings())
    for (Index i = ring.begin; i < ring.begin + ring.points; ++i)
      integrate(region.point(i), region.point(i + 1), 64, [&](const Vector2& y, double w) {
        const Vector2 d = p - y;
        value.potential += w / d.norm();
        value.force += w / (d.squaredNorm() * d.norm()) * d;
      });
  return value;
}

// The divergence theorem on the contour, a different route from the closed form: F = ∮ ln r n ds, U = ∮ r·n
// (ln r − 1/2) / 2 ds.
FieldValue area_quadrature(const PlanarRegion& region, const Vector2& p) {
  FieldValue value;
  for (const auto& ring : region.rings())
    for (Index i = ring.begin; i < ring.begin + ring.points; ++i) {
      const Vector2 n = -turn_left(region.point(i + 1) - region.point(i)).normalized();
      integrate(region.point(i), region.point(i + 1), 64, [&](const Vector2& y, double w) {
        const Vector2 d = y - p;
        value.force += w * std::log(d.norm()) * n;
        value.potential += w * d.dot(n) * (0.5 * std::log(d.norm()) - 0.25);
      });
    }
  return value;
}

template <class Field>
void check_derivatives(Field field, const Vector2& p, double step, double tolerance) {
  const FieldValue f = field(p);
  const Vector2 ex(step, 0), ey(0, step);
  const FieldValue xp = field(p + ex), xm = field(p - ex), yp = field(p + ey), ym = field(p - ey);
  const double scale = std::abs(f.xx) + std::abs(f.yy) + f.force.norm() + 1;
  CHECK(std::abs(-(xp.potential - xm.potential) / (2 * step) - f.force.x()) < tolerance * scale);
  CHECK(std::abs(-(yp.potential - ym.potential) / (2 * step) - f.force.y()) < tolerance * scale);
  CHECK(std::abs(-(xp.force.x() - xm.force.x()) / (2 * step) - f.xx) < tolerance * scale);
  CHECK(std::abs(-(yp.force.y() - ym.force.y()) / (2 * step) - f.yy) < tolerance * scale);
  CHECK(std::abs(-(xp.force.y() - xm.force.y()) / (2 * step) - f.xy) < tolerance * scale);
}

const std::vector<Vector2> kInsideU = {{0.5, 0.5}, {2, 0.4}, {3.3, 3.7}, {0.2, 3.9}, {2.9, 0.9}};
PlanarRegion holed_u() { return PlanarRegion(u_shape(), {ellipse(0.1, 0.05, 11, {3.6, 0.6})}); }

}  // namespace

TEST_CASE("closed-form repulsion equals quadrature") {
  const PlanarRegion region = holed_u();
  for (const Vector2& p : kInsideU) {
    const FieldValue exact = repulsive_field(region, p), sum = repulsive_quadrature(region, p);
    CHECK(exact.potential == Approx(sum.potential).epsilon(1e-9));
    CHECK((exact.force - sum.force).norm() < 1e-8 * (1 + sum.force.norm()));
  }
}

TEST_CASE("repulsive force is minus the potential's gradient, and the Hessian its derivative") {
  const PlanarRegion region = holed_u();
  for (const Vector2& p : kInsideU) {
    check_derivatives([&](const Vector2& q) { return repulsive_field(region, q); }, p, 1e-5, 1e-6);
    const FieldValue f = repulsive_field(region, p);
    CHECK(f.xx + f.yy > 0);  // subharmonic
  }
}

TEST_CASE("repulsion near a contour keeps its accuracy and points inward") {
  const PlanarRegion region(rectangle(2, 1, 1));
  for (double h : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const FieldValue f = repulsive_field(region, {0.1, -0.5 + h});
    CHECK(f.force.y() * h == Approx(2).epsilon(1e-2));  // 2 / h: the field of an endless wall
    CHECK(std::isfinite(f.potential));
    CHECK(f.potential > -2 * std::log(h));
  }
  const Vector2 p(0.1, -0.5 + 1e-6);
  const FieldValue f = repulsive_field(region, p);
  CHECK(f.yy * 1e-12 == Approx(2).epsilon(1e-4));
}

TEST_CASE("the potential does not depend on how a straight side is cut into segments") {
  const PlanarRegion coarse(rectangle(4, 1, 1)), fine(rectangle(4, 1, 37));
  for (const Vector2& p : {Vector2(0.3, 0.2), Vector2(-1.9, 0.4)}) {
    const FieldValue a = repulsive_field(coarse, p), b = repulsive_field(fine, p);
    CHECK(a.potential == Approx(b.potential).epsilon(1e-12));
    CHECK((a.force - b.force).norm() < 1e-11 * (1 + a.force.norm()));
    const FieldValue c = area_field(coarse, p), d = area_field(fine, p);
    CHECK(c.potential == Approx(d.potential).epsilon(1e-11));
    CHECK((c.force - d.force).norm() < 1e-12);
  }
}

TEST_CASE("sampled repulsion tends to the closed form") {
  const PlanarRegion region(u_shape());
  std::vector<Vector2> samples;
  for (const auto& s : region.sample(0, 20000)) samples.push_back(s.point);
  const Vector2 p(2, 0.4);
  const Vector2 mean = sampled_repulsive_force(samples, p) * region.perimeter() / 20000.0;
  CHECK((mean - repulsive_field(region, p).force).norm() < 1e-4 * mean.norm());
}

TEST_CASE("area field equals the contour integral of the divergence theorem") {
  const PlanarRegion region = holed_u();
  for (const Vector2& p : kInsideU) {
    const FieldValue exact = area_field(region, p), sum = area_quadrature(region, p);
    CHECK(exact.potential == Approx(sum.potential).epsilon(1e-9));
    CHECK((exact.force - sum.force).norm() < 1e-9);
    CHECK(exact.xx + exact.yy == Approx(2 * kPi));
    check_derivatives([&](const Vector2& q) { return area_field(region, q); }, p, 1e-5, 1e-7);
  }
}

TEST_CASE("the area field holds beside and on its contour, where segments are seen under any angle") {
  const PlanarRegion region(rectangle(2, 1, 1));
  for (const double height : {0.49, 0.4999999, 0.5, 0.5000001, 0.51})
    for (const double x : {-0.9, 0.0, 0.3}) {
      const Vector2 p(x, height);
      const FieldValue value = area_field(region, p);
      CAPTURE(height, x);
      CHECK(std::isfinite(value.potential));
      // A segment's share of the Hessian's trace is the angle under which it is seen.
      if (height != 0.5) CHECK(value.xx + value.yy == Approx(height < 0.5 ? 2 * kPi : 0.0).margin(1e-7));
      const FieldValue mirrored = area_field(region, {-x, -height});
      CHECK((value.force + mirrored.force).norm() < 1e-11);
      CHECK(value.potential == Approx(mirrored.potential).epsilon(1e-11));
    }
  const FieldValue corner = area_field(region, region.point(0));
  CHECK(std::isfinite(corner.potential));
  CHECK(std::isfinite(corner.force.norm()));
}

TEST_CASE("area field equals a sum over small cells of the region") {
  const PlanarRegion region(rectangle(2, 1, 1));
  const Vector2 p(0.5, 0.2);
  Vector2 sum = Vector2::Zero();
  const Index n = 400;
  for (Index i = 0; i < 2 * n; ++i)
    for (Index k = 0; k < n; ++k) {
      const Vector2 d = Vector2(-1 + (i + 0.5) / n, -0.5 + (k + 0.5) / n) - p;
      if (d.norm() > 1e-9) sum += d / d.squaredNorm() / (n * n);
    }
  CHECK((area_field(region, p).force - sum).norm() < 1e-3);
}

TEST_CASE("the visible field is the area field in convex regions and less where parts are hidden") {
  const PlanarRegion convex(ellipse(2, 1, 60));
  const Vector2 p(0.7, -0.3);
  CHECK((visible_field(convex, p, 4000) - area_field(convex, p).force).norm() < 1e-4);

  // From the foot of one arm of a U the other arm is hidden behind the gap.
  const PlanarRegion u(u_shape());
  CHECK(visible_field(u, {0.5, 2.5}, 4000).x() < area_field(u, {0.5, 2.5}).force.x());
}
