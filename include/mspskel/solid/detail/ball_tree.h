// Balls by halves: how far outside their union a point lies.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "mspskel/solid/detail/ball_chain.h"

namespace mspskel {
namespace detail {

class BallTree {
 public:
  explicit BallTree(std::vector<Ball> balls) : balls_(std::move(balls)) {
    if (balls_.empty()) return;
    bounds_.resize(4 * (balls_.size() / kLeaf + 1));
    build(0, 0, balls_.size());
  }

  bool empty() const { return balls_.empty(); }

  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();  // |x - c| - r; negative inside
    double radius = 0.0;                                        // r
  };

  // The ball that x is least outside of. O(log balls) where few are near.
  Nearest nearest(const Vector3& x) const {
    Best best;
    if (!balls_.empty()) search(0, 0, balls_.size(), bounds_[0].distance_outside(x), x, best);
    return {best.distance, balls_.empty() ? 0.0 : balls_[best.ball].radius};
  }
  // Its distance. Good for many points that follow each other: `near`, at first 0, is the ball of the point
  // before.
  double distance_outside(const Vector3& x, std::size_t& near) const {
    Best best;
    if (balls_.empty()) return best.distance;
    best = {balls_[near].distance_outside(x), near};
    search(0, 0, balls_.size(), bounds_[0].distance_outside(x), x, best);
    near = best.ball;
    return best.distance;
  }

 private:
  struct Best {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t ball = 0;
  };
  struct Bounds {
    Vector3 low, high;  // of the centres
    double radius;      // the largest
    double distance_outside(const Vector3& x) const {
      return (x - x.cwiseMax(low).cwiseMin(high)).norm() - radius;
    }
  };
  static constexpr std::size_t kLeaf = 8;

  void build(std::size_t at, std::size_t begin, std::size_t end) {
    if (at >= bounds_.size()) bounds_.resize(at + 1);
    Bounds b{balls_[begin].centre, balls_[begin].centre, 0.0};
    for (std::size_t i = begin; i < end; ++i) {
      b.low = b.low.cwiseMin(balls_[i].centre);
      b.high = b.high.cwiseMax(balls_[i].centre);
      b.radius = std::max(b.radius, balls_[i].radius);
    }
    bounds_[at] = b;
    if (end - begin <= kLeaf) return;
    Eigen::Index axis = 0;
    (b.high - b.low).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = balls_.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(middle),
                     first + static_cast<std::ptrdiff_t>(end),
                     [&](const Ball& p, const Ball& q) { return p.centre[axis] < q.centre[axis]; });
    build(2 * at + 1, begin, middle);
    build(2 * at + 2, middle, end);
  }

  // `outside`: how far x is outside the bounds.
  void search(std::size_t at, std::size_t begin, std::size_t end, double outside, const Vector3& x,
              Best& best) const {
    if (outside >= best.distance) return;
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) {
        const double distance = balls_[i].distance_outside(x);
        if (distance < best.distance) best = {distance, i};
      }
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2, left = 2 * at + 1, right = left + 1;
    const double of_left = bounds_[left].distance_outside(x), of_right = bounds_[right].distance_outside(x);
    if (of_left <= of_right) {
      search(left, begin, middle, of_left, x, best);
      search(right, middle, end, of_right, x, best);
    } else {
      search(right, middle, end, of_right, x, best);
      search(left, begin, middle, of_left, x, best);
    }
  }

  std::vector<Ball> balls_;
  std::vector<Bounds> bounds_;  // of a binary tree: the children of i are 2 i + 1 and 2 i + 2
};

}  // namespace detail
}  // namespace mspskel
