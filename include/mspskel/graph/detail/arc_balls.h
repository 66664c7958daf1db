// The maximal balls round the points of a skeleton's arcs, and how far outside them a point lies.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/graph/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

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

// The balls of every arc's inner points, and of every hub.
struct ArcBalls {
  std::vector<BallChain> arc;
  std::vector<Ball> hub;

  ArcBalls(const ArcGraph& graph, const BoundingVolumeHierarchy& solid, const Execution& execution) {
    std::vector<std::vector<Ball>> of_arc(graph.arcs.size());
    for (const Vector3& x : graph.hub_position) hub.push_back({x, 0.0});
    for (std::size_t a = 0; a < of_arc.size(); ++a)
      if (graph.arcs[a].alive)
        for (std::size_t i = 1; i + 1 < graph.arcs[a].points.size(); ++i)
          of_arc[a].push_back({graph.arcs[a].points[i], 0.0});
    std::vector<Ball*> all;
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h]) all.push_back(&hub[h]);
    for (auto& balls : of_arc)
      for (Ball& ball : balls) all.push_back(&ball);
    parallel_for(
        static_cast<Index>(all.size()), "arcs", execution, [] { return 0; },
        [&](Index i, int) { all[i]->radius = solid.distance(all[i]->centre); });
    for (auto& balls : of_arc) arc.emplace_back(std::move(balls));
  }
};

// Those of all arcs and of the hubs that are alive, in one list.
inline std::vector<Ball> all_balls(const ArcGraph& graph, const ArcBalls& balls) {
  std::vector<Ball> all;
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h]) all.push_back(balls.hub[h]);
  for (const BallChain& chain : balls.arc) all.insert(all.end(), chain.balls().begin(), chain.balls().end());
  return all;
}

}  // namespace detail
}  // namespace mspskel
