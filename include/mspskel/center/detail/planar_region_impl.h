#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE PlaneFrame make_plane_frame(const std::vector<Vector3>& points, const Vector3& normal) {
  PlaneFrame frame;
  frame.origin.setZero();
  for (const Vector3& p : points) frame.origin += p;
  frame.origin /= static_cast<double>(points.size());
  const Vector3 out = points.front() - frame.origin;
  frame.u = out - normal.dot(out) * normal;
  const double norm = frame.u.norm();
  frame.u = norm > 0 ? Vector3(frame.u / norm) : normal.unitOrthogonal();
  frame.v = normal.cross(frame.u).normalized();
  frame.u = frame.v.cross(normal).normalized();
  return frame;
}

MSPSKEL_INLINE std::vector<Vector2> flatten(const std::vector<Vector3>& points, const PlaneFrame& frame) {
  std::vector<Vector2> polygon(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) polygon[i] = frame.to_plane(points[i]);
  return polygon;
}

MSPSKEL_INLINE PlanarRegion::PlanarRegion(const std::vector<Vector2>& outer,
                                          const std::vector<std::vector<Vector2>>& holes) {
  set_outer(outer);
  for (const auto& hole : holes) add_hole(hole);
}

MSPSKEL_INLINE void PlanarRegion::set_outer(const std::vector<Vector2>& polygon) {
  rings_.clear();
  x_.clear();
  y_.clear();
  length_.clear();
  tx_.clear();
  ty_.clear();
  strips_.clear();
  add_ring(polygon, 1.0);
}

MSPSKEL_INLINE void PlanarRegion::add_hole(const std::vector<Vector2>& polygon) { add_ring(polygon, -1.0); }

