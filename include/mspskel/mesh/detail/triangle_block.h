// Four triangles side by side in single precision: tells at once which of them a query need not look at.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mspskel/mesh/detail/box_node.h"
#include "mspskel/mesh/detail/triangle.h"

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
    const Lanes3 b = load3(ab_), c = load3(ac_), p = minus(point, a_), e = minus(c, b), q = minus(p, b),
                 n = cross(b, c);
    const Lanes edges = smaller(smaller(to_edge(p, b), to_edge(p, c)), to_edge(q, e)), height = dot(n, p);
    const Lanes plane = height * height / larger(dot(n, n), all(kTiny));
    const Lanes least = smaller(smaller(dot(n, cross(b, p)), dot(n, cross(p, c))), dot(n, cross(e, q)));
    // Beside the triangle the distance to its plane says nothing: make it huge.
    store(smaller(edges, plane + larger(-least, Lanes{}) * kHuge), square);
  }

  // Negative for triangles that the line through the origin along d (length 1) cannot meet.
  void may_meet(const FilterPoint& origin, const float* d, float* may) const {
    const Lanes3 p = minus(origin, a_), b = minus(load3(ab_), p), c = minus(load3(ac_), p);
    // p is the negative of corner a as seen from the origin.
    const Lanes u = along(d, cross(b, c)), v = along(d, cross(p, c)), w = along(d, cross(b, p));
    const Lanes slack = 1e-6f * origin.magnitude * (size(p) + size(b) + size(c));
    store(larger(smaller(smaller(u, v), w) + slack, slack - larger(larger(u, v), w)), may);
  }

 private:
  struct Lanes3 {
    Lanes x, y, z;
  };
  static constexpr float kTiny = 1e-37f, kHuge = 1e30f;

  static Lanes3 load3(const float (&x)[3][4]) { return {load(x[0]), load(x[1]), load(x[2])}; }
  static Lanes3 minus(const FilterPoint& p, const float (&a)[3][4]) {
    return {p.x[0] - load(a[0]), p.x[1] - load(a[1]), p.x[2] - load(a[2])};
  }
  static Lanes3 minus(const Lanes3& a, const Lanes3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  static Lanes dot(const Lanes3& a, const Lanes3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static Lanes along(const float* d, const Lanes3& a) { return d[0] * a.x + d[1] * a.y + d[2] * a.z; }
  static Lanes size(const Lanes3& a) { return larger(a.x, -a.x) + larger(a.y, -a.y) + larger(a.z, -a.z); }
  static Lanes3 cross(const Lanes3& a, const Lanes3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  // Squared distance from p to the segment from 0 to e.
  static Lanes to_edge(const Lanes3& p, const Lanes3& e) {
    const Lanes t = smaller(larger(dot(p, e) / larger(dot(e, e), all(kTiny)), Lanes{}), all(1.0f));
    const Lanes3 d{p.x - t * e.x, p.y - t * e.y, p.z - t * e.z};
    return dot(d, d);
  }

  alignas(16) float a_[3][4], ab_[3][4], ac_[3][4];
};

}  // namespace detail
}  // namespace mspskel
