// Whether a segment meets a triangle, by signs only.
#pragma once

#include "mspskel/mesh/detail/orientation.h"
#include "mspskel/mesh/detail/triangle_queries.h"

namespace mspskel {
namespace detail {

// Whether closed segments pq and ab meet, in the plane of the two axes.
inline bool segments_meet(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b, int x,
                          int y) {
  for (const int k : {x, y})
    if (std::max(p[k], q[k]) < std::min(a[k], b[k]) || std::max(a[k], b[k]) < std::min(p[k], q[k]))
      return false;
  return orientation(p, q, a, x, y) * orientation(p, q, b, x, y) <= 0 &&
         orientation(a, b, p, x, y) * orientation(a, b, q, x, y) <= 0;
}

// Whether the segment meets the closed triangle after projection along the longest axis of the
// normal.
inline bool shadows_meet(const Vector3& p, const Vector3& q, const Triangle& t) {
  const Vector3 normal = (t.b - t.a).cross(t.c - t.a);
  int drop = 0;
  const double longest =
      std::max({(t.b - t.a).squaredNorm(), (t.c - t.b).squaredNorm(), (t.a - t.c).squaredNorm()});
  // A triangle without area lies within its neighbours at the edges, which answer for it.
  if (!(normal.cwiseAbs().maxCoeff(&drop) > 1e-14 * longest)) return false;
  const int x = (drop + 1) % 3, y = (drop + 2) % 3;
  if (segments_meet(p, q, t.a, t.b, x, y) || segments_meet(p, q, t.b, t.c, x, y) ||
      segments_meet(p, q, t.c, t.a, x, y))
    return true;
  const int u = orientation(t.a, t.b, p, x, y), v = orientation(t.b, t.c, p, x, y),
            w = orientation(t.c, t.a, p, x, y);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

// Whether the segment pq meets the closed triangle, to within rounding. A contact at an end of the segment
// alone counts if `with_ends`. The line's side of each edge is a sign of four points, the same from both
// triangles at an edge.
inline bool segment_meets_triangle(const Vector3& p, const Vector3& q, const Triangle& t, bool with_ends) {
  // With a corner of the triangle as pivot, small triangles far from p lose no digits.
  const int sp = orientation(t.b, t.c, p, t.a), sq = orientation(t.b, t.c, q, t.a);
  if (sp * sq > 0) return false;
  if (sp * sq == 0 && (sp != 0 || sq != 0) && !with_ends) return false;
  const int u = orientation(p, q, t.a, t.b), v = orientation(p, q, t.b, t.c), w = orientation(p, q, t.c, t.a);
  if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0))) return false;
  // In doubt the shadows in the triangle's plane must meet as well, or everything nearly flat would count.
  const bool doubt = sp * sq == 0 || u * v * w == 0;
  return !doubt || shadows_meet(p, q, t);
}

}  // namespace detail
}  // namespace mspskel
