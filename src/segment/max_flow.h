// Maximum flow and minimum cut on small graphs of real capacities.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Dinic's algorithm: shortest augmenting paths, a level graph at a time. O(nodes^2 * edges), near linear on
// the bands that it is used for.
class MaxFlow {
 public:
  explicit MaxFlow(Index nodes) : first_(nodes, kNone), level_(nodes), next_arc_(nodes) {}

  // An edge that carries as much in either direction.
  void add_edge(Index a, Index b, double capacity) {
    add_arc(a, b, capacity);
    add_arc(b, a, capacity);
  }
  // Per node: whether it is on the source's side of a minimum cut, the one nearest to the source.
  std::vector<char> cut(Index source, Index sink) {
    while (set_levels(source, sink)) {
      next_arc_ = first_;
      while (push_path(source, sink)) {
      }
    }
    std::vector<char> side(level_.size());
    for (std::size_t n = 0; n < side.size(); ++n) side[n] = level_[n] != kNone;
    return side;
  }

 private:
  // What is left of a capacity after this share of it counts as nothing: rounding must not keep a path open.
  static constexpr double kRounding = 1e-12;

  struct Arc {
    Index to, next;
    double capacity, left;
    bool open() const { return left > kRounding * capacity; }
  };

  void add_arc(Index from, Index to, double capacity) {
    arcs_.push_back({to, first_[from], capacity, capacity});
    first_[from] = static_cast<Index>(arcs_.size()) - 1;
  }
  bool set_levels(Index source, Index sink) {
    std::fill(level_.begin(), level_.end(), kNone);
    level_[source] = 0;
    queue_.assign(1, source);
    // No path of fewest arcs has a node as far as the sink.
    for (std::size_t i = 0; i < queue_.size() && level_[sink] == kNone; ++i)
      for (Index a = first_[queue_[i]]; a != kNone; a = arcs_[a].next)
        if (arcs_[a].open() && level_[arcs_[a].to] == kNone) {
          level_[arcs_[a].to] = level_[queue_[i]] + 1;
          queue_.push_back(arcs_[a].to);
        }
    return level_[sink] != kNone;
  }
  bool push_path(Index source, Index sink) {
    path_.clear();
    Index n = source;
    while (n != sink) {
      Index& a = next_arc_[n];
      while (a != kNone && !(arcs_[a].open() && level_[arcs_[a].to] == level_[n] + 1)) a = arcs_[a].next;
      if (a != kNone) {
        path_.push_back(a);
        n = arcs_[a].to;
        continue;
      }
      if (path_.empty()) return false;
      // A dead end: one step back, and never this way again.
      n = arcs_[path_.back() ^ 1].to;
      path_.pop_back();
      next_arc_[n] = arcs_[next_arc_[n]].next;
    }
    double flow = std::numeric_limits<double>::infinity();
    for (const Index a : path_) flow = std::min(flow, arcs_[a].left);
    for (const Index a : path_) {
      arcs_[a].left -= flow;
      arcs_[a ^ 1].left += flow;
    }
    return true;
  }

  std::vector<Arc> arcs_;  // an arc and its reverse stand side by side
  std::vector<Index> first_, level_, next_arc_, queue_, path_;
};

}  // namespace mspskel::detail
