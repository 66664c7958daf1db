// The convex hull of points in a plane. CGAL has one, but is no part of every build.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

// Of points seen along a direction, by Andrew's monotone chain (1979, "Another efficient algorithm for convex
// hulls in two dimensions").
class PlaneHull {
 public:
  // `across`: the unit normal of the plane. There is a point at least. O(points log points).
  PlaneHull(const std::vector<Vector3>& points, const Vector3& across) {
    side_ = across.unitOrthogonal();
    up_ = across.cross(side_);
    std::vector<Vector2> flat;
    for (const Vector3& x : points) flat.push_back(in_plane(x));
    std::sort(flat.begin(), flat.end(), [](const Vector2& a, const Vector2& b) {
      return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
    });
    add_chain(flat.begin(), flat.end());
    add_chain(flat.rbegin(), flat.rend());
    if (corner_.empty()) corner_.push_back(flat.front());
  }

  // The way from the nearest place of the hull to a point, in the plane; zero within the hull. O(corners).
  Vector3 beyond(const Vector3& point) const {
    const Vector2 x = in_plane(point);
    Vector2 way = x - corner_.front();
    bool within = corner_.size() > 2;
    for (std::size_t i = 0; i < corner_.size(); ++i) {
      const Vector2 &a = corner_[i], edge = corner_[(i + 1) % corner_.size()] - a;
      if (edge.x() * (x - a).y() - edge.y() * (x - a).x() < 0) within = false;
      const double length = edge.squaredNorm();
      const double share = length > 0 ? std::clamp(edge.dot(x - a) / length, 0.0, 1.0) : 0.0;
      const Vector2 here = x - a - share * edge;
      if (here.squaredNorm() < way.squaredNorm()) way = here;
    }
    if (within) return Vector3::Zero();
    return way.x() * side_ + way.y() * up_;
  }

  // O(corners).
  double area() const { return area_in(corner_); }
  // Of what a loop of points goes round in the plane; positive where it is anticlockwise. O(points).
  double area_in(const std::vector<Vector3>& loop) const {
    std::vector<Vector2> flat;
    for (const Vector3& x : loop) flat.push_back(in_plane(x));
    return area_in(flat);
  }

 private:
  using Vector2 = Eigen::Vector2d;

  static double area_in(const std::vector<Vector2>& loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2 a = loop[i] - loop[0], b = loop[(i + 1) % loop.size()] - loop[0];
      twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
  }

  Vector2 in_plane(const Vector3& x) const { return {side_.dot(x), up_.dot(x)}; }

  // The corners that turn left from one end of the points to the other, without the last.
  template <class Iterator>
  void add_chain(Iterator first, Iterator last) {
    const std::size_t begin = corner_.size();
    for (; first != last; ++first) {
      const auto turns_left = [&] {
        const Vector2 &a = corner_[corner_.size() - 2], &b = corner_.back();
        return (b - a).x() * (*first - a).y() - (b - a).y() * (*first - a).x() > 0;
      };
      while (corner_.size() >= begin + 2 && !turns_left()) corner_.pop_back();
      corner_.push_back(*first);
    }
    corner_.pop_back();
  }

  Vector3 side_, up_;
  std::vector<Vector2> corner_;  // anticlockwise
};

}  // namespace detail
}  // namespace mspskel
