#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mspskel {
namespace detail::slice_centre {

// Local values only, so their alignment is nobody else's concern.
using Block = Eigen::Array<double, PlanarRegion::kBlock, 1>;
using BlockMap = Eigen::Map<const Block>;
using BlockOut = Eigen::Map<Block>;

// Distances and directions from up to kPoints consecutive points of a ring to p, shared by the segments at
// each point.
struct PointTable {
  static constexpr Index kPoints = 64;
  double r[kPoints + PlanarRegion::kBlock], inverse[kPoints + PlanarRegion::kBlock];
  double ux[kPoints + PlanarRegion::kBlock], uy[kPoints + PlanarRegion::kBlock];

  // Points begin .. begin + count − 1; whole blocks are written.
  void fill(const PlanarRegion& region, Index begin, Index count, const Vector2& p) {
    for (Index i = 0; i < count; i += PlanarRegion::kBlock) {
      const Block dx = p.x() - BlockMap(region.x() + begin + i),
                  dy = p.y() - BlockMap(region.y() + begin + i);
      const Block radius = (dx * dx + dy * dy).sqrt(), inv = 1.0 / radius;
      BlockOut{r + i} = radius;
      BlockOut{inverse + i} = inv;
      BlockOut{ux + i} = dx * inv;
      BlockOut{uy + i} = dy * inv;
    }
  }
};

struct RepulsiveSums {
  Block product = Block::Ones(), fx = Block::Zero(), fy = Block::Zero();
  Block xx = Block::Zero(), xy = Block::Zero(), yy = Block::Zero();

  void add(const PointTable& t, Index i, const double* length) {
    const BlockMap r1(t.r + i), r2(t.r + i + 1), i1(t.inverse + i), i2(t.inverse + i + 1);
    const BlockMap u1x(t.ux + i), u1y(t.uy + i), u2x(t.ux + i + 1), u2y(t.uy + i + 1), l(length);
    const Block wx = u1x + u2x, wy = u1y + u2y, sum = r1 + r2, s = sum + l;
    const Block half_g = i1 * i2 / (wx * wx + wy * wy), lg = 2.0 * l * half_g;
    product *= s * s * half_g;
    fx += lg * wx;
    fy += lg * wy;
    const Block wall = 2.0 * lg * half_g * sum, g1 = lg * i1, g2 = lg * i2;
    xx += wall * wx * wx - g1 * u1y * u1y - g2 * u2y * u2y;
    xy += wall * wx * wy + g1 * u1x * u1y + g2 * u2x * u2y;
    yy += wall * wy * wy - g1 * u1x * u1x - g2 * u2x * u2x;
  }
};

}  // namespace detail::slice_centre

inline ForceSamples::ForceSamples(const std::vector<Vector2>& points)
    : count(static_cast<Index>(points.size())) {
  // Its square and cube are finite, and what is divided by them vanishes beside any sum of the others.
  constexpr double kFarAway = 1e100;
  const Index padded = (count + PlanarRegion::kBlock - 1) / PlanarRegion::kBlock * PlanarRegion::kBlock;
  x.assign(static_cast<std::size_t>(padded), kFarAway);
  y.assign(static_cast<std::size_t>(padded), kFarAway);
  for (Index i = 0; i < count; ++i) {
    x[i] = points[i].x();
    y[i] = points[i].y();
  }
}

inline Vector2 sampled_repulsive_force(const ForceSamples& force_samples, const Vector2& p) {
  using detail::slice_centre::Block;
  using detail::slice_centre::BlockMap;
  Block fx = Block::Zero(), fy = Block::Zero();
  for (std::size_t i = 0; i < force_samples.x.size(); i += PlanarRegion::kBlock) {
    const Block dx = p.x() - BlockMap(&force_samples.x[i]), dy = p.y() - BlockMap(&force_samples.y[i]);
    const Block square = dx * dx + dy * dy, weight = 1.0 / (square * square.sqrt());
    fx += weight * dx;
    fy += weight * dy;
  }
  return {fx.sum(), fy.sum()};
}

