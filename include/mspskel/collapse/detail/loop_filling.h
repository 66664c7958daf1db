// Surfaces of triangles that fill closed polygons, and where segments cross them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

using FillingTriangle = std::array<Vector3, 3>;

// Parts the triangle at its longest edges until none is longer than `longest`.
template <class Visit>
void visit_parts(const FillingTriangle& triangle, double longest, Visit& visit) {
  constexpr double kUneven = 0.45;  // off the middle, where a regular loop's axis might pass
  std::vector<FillingTriangle> open{triangle};
  while (!open.empty()) {
    const FillingTriangle t = open.back();
    open.pop_back();
    std::size_t at = 0;
    std::array<double, 3> square;
    for (std::size_t k = 0; k < 3; ++k) {
      square[k] = (t[(k + 1) % 3] - t[k]).squaredNorm();
      if (square[k] > square[at]) at = k;
    }
    if (!(square[at] > longest * longest)) {
      visit(t);
      continue;
    }
    const Vector3 &a = t[at], &b = t[(at + 1) % 3], &c = t[(at + 2) % 3];
    const Vector3 x = a + kUneven * (b - a);
    open.push_back({a, x, c});
    open.push_back({x, b, c});
  }
}

// Calls visit(triangle) for the triangles of a surface whose border is the closed polygon, in its direction.
// It may cross itself: signed crossings of a closed curve with it add up to the linking number with the
// polygon all the same. Begun at point `start`, and parted so that the triangles' boxes are small: into a few
// times as many as there are points where the polygon is round, fewer where it is not. Nothing for less than
// three points. Cost: O(points).
template <class Visit>
void fill_polygon(const std::vector<Vector3>& polygon, std::size_t start, Visit visit) {
  struct Stretch {
    std::size_t first, last;
  };
  // Not in halves: chords would pass through the centre of a regular polygon, as an arc does.
  constexpr double kUneven = 0.33;
  const std::size_t n = polygon.size();
  if (n < 3) return;
  const auto at = [&](std::size_t i) -> const Vector3& { return polygon[(start + i) % n]; };
  double length = 0;
  for (std::size_t i = 0; i < n; ++i) length += (at(i + 1) - at(i)).norm();
  const double longest = length / std::sqrt(3.0 * static_cast<double>(n));
  std::vector<Stretch> open{{0, n - 1}};
  while (!open.empty()) {
    const Stretch s = open.back();
    open.pop_back();
    if (s.last - s.first < 2) continue;
    const std::size_t room = s.last - s.first - 1;  // points between
    const std::size_t middle = s.first + 1 + static_cast<std::size_t>(kUneven * static_cast<double>(room));
    visit_parts({at(s.first), at(middle), at(s.last)}, longest, visit);
    open.push_back({s.first, middle});
    open.push_back({middle, s.last});
  }
}

// Sign of the volume that three directions span; none if rounding could change it. For differences of points.
inline std::optional<int> sign_of_volume(const Vector3& u, const Vector3& v, const Vector3& w) {
  constexpr double kRounding = 4e-15;  // of the product of the lengths; more than the operations lose
  const double volume = u.cross(v).dot(w);
  if (volume * volume <= kRounding * kRounding * u.squaredNorm() * v.squaredNorm() * w.squaredNorm())
    return std::nullopt;
  return volume > 0 ? 1 : -1;
}

// 1 where the way from a to b crosses the triangle to the side from which its corners run counterclockwise,
// −1 where it crosses to the other side, else 0. None if rounding hides the answer.
inline std::optional<int> crossing_of(const FillingTriangle& t, const Vector3& a, const Vector3& b) {
  for (Index k = 0; k < 3; ++k) {
    const double low = std::min(a[k], b[k]), high = std::max(a[k], b[k]);
    if ((t[0][k] < low && t[1][k] < low && t[2][k] < low) ||
        (t[0][k] > high && t[1][k] > high && t[2][k] > high))
      return 0;
  }
  const Vector3 u = t[1] - t[0], v = t[2] - t[0];
  const auto from = sign_of_volume(u, v, a - t[0]), to = sign_of_volume(u, v, b - t[0]);
  if (from && to && *from == *to) return 0;
  // Whether the line passes on the same side of all three edges.
  std::array<std::optional<int>, 3> turn;
  for (std::size_t k = 0; k < 3; ++k) turn[k] = sign_of_volume(b - a, t[k] - a, t[(k + 1) % 3] - a);
  for (std::size_t k = 0; k < 3; ++k)
    if (turn[k] && turn[(k + 1) % 3] && *turn[k] != *turn[(k + 1) % 3]) return 0;
  if (!from || !to || !turn[0] || !turn[1] || !turn[2]) return std::nullopt;
  return *to;
}

}  // namespace detail
}  // namespace mspskel
