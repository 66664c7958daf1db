// Lower bounds of the cost of ways through a graph, by their costs from a few far vertices.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

// A way from v to g costs at least the difference of what the ways from any vertex to v and to g cost
// (Goldberg and Harrelson, "Computing the shortest path: A* search meets graph theory", 2005). Costs have to
// be the same in both directions; what closes edges later only makes ways dearer.
class Landmarks {
  static constexpr std::size_t kCount = 8;
  static constexpr double kUnreached = std::numeric_limits<double>::infinity();
  using Costs = std::array<double, kCount>;

 public:
  // What is to be reached: whichever of several vertices is nearest.
  class Goal {
   public:
    // At most the cost of any way from v. Along an edge it falls by at most the edge's cost.
    double bound(Index v) const {
      double most = 0;
      if (landmarks_ == nullptr) return most;
      const Costs& cost = landmarks_->cost_[static_cast<std::size_t>(v)];
      for (std::size_t i = 0; i < kCount; ++i)
        if (cost[i] < kUnreached) most = std::max({most, cost[i] - far_[i], near_[i] - cost[i]});
      return most;
    }

   private:
    friend class Landmarks;
    const Landmarks* landmarks_ = nullptr;
    Costs near_{}, far_{};
  };

  bool empty() const { return cost_.empty(); }

  // edges(v, visit) calls visit(w, cost) for every edge of v. The first landmark is a vertex farthest from
  // `from`, each other one a vertex farthest from those before it. Cost: kCount searches of the graph.
  template <class Edges>
  void build(Index vertices, Index from, Edges edges) {
    Costs none;
    none.fill(kUnreached);
    cost_.assign(static_cast<std::size_t>(vertices), none);
    std::vector<double> nearest(static_cast<std::size_t>(vertices), kUnreached);
    search(from, 0, edges);
    Index next = farthest([&](Index v) { return cost_[v][0]; });
    for (std::size_t i = 0; i < kCount; ++i) {
      for (Costs& cost : cost_) cost[i] = kUnreached;
      search(next, i, edges);
      for (std::size_t v = 0; v < nearest.size(); ++v) nearest[v] = std::min(nearest[v], cost_[v][i]);
      next = farthest([&](Index v) { return nearest[v]; });
    }
  }

  // Without landmarks all bounds are 0.
  template <class Vertices>
  Goal goal(const Vertices& vertices) const {
    Goal goal;
    if (empty()) return goal;
    goal.landmarks_ = this;
    goal.near_.fill(kUnreached);
    goal.far_.fill(0);
    for (const Index v : vertices)
      for (std::size_t i = 0; i < kCount; ++i) {
        goal.near_[i] = std::min(goal.near_[i], cost_[v][i]);
        goal.far_[i] = std::max(goal.far_[i], cost_[v][i]);
      }
    for (double& near : goal.near_)
      if (near == kUnreached) near = 0;  // says nothing of what is reached
    return goal;
  }

 private:
  template <class Cost>
  Index farthest(Cost cost) const {
    Index best = kNone;
    for (Index v = 0; v < static_cast<Index>(cost_.size()); ++v)
      if (cost(v) < kUnreached && (best == kNone || cost(v) > cost(best))) best = v;
    return best;
  }

  template <class Edges>
  void search(Index from, std::size_t i, const Edges& edges) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    const auto offer = [&](Index v, double cost) {
      double& known = cost_[static_cast<std::size_t>(v)][i];
      if (!(cost < known)) return;
      known = cost;
      queue.push({cost, v});
    };
    offer(from, 0);
    while (!queue.empty()) {
      const auto [cost, v] = queue.top();
      queue.pop();
      if (cost > cost_[static_cast<std::size_t>(v)][i]) continue;
      edges(v, [&, cost = cost](Index w, double more) { offer(w, cost + more); });
    }
  }

  std::vector<Costs> cost_;  // per vertex the costs from the landmarks
};

}  // namespace detail
}  // namespace mspskel
