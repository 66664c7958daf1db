// One triangle against a point, a ray, a segment.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mspskel/base/types.h"
#include "mspskel/mesh/detail/triangle.h"

namespace mspskel {
namespace detail {

// The point of the segment from a to b nearest to p; a where both are one point.
inline Vector3 closest_on_segment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 ab = b - a;
  const double square = ab.squaredNorm();
  return square > 0 ? Vector3(a + std::clamp((p - a).dot(ab) / square, 0.0, 1.0) * ab) : a;
}

// The nearest point of the three sides, which is that of the whole triangle where it has no area.
inline Vector3 closest_on_sides(const Vector3& p, const Triangle& t) {
  const std::array<Vector3, 3> feet = {closest_on_segment(p, t.a, t.b), closest_on_segment(p, t.b, t.c),
                                       closest_on_segment(p, t.c, t.a)};
  return *std::min_element(feet.begin(), feet.end(), [&](const Vector3& x, const Vector3& y) {
    return (x - p).squaredNorm() < (y - p).squaredNorm();
  });
}

// The point of the triangle nearest to p, by the region of the plane that p projects to: three corners, three
// edges, the inside (Ericson, "Real-Time Collision Detection", 2005, 5.1.5). Where a triangle has hardly an
// area, its barycentric weights are rounding's, and a point of its sides may be nearer.
inline Vector3 closest_on_triangle(const Vector3& p, const Triangle& t) {
  const Vector3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return t.a;
  const Vector3 bp = p - t.b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return t.b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 - d3 > 0 ? Vector3(t.a + d1 / (d1 - d3) * ab) : t.a;
  const Vector3 cp = p - t.c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return t.c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 - d6 > 0 ? Vector3(t.a + d2 / (d2 - d6) * ac) : t.a;
  const double va = d3 * d6 - d5 * d4, along = d4 - d3, rest = d5 - d6;
  if (va <= 0 && along >= 0 && rest >= 0)
    return along + rest > 0 ? Vector3(t.b + along / (along + rest) * (t.c - t.b)) : t.b;
  if (!(std::min({va, vb, vc}) > 0)) return closest_on_sides(p, t);
  const double sum = va + vb + vc;  // the square of twice the area
  const Vector3 inner = t.a + vb / sum * ab + vc / sum * ac;
  if (sum > 1e-10 * ab.squaredNorm() * ac.squaredNorm()) return inner;
  const Vector3 side = closest_on_sides(p, t);
  return (side - p).squaredNorm() < (inner - p).squaredNorm() ? side : inner;
}

enum class Crossing { kNone, kClear, kDoubtful, kOnSurface };

// The ray against the triangle by the signs of the three volumes that the ray spans with the edges; the same
// edge gives opposite signs in its two triangles, so no ray slips between them.
struct RayTriangle {
  Vector3 a, b, c;  // corners as seen from the ray's origin
  double u, v, w;   // volumes opposite to a, b, c

  RayTriangle(const Vector3& origin, const Vector3& direction, const Triangle& t)
      : a(t.a - origin), b(t.b - origin), c(t.c - origin) {
    u = direction.dot(b.cross(c));
    v = direction.dot(c.cross(a));
    w = direction.dot(a.cross(b));
  }
  bool meets_line() const { return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0); }
  double volume() const { return u + v + w; }
  // Along a direction of length 1; the line must meet the triangle, with a volume that is not zero.
  double distance(const Vector3& direction) const { return direction.dot(u * a + v * b + w * c) / volume(); }
};

// Whether a ray of direction length 1 crosses the triangle, and whether rounding leaves a doubt.
inline Crossing ray_crossing(const Vector3& origin, const Vector3& direction, const Triangle& t) {
  const RayTriangle r(origin, direction, t);
  const double square = std::max({r.a.squaredNorm(), r.b.squaredNorm(), r.c.squaredNorm()}),
               size = std::sqrt(square);
  const double lowest = std::min({r.u, r.v, r.w}), highest = std::max({r.u, r.v, r.w}),
               slack = 1e-14 * square;
  if (lowest < -slack && highest > slack) return Crossing::kNone;
  if (lowest <= slack && highest >= -slack) {
    // The line passes an edge or runs along the triangle, which does not matter behind the origin.
    const double ahead = std::max({direction.dot(r.a), direction.dot(r.b), direction.dot(r.c)});
    return ahead < -1e-14 * size ? Crossing::kNone : Crossing::kDoubtful;
  }
  const double distance = r.distance(direction), height = (t.b - t.a).cross(t.c - t.a).dot(r.a);
  if (std::abs(height) <= slack * size)
    return std::abs(distance) <= 1e-13 * size ? Crossing::kOnSurface : Crossing::kDoubtful;
  return distance > 0 ? Crossing::kClear : Crossing::kNone;
}

}  // namespace detail
}  // namespace mspskel
