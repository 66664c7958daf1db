// Polygons of known geometry for the tests of slice centres.
#pragma once

#include <cmath>
#include <vector>

#include "mspskel/center/planar_region.h"

namespace mspskel::test {

using Polygon = std::vector<Vector2>;

inline Polygon ellipse(double a, double b, Index n, Vector2 centre = Vector2::Zero(), double turn = 0) {
  Polygon p;
  for (Index i = 0; i < n; ++i) {
    const double t = 2 * kPi * i / n;
    const Vector2 q(a * std::cos(t), b * std::sin(t));
    p.push_back(centre + Vector2(std::cos(turn) * q.x() - std::sin(turn) * q.y(),
                                 std::sin(turn) * q.x() + std::cos(turn) * q.y()));
  }
  return p;
}

// Corners joined by `n` equal segments each.
inline Polygon subdivided(const Polygon& corners, Index n) {
  Polygon p;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (Index k = 0; k < n; ++k)
      p.push_back(corners[i] +
                  (corners[(i + 1) % corners.size()] - corners[i]) * (static_cast<double>(k) / n));
  return p;
}

inline Polygon rectangle(double width, double height, Index n) {
  const double x = width / 2, y = height / 2;
  return subdivided({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, n);
}

inline Polygon u_shape() {
  return subdivided({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}, 6);
}

// A U whose arms and base differ, so that nothing ties.
inline Polygon uneven_u_shape() {
  return subdivided({{0, 0}, {4, 0.2}, {4.3, 4}, {3, 4.1}, {3, 1}, {1, 1.2}, {0.9, 3}, {0, 3.1}}, 6);
}

// A thin strip along an arc of radius 1 through `angle`, of the given thickness: what a cup's wall gives.
inline Polygon crescent(double thickness, double angle, Index n) {
  Polygon p;
  for (Index i = 0; i <= n; ++i) {
    const double t = angle * i / n;
    p.push_back(Vector2(std::cos(t), std::sin(t)));
  }
  for (Index i = n; i >= 0; --i) {
    const double t = angle * i / n, r = 1 - thickness * std::sin(kPi * (0.1 + 0.8 * i / n));
    p.push_back(r * Vector2(std::cos(t), std::sin(t)));
  }
  return p;
}

// Discs of radius 1 round the origin and `small` round (distance, 0), joined by a neck of the given half
// width.
inline Polygon dumbbell(double small, double neck, Index n, double distance = 4) {
  Polygon p;
  const double from = std::asin(neck), to = 2 * kPi - from, s = std::asin(neck / small);
  for (Index i = 0; i <= n; ++i) {
    const double t = from + (to - from) * i / n;
    p.push_back(Vector2(std::cos(t), std::sin(t)));
  }
  for (Index i = 0; i <= n; ++i) {
    const double t = -kPi + s + (2 * kPi - 2 * s) * i / n;
    p.push_back(Vector2(distance, 0) + small * Vector2(std::cos(t), std::sin(t)));
  }
  return p;
}

inline Polygon transformed(const Polygon& polygon, double scale, double turn, Vector2 shift) {
  Polygon p;
  for (const Vector2& q : polygon)
    p.push_back(shift + scale * Vector2(std::cos(turn) * q.x() - std::sin(turn) * q.y(),
                                        std::sin(turn) * q.x() + std::cos(turn) * q.y()));
  return p;
}

}  // namespace mspskel::test
