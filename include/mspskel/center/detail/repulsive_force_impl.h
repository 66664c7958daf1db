#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mspskel/base/clones.h"
#include "mspskel/base/linkage.h"

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

// Places relative to p, distances and their logarithms of up to kPoints consecutive points of a ring, shared
// by the segments at each point.
struct LogTable {
  static constexpr Index kPoints = PointTable::kPoints;
  double x[kPoints + PlanarRegion::kBlock], y[kPoints + PlanarRegion::kBlock];
  double r[kPoints + PlanarRegion::kBlock], log[kPoints + PlanarRegion::kBlock];

  // Points begin .. begin + count − 1; whole blocks are written.
  void fill(const PlanarRegion& region, Index begin, Index count, const Vector2& p) {
    // A contour point at p itself: its terms tend to 0 with the factors of the logarithm, which has to be
    // finite for that.
    constexpr double kTiny = 1e-300;
    for (Index i = 0; i < count; i += PlanarRegion::kBlock) {
      const Block dx = BlockMap(region.x() + begin + i) - p.x(),
                  dy = BlockMap(region.y() + begin + i) - p.y(), square = dx * dx + dy * dy;
      BlockOut{x + i} = dx;
      BlockOut{y + i} = dy;
      BlockOut{r + i} = square.sqrt();
      BlockOut{log + i} = 0.5 * square.max(kTiny).log();
    }
  }
};

// The angle from (1, 0) to (cosine, sine) / radius, −π to π: eight times that of the point whose tangent two
// halvings of the quarter angle give, a number below tan(π/8), for which a polynomial has 13 digits
// (interpolated at Chebyshev's nodes).
inline Block angle_of(const Block& sine, const Block& cosine, const Block& radius) {
  constexpr double kTiny = 1e-300;
  const Block square = sine * sine, half = cosine + radius;
  const Block quarter = half + (half * half + square).sqrt();
  const Block eighth = quarter + (quarter * quarter + square).sqrt();
  const Block t = sine / eighth.max(kTiny), z = t * t;
  Block sum = 0.03066449210747942 * z - 0.058746435882282115;
  sum = sum * z + 0.07563741384790575;
  sum = sum * z - 0.09078397493924625;
  sum = sum * z + 0.11110385477729276;
  sum = sum * z - 0.14285690442522142;
  sum = sum * z + 0.19999999605285537;
  sum = sum * z - 0.3333333333080634;
  return 8.0 * t * (sum * z + 0.9999999999999735);
}

struct AreaSums {
  Block potential = Block::Zero(), fx = Block::Zero(), fy = Block::Zero();
  Block xx = Block::Zero(), xy = Block::Zero(), yy = Block::Zero();

  void add(const LogTable& p, Index i, const double* tangent_x, const double* tangent_y,
           const double* segment_length) {
    const BlockMap ax(p.x + i), ay(p.y + i), bx(p.x + i + 1), by(p.y + i + 1), ra(p.r + i), rb(p.r + i + 1),
        log_a(p.log + i), log_b(p.log + i + 1), tx(tangent_x), ty(tangent_y), length(segment_length);
    const Block angle = angle_of(ax * by - ay * bx, ax * bx + ay * by, ra * rb);
    const Block h = ax * ty - ay * tx, stretch = log_b - log_a;  // the outward normal is (ty, −tx)
    const Block qx = angle * ty + stretch * tx, qy = stretch * ty - angle * tx;
    fx += h * qx;
    fy += h * qy;
    xx += qx * ty;
    xy += 0.5 * (qy * ty - qx * tx);
    yy -= qy * tx;
    potential +=
        0.5 * h * ((bx * tx + by * ty) * log_b - (ax * tx + ay * ty) * log_a + h * angle - 1.5 * length);
  }
};

}  // namespace detail::slice_centre

MSPSKEL_INLINE ForceSamples::ForceSamples(const std::vector<Vector2>& points)
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

MSPSKEL_INLINE Vector2 sampled_repulsive_force(const ForceSamples& force_samples, const Vector2& p) {
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

MSPSKEL_INLINE FieldValue repulsive_field(const PlanarRegion& region, const Vector2& p) {
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

MSPSKEL_AVX_CLONES MSPSKEL_INLINE FieldValue area_field(const PlanarRegion& region, const Vector2& p) {
  detail::slice_centre::LogTable table;
  detail::slice_centre::AreaSums sums;
  constexpr Index kChunk = detail::slice_centre::LogTable::kPoints;
  for (const PlanarRegion::Ring& ring : region.rings())
    for (Index chunk = 0; chunk < ring.segments; chunk += kChunk) {
      const Index begin = ring.begin + chunk, count = std::min(kChunk, ring.segments - chunk);
      table.fill(region, begin, count + 1, p);
      for (Index i = 0; i < count; i += PlanarRegion::kBlock)
        sums.add(table, i, region.tangent_x() + begin + i, region.tangent_y() + begin + i,
                 region.length() + begin + i);
    }
  FieldValue value;
  value.potential = sums.potential.sum();
  value.force = {sums.fx.sum(), sums.fy.sum()};
  value.xx = sums.xx.sum();
  value.xy = sums.xy.sum();
  value.yy = sums.yy.sum();
  return value;
}

MSPSKEL_INLINE Vector2 visible_field(const PlanarRegion& region, const Vector2& p, Index rays) {
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
