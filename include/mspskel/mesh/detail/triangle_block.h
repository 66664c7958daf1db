// Four triangles side by side in single precision: tells at once which of them a query need not look at.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mspskel/mesh/detail/box_tree.h"
#include "mspskel/mesh/detail/triangle_queries.h"

namespace mspskel {
namespace detail {

// A point or a ray's origin for the filters below.
struct FilterPoint {
  float x[3];
  float magnitude;  // bounds every coordinate of the point and of the triangles

  FilterPoint(const Vector3& p, double reach)
      : x{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])},
        magnitude(static_cast<float>(reach + p.cwiseAbs().maxCoeff())) {}
};

// The filters may keep a triangle for nothing but never drop one that matters: each bounds its own rounding.
class TriangleBlock {
 public:
  // `count` triangles, 1 to 4; the other lanes repeat the last one.
  TriangleBlock(const Triangle* t, Index count) {
    for (int k = 0; k < 4; ++k) {
      const Triangle& source = t[std::min<Index>(k, count - 1)];
      for (int i = 0; i < 3; ++i) {
        a_[i][k] = static_cast<float>(source.a[i]);
        ab_[i][k] = static_cast<float>(source.b[i] - source.a[i]);
        ac_[i][k] = static_cast<float>(source.c[i] - source.a[i]);
      }
    }
  }

  // Largest error of the distances below, for this point.
  static float distance_error(const FilterPoint& p) { return 2e-6f * p.magnitude; }

  // Squared distances from p, right up to distance_error before squaring. Over the triangle's inside the
  // distance to its plane, elsewhere (and where the plane of a sliver is unsure) the nearest edge's.
  void squared_distances(const FilterPoint& point, float* square) const {
    const Lanes3 b = load3(ab_), c = load3(ac_), p = minus(point, a_),
                 e{c[0] - b[0], c[1] - b[1], c[2] - b[2]}, q{p[0] - b[0], p[1] - b[1], p[2] - b[2]},
                 n = cross(b, c);
    const Lanes edges = to_edge(p, b).min(to_edge(p, c)).min(to_edge(q, e)), height = dot(n, p);
    const Lanes plane = height * height / dot(n, n).max(kTiny);
    const Lanes least = dot(n, cross(b, p)).min(dot(n, cross(p, c))).min(dot(n, cross(e, q)));
    // Beside the triangle the distance to its plane says nothing: make it huge.
    store(edges.min(plane + (-least).max(0.0f) * kHuge), square);
  }

  // Negative for triangles that the line through the origin along d (length 1) cannot meet.
  void may_meet(const FilterPoint& origin, const float* d, float* may) const {
    const Lanes3 ab = load3(ab_), ac = load3(ac_), p = minus(origin, a_),
                 b{ab[0] - p[0], ab[1] - p[1], ab[2] - p[2]}, c{ac[0] - p[0], ac[1] - p[1], ac[2] - p[2]};
    // p is the negative of corner a as seen from the origin.
    const Lanes u = along(d, cross(b, c)), v = along(d, cross(p, c)), w = along(d, cross(b, p));
    const Lanes slack = 1e-6f * origin.magnitude * (size(p) + size(b) + size(c));
    store((u.min(v).min(w) + slack).max(slack - u.max(v).max(w)), may);
  }

 private:
  using Lanes3 = std::array<Lanes, 3>;
  static constexpr float kTiny = 1e-37f, kHuge = 1e30f;

  static Lanes3 load3(const float (&x)[3][4]) { return {load(x[0]), load(x[1]), load(x[2])}; }
  static Lanes3 minus(const FilterPoint& p, const float (&a)[3][4]) {
    return {p.x[0] - load(a[0]), p.x[1] - load(a[1]), p.x[2] - load(a[2])};
  }
  static Lanes dot(const Lanes3& a, const Lanes3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Lanes along(const float* d, const Lanes3& a) { return d[0] * a[0] + d[1] * a[1] + d[2] * a[2]; }
  static Lanes size(const Lanes3& a) { return a[0].abs() + a[1].abs() + a[2].abs(); }
  static Lanes3 cross(const Lanes3& a, const Lanes3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  // Squared distance from p to the segment from 0 to e.
  static Lanes to_edge(const Lanes3& p, const Lanes3& e) {
    const Lanes t = (dot(p, e) / dot(e, e).max(kTiny)).max(0.0f).min(1.0f);
    const Lanes3 d{p[0] - t * e[0], p[1] - t * e[1], p[2] - t * e[2]};
    return dot(d, d);
  }

  alignas(16) float a_[3][4], ab_[3][4], ac_[3][4];
};

}  // namespace detail
}  // namespace mspskel