inline FieldValue repulsive_field(const PlanarRegion& region, const Vector2& p) {
  detail::slice_centre::PointTable table;
  detail::slice_centre::RepulsiveSums sums;
  detail::slice_centre::Block logs = detail::slice_centre::Block::Zero();
  constexpr Index kChunk = detail::slice_centre::PointTable::kPoints;
  for (const PlanarRegion::Ring& ring : region.rings())
    for (Index chunk = 0; chunk < ring.segments; chunk += kChunk) {
      const Index begin = ring.begin + chunk, count = std::min(kChunk, ring.segments - chunk);
      table.fill(region, begin, count + 1, p);
      for (Index i = 0; i < count; i += PlanarRegion::kBlock) sums.add(table, i, region.length() + begin + i);
      logs += sums.product.log();  // one logarithm for the eight factors of a lane
      sums.product.setOnes();
    }
  FieldValue value;
  value.potential = logs.sum();
  value.force = {sums.fx.sum(), sums.fy.sum()};
  value.xx = sums.xx.sum();
  value.xy = sums.xy.sum();
  value.yy = sums.yy.sum();
  return value;
}

inline FieldValue area_field(const PlanarRegion& region, const Vector2& p) {
  FieldValue value;
  const double *tx = region.tangent_x(), *ty = region.tangent_y(), *length = region.length();
  for (const PlanarRegion::Ring& ring : region.rings()) {
    Vector2 a = region.point(ring.begin) - p;
    double log_a = 0.5 * std::log(a.squaredNorm());
    for (Index i = ring.begin; i < ring.begin + ring.points; ++i) {
      const Vector2 b = region.point(i + 1) - p, t(tx[i], ty[i]), n(ty[i], -tx[i]);
      const double log_b = 0.5 * std::log(b.squaredNorm());
      // A contour point at p itself: its terms tend to 0 with h and s, so drop them rather than keep ∞ · 0.
      if (length[i] > 0 && std::isfinite(log_a) && std::isfinite(log_b)) {
        const double angle = std::atan2(cross(a, b), a.dot(b)), h = a.dot(n), stretch = log_b - log_a;
        const Vector2 q = angle * n + stretch * t;
        value.force += h * q;
        value.xx += q.x() * n.x();
        value.xy += 0.5 * (q.x() * n.y() + q.y() * n.x());
        value.yy += q.y() * n.y();
        const double logs = b.dot(t) * log_b - a.dot(t) * log_a - length[i] + h * angle;
        value.potential += 0.5 * h * (logs - 0.5 * length[i]);
      }
      a = b;
      log_a = log_b;
    }
  }
  return value;
}

inline Vector2 visible_field(const PlanarRegion& region, const Vector2& p, Index rays) {
  std::vector<double> reach(static_cast<std::size_t>(rays), std::numeric_limits<double>::infinity());
  const double spacing = 2 * kPi / rays;
  // Ray 0 points at the first contour point, so that the rays turn with the region.
  const Vector2 first = (region.point(0) - p).normalized();
  const auto turned = [&](const Vector2& d) { return Vector2(first.dot(d), cross(first, d)); };
  const double *tx = region.tangent_x(), *ty = region.tangent_y();
  for (const PlanarRegion::Ring& ring : region.rings())
    for (Index i = ring.begin; i < ring.begin + ring.points; ++i) {
      const Vector2 a = turned(region.point(i) - p), b = turned(region.point(i + 1) - p);
      const Vector2 n = turned(Vector2(ty[i], -tx[i]));
      const double sweep = std::atan2(cross(a, b), a.dot(b)), h = a.dot(n);
      if (!(sweep > 0)) continue;  // seen from its outer side, which something nearer hides
      const double from = std::atan2(a.y(), a.x()) / spacing, to = from + sweep / spacing;
      for (double k = std::ceil(from); k <= to; ++k) {
        const double angle = k * spacing, facing = std::cos(angle) * n.x() + std::sin(angle) * n.y();
        const Index slot = (static_cast<Index>(k) % rays + rays) % rays;
        if (facing > 0) reach[slot] = std::min(reach[slot], h / facing);
      }
    }
  Vector2 sum = Vector2::Zero();
  for (Index k = 0; k < rays; ++k)
    if (std::isfinite(reach[k]))
      sum += spacing * reach[k] * Vector2(std::cos(k * spacing), std::sin(k * spacing));
  return sum.x() * first + sum.y() * turn_left(first);
}

}  // namespace mspskel
