// On which side of a plane or line a point lies, with doubt reported as zero.
#pragma once

#include <cmath>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

// Sign of det(a − d, b − d, c − d): 1 if d lies below the plane abc (a, b, c counter-clockwise as seen from
// above), −1 above, 0 if rounding in double could change the sign. The bound is Shewchuk's ("Adaptive
// precision floating-point arithmetic and fast robust geometric predicates", 1997), (7 + 56ε)ε times the
// permanent.
inline int orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 ad = a - d, bd = b - d, cd = c - d;
  const double bc = bd[0] * cd[1], cb = cd[0] * bd[1], ca = cd[0] * ad[1], ac = ad[0] * cd[1],
               ab = ad[0] * bd[1], ba = bd[0] * ad[1];
  const double det = ad[2] * (bc - cb) + bd[2] * (ca - ac) + cd[2] * (ab - ba);
  const double permanent = (std::abs(bc) + std::abs(cb)) * std::abs(ad[2]) +
                           (std::abs(ca) + std::abs(ac)) * std::abs(bd[2]) +
                           (std::abs(ab) + std::abs(ba)) * std::abs(cd[2]);
  const double bound = 7.8e-16 * permanent;
  return det > bound ? 1 : det < -bound ? -1 : 0;
}

// The same in the plane of the two given axes.
inline int orientation(const Vector3& a, const Vector3& b, const Vector3& c, int x, int y) {
  const double left = (a[x] - c[x]) * (b[y] - c[y]), right = (a[y] - c[y]) * (b[x] - c[x]);
  const double det = left - right, bound = 3.4e-16 * (std::abs(left) + std::abs(right));
  return det > bound ? 1 : det < -bound ? -1 : 0;
}

}  // namespace detail
}  // namespace mspskel
