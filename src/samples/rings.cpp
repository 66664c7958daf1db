#include "rings.h"

#include <cmath>

namespace mspskel::detail {

namespace {
// The ring's turn at an index that may run past its end once.
double unrolled(const Ring& ring, Index i) {
  return i < ring.size() ? ring.turn[i] : ring.turn[i - ring.size()] + 1.0;
}

// b, renumbered and shifted by whole turns so that its first vertex is the one nearest to a's first.
Ring facing(const Ring& a, const Ring& b) {
  Index best = 0;
  double best_gap = 1.0;
  for (Index j = 0; j < b.size(); ++j) {
    const double gap = b.turn[j] - a.turn[0];
    const double rest = std::abs(gap - std::round(gap));
    if (rest < best_gap) {
      best_gap = rest;
      best = j;
    }
  }
  Ring result;
  const double shift = std::round(a.turn[0] - b.turn[best]);
  for (Index j = best; j < best + b.size(); ++j) {
    result.turn.push_back(unrolled(b, j) + shift);
    result.vertex.push_back(b.vertex[j % b.size()]);
  }
  return result;
}
}  // namespace

//  b0 ------ b1        each step advances on the side whose next edge has the earlier middle
//  |  `-.    |
//  a0 ------ a1 ---> turn
void zip(PolygonSoup& soup, const Ring& a, const Ring& other) {
  const Ring b = facing(a, other);
  Index i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    const double middle_a = i < a.size() ? unrolled(a, i) + unrolled(a, i + 1) : 1e300;
    const double middle_b = j < b.size() ? unrolled(b, j) + unrolled(b, j + 1) : 1e300;
    const Index from_a = a.vertex[i % a.size()], from_b = b.vertex[j % b.size()];
    if (middle_a <= middle_b) {
      soup.add_triangle(from_a, a.vertex[(i + 1) % a.size()], from_b);
      ++i;
    } else {
      soup.add_triangle(from_a, b.vertex[(j + 1) % b.size()], from_b);
      ++j;
    }
  }
}

void close_behind(PolygonSoup& soup, const Ring& ring, Index apex) {
  for (Index i = 0; i < ring.size(); ++i)
    soup.add_triangle(apex, ring.vertex[(i + 1) % ring.size()], ring.vertex[i]);
}

void close_before(PolygonSoup& soup, const Ring& ring, Index apex) {
  for (Index i = 0; i < ring.size(); ++i)
    soup.add_triangle(ring.vertex[i], ring.vertex[(i + 1) % ring.size()], apex);
}

Index add_point(PolygonSoup& soup, const Vector3& point) {
  soup.points.push_back(point);
  return static_cast<Index>(soup.points.size()) - 1;
}

}  // namespace mspskel::detail
