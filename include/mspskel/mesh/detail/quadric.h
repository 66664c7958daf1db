// Sums of squared distances to planes and points as quadratic polynomials.
#pragma once

#include <algorithm>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

// x ↦ xᵀ A x + 2 b·x + c, where the symmetric A is stored by its upper triangle.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  double bx = 0, by = 0, bz = 0, c = 0;

  // weight · (n·x − offset)²
  void add_plane(const Vector3& n, double offset, double weight) {
    xx += weight * n.x() * n.x();
    xy += weight * n.x() * n.y();
    xz += weight * n.x() * n.z();
    yy += weight * n.y() * n.y();
    yz += weight * n.y() * n.z();
    zz += weight * n.z() * n.z();
    bx -= weight * offset * n.x();
    by -= weight * offset * n.y();
    bz -= weight * offset * n.z();
    c += weight * offset * offset;
  }

  // weight · |x − p|²
  void add_point(const Vector3& p, double weight) {
    xx += weight;
    yy += weight;
    zz += weight;
    bx -= weight * p.x();
    by -= weight * p.y();
    bz -= weight * p.z();
    c += weight * p.squaredNorm();
  }

  Quadric& operator+=(const Quadric& q) {
    xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
    bx += q.bx, by += q.by, bz += q.bz, c += q.c;
    return *this;
  }

  double operator()(const Vector3& p) const {
    return p.x() * (xx * p.x() + 2 * (xy * p.y() + xz * p.z() + bx)) +
           p.y() * (yy * p.y() + 2 * (yz * p.z() + by)) + p.z() * (zz * p.z() + 2 * bz) + c;
  }

  // Where it is least, by Cramer's rule; `fallback` where it has no single least point. The point terms keep
  // A's condition moderate, so elimination would gain nothing.
  Vector3 least_point(const Vector3& fallback) const {
    const double cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
    const double det = xx * cxx + xy * cxy + xz * cxz, trace = xx + yy + zz;
    if (!(det > 1e-24 * trace * trace * trace)) return fallback;
    const double cyy = xx * zz - xz * xz, cyz = xy * xz - xx * yz, czz = xx * yy - xy * xy;
    const double r = -1 / det;
    return {r * (cxx * bx + cxy * by + cxz * bz), r * (cxy * bx + cyy * by + cyz * bz),
            r * (cxz * bx + cyz * by + czz * bz)};
  }
};

}  // namespace detail
}  // namespace mspskel
