// Balls along a polyline, and how far outside them a point lies.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

struct Ball {
  Vector3 centre;
  double radius;

  double distance_outside(const Vector3& x) const { return (x - centre).norm() - radius; }
};

// Balls in the order of a polyline, so that a few that follow each other fit into one that is not much
// larger.
class BallChain {
 public:
  BallChain() = default;
  explicit BallChain(std::vector<Ball> balls) : balls_(std::move(balls)) {
    for (std::size_t first = 0; first < balls_.size(); first += kRun) {
      const std::size_t last = std::min(first + kRun, balls_.size());
      Ball whole{balls_[(first + last) / 2].centre, 0.0};
      for (std::size_t i = first; i < last; ++i)
        whole.radius = std::max(whole.radius, (balls_[i].centre - whole.centre).norm() + balls_[i].radius);
      run_.push_back(whole);
    }
  }

  const std::vector<Ball>& balls() const { return balls_; }

  // The least distance of x beyond one of the balls, infinity without any; what is found below `stop` may not
  // be the least.
  double distance_outside(const Vector3& x, double stop = -std::numeric_limits<double>::infinity(),
                          double best = std::numeric_limits<double>::infinity()) const {
    double radius = 0;
    find_nearest(x, best, radius, stop);
    return best;
  }

  // As far as x lies beyond one of the balls by less than `distance`, that becomes the least distance, and
  // `radius` that ball's; what is found below `stop` may not be the least.
  void find_nearest(const Vector3& x, double& distance, double& radius,
                    double stop = -std::numeric_limits<double>::infinity()) const {
    for (std::size_t r = 0; r < run_.size(); ++r) {
      if (run_[r].distance_outside(x) >= distance) continue;
      const std::size_t last = std::min((r + 1) * kRun, balls_.size());
      for (std::size_t i = r * kRun; i < last; ++i) {
        const double outside = balls_[i].distance_outside(x);
        if (outside >= distance) continue;
        distance = outside;
        radius = balls_[i].radius;
      }
      if (distance < stop) break;
    }
  }

 private:
  static constexpr std::size_t kRun = 12;
  std::vector<Ball> balls_;
  std::vector<Ball> run_;  // round each kRun of them
};

}  // namespace detail
}  // namespace mspskel