MSPSKEL_INLINE void PlanarRegion::add_ring(const std::vector<Vector2>& polygon, double sign) {
  if (polygon.empty()) return;
  Ring ring;
  ring.points = static_cast<Index>(polygon.size());
  ring.segments = (ring.points + kBlock - 1) / kBlock * kBlock;
  double twice = 0;
  for (Index i = 1; i + 1 < ring.points; ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  ring.area = sign * std::abs(twice) / 2;
  const bool reverse = twice * sign < 0;  // the first point stays first
  const auto drop_tail = [&](std::vector<double>& a, std::size_t n) { a.resize(n, 0.0); };
  ring.begin = rings_.empty() ? 0 : rings_.back().begin + rings_.back().segments + 1;
  const auto begin = static_cast<std::size_t>(ring.begin);
  const std::size_t end = begin + static_cast<std::size_t>(ring.segments) + 1;
  for (auto* a : {&x_, &y_, &length_, &tx_, &ty_}) {
    drop_tail(*a, begin);
    drop_tail(*a, end + kBlock);  // blocks of points may read past the last one
  }
  for (std::size_t i = begin; i < end; ++i) {
    const Index k = static_cast<Index>(i - begin);
    const Index source = k == 0 || k >= ring.points ? 0 : (reverse ? ring.points - k : k);
    x_[i] = polygon[source].x();
    y_[i] = polygon[source].y();
  }
  for (std::size_t i = begin; i + 1 < end; ++i) {
    const double dx = x_[i + 1] - x_[i], dy = y_[i + 1] - y_[i], length = std::sqrt(dx * dx + dy * dy);
    const double inverse = length > 1e-300 ? 1 / length : 0.0;
    length_[i] = length;
    tx_[i] = dx * inverse;
    ty_[i] = dy * inverse;
    ring.perimeter += length;
  }
  rings_.push_back(ring);
  strips_.add(y_, ring.begin, ring.begin + ring.segments);
}

MSPSKEL_INLINE bool PlanarRegion::valid() const {
  return !rings_.empty() && perimeter() > 0 && std::isfinite(perimeter()) &&
         rings_[0].area > 1e-12 * perimeter() * perimeter();
}

MSPSKEL_INLINE double PlanarRegion::area() const {
  double sum = 0;
  for (const Ring& ring : rings_) sum += ring.area;
  return sum;
}

MSPSKEL_INLINE Vector2 PlanarRegion::centroid() const {
  if (!(area() > 0)) return contour_centroid();
  const Vector2 base = point(0);
  Vector2 sum = Vector2::Zero();
  double twice_total = 0;
  for (const Ring& ring : rings_)
    for (Index i = ring.begin; i < ring.begin + ring.points; ++i) {
      const Vector2 a = point(i) - base, b = point(i + 1) - base;
      const double twice = cross(a, b);
      sum += twice * (a + b) / 3;
      twice_total += twice;
    }
  return base + sum / twice_total;
}

MSPSKEL_INLINE Vector2 PlanarRegion::contour_centroid() const {
  if (rings_.empty()) return Vector2::Zero();
  const Vector2 base = point(0);
  if (!(perimeter() > 0)) return base;
  Vector2 sum = Vector2::Zero();
  for (Index i = 0; i < rings_[0].points; ++i)
    sum += length_[i] * ((point(i) - base) + (point(i + 1) - base)) / 2;
  return base + sum / perimeter();
}

MSPSKEL_INLINE double PlanarRegion::roundness() const {
  return perimeter() > 0 ? 4 * kPi * rings_[0].area / (perimeter() * perimeter()) : 0.0;
}

MSPSKEL_INLINE double PlanarRegion::mean_width() const {
  double length = 0;
  for (const Ring& ring : rings_) length += ring.perimeter;
  return length > 0 ? 2 * area() / length : 0.0;
}

MSPSKEL_INLINE bool PlanarRegion::contains(const Vector2& p) const {
  int parity = 0;
  const double *x = x_.data(), *y = y_.data();
  for_each_segment_at(p.y(), [&](Index i) {
    const bool a = y[i] > p.y(), b = y[i + 1] > p.y();
    // The crossing lies to the right of p: a sidedness test without division, its sign turned for downward
    // edges.
    const double side = (x[i] - p.x()) * (y[i + 1] - p.y()) - (x[i + 1] - p.x()) * (y[i] - p.y());
    parity ^= static_cast<int>(a != b) & static_cast<int>((side > 0) == b);
  });
  return parity != 0;
}

MSPSKEL_INLINE double PlanarRegion::distance(const Vector2& p) const {
  using Block = Eigen::Array<double, kBlock, 1>;
  using Map = Eigen::Map<const Block>;
  Block best = Block::Constant(std::numeric_limits<double>::infinity());
  for (const Ring& ring : rings_)
    for (Index i = ring.begin; i < ring.begin + ring.segments; i += kBlock) {
      const Map tx(tx_.data() + i), ty(ty_.data() + i), length(length_.data() + i);
      const Block dx = p.x() - Map(x_.data() + i), dy = p.y() - Map(y_.data() + i);
      const Block along = (dx * tx + dy * ty).max(0.0).min(length);
      best = best.min((dx - along * tx).square() + (dy - along * ty).square());
    }
  return std::sqrt(best.minCoeff());
}

MSPSKEL_INLINE double PlanarRegion::first_hit(const Vector2& p, const Vector2& d) const {
  // Segments are closed with a margin, or a step might slip out between two of them.
  constexpr double kMargin = 1e-12;
  using Block = Eigen::Array<double, kBlock, 1>;
  using Map = Eigen::Map<const Block>;
  double best = 2.0;
  for (const Ring& ring : rings_)
    for (Index i = ring.begin; i < ring.begin + ring.segments; i += kBlock) {
      const double *x = x_.data() + i, *y = y_.data() + i;
      // Few segments meet the line: their ends lie on both sides of it, or within the margin.
      const Block from = (Map(x) - p.x()) * d.y() - (Map(y) - p.y()) * d.x(),
                  to = (Map(x + 1) - p.x()) * d.y() - (Map(y + 1) - p.y()) * d.x();
      if (!((from * to - 2 * kMargin * (from - to).square()).minCoeff() <= 0)) continue;
      for (Index k = 0; k < kBlock; ++k) {
        const double ax = x[k] - p.x(), ay = y[k] - p.y(), ex = x[k + 1] - x[k], ey = y[k + 1] - y[k];
        const double scale = 1.0 / (d.x() * ey - d.y() * ex);
        const double t = (ax * ey - ay * ex) * scale, s = (ax * d.y() - ay * d.x()) * scale;
        if (t > 0 && t <= 1 && s >= -kMargin && s <= 1 + kMargin) best = std::min(best, t);
      }
    }
  return best;
}

MSPSKEL_INLINE std::vector<PlanarRegion::Sample> PlanarRegion::sample(Index ring_index, Index count) const {
  const Ring& ring = rings_[ring_index];
  std::vector<Sample> samples;
  samples.reserve(static_cast<std::size_t>(count));
  if (!(ring.perimeter > 0)) return samples;
  Index i = ring.begin;
  constexpr double kCorner = 1e-9;
  double before = 0;  // arc length at point i
  const auto skip = [&] { before += length_[i++]; };
  for (Index k = 0; k < count; ++k) {
    const double s = ring.perimeter * k / count;
    // At a corner within rounding, take the segment after it.
    while (i + 1 < ring.begin + ring.points && before + length_[i] <= s + kCorner * ring.perimeter) skip();
    const Vector2 t(tx_[i], ty_[i]);
    Vector2 along = t;
    if (s - before <= kCorner * ring.perimeter) {  // at a corner: between the normals of its two segments
      Index h = i == ring.begin ? ring.begin + ring.points - 1 : i - 1;
      while (length_[h] <= kCorner * ring.perimeter && h != i)
        h = h == ring.begin ? ring.begin + ring.points - 1 : h - 1;
      const Vector2 sum = t + Vector2(tx_[h], ty_[h]);
      if (sum.norm() > 1e-6) along = sum.normalized();
    }
    samples.push_back({point(i) + std::clamp(s - before, 0.0, length_[i]) * t, turn_left(along)});
  }
  return samples;
}

MSPSKEL_INLINE PlanarRegion PlanarRegion::resampled(Index max_segments) const {
  PlanarRegion result;
  for (Index r = 0; r < static_cast<Index>(rings_.size()); ++r) {
    std::vector<Vector2> polygon;
    if (rings_[r].points <= max_segments) {
      for (Index i = 0; i < rings_[r].points; ++i) polygon.push_back(point(rings_[r].begin + i));
    } else {
      for (const Sample& s : sample(r, max_segments)) polygon.push_back(s.point);
    }
    result.add_ring(polygon, r == 0 ? 1.0 : -1.0);
  }
  return result;
}

}  // namespace mspskel
