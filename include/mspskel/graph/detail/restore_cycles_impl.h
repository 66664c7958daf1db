#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/complex_topology.h"

namespace mspskel {
namespace detail {

// Shortest paths through the solid by cost and label. Each vertex of the surface stands for two points
// inside: the middle of its inward chord (node v) and one just below the surface (node v + n, dear).
class LabelledPaths {
 public:
  LabelledPaths(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                const CrossingLabels& crossings)
      : surface_(surface), solid_(solid), crossings_(crossings) {
    const Index n = surface.vertex_count();
    point_.resize(2 * static_cast<std::size_t>(n));
    clearance_.assign(point_.size(), 0.0);
    bound_.assign(point_.size(), 0.0);
    for (Index v = 0; v < n; ++v) {
      if (surface.vertex_halfedge[v] == kNone) continue;
      const Vector3 inward = -surface.normal[v];
      const Vector3 start = surface.position[v] + 1e-7 * inward;
      const auto hit = solid.first_hit(start, inward);
      if (!hit) continue;
      const double shallow = std::min(0.05 * hit->distance, 0.02 * edge_length(v));
      place(v, start, 0.5 * hit->distance * inward);
      place(v + n, start, shallow * inward);
    }
  }

  // Points strictly between a and b along the cheapest way whose label satisfies `wanted`, or none.
  template <class Wanted>
  std::optional<std::vector<Vector3>> find(const Vector3& a, const Vector3& b, Wanted wanted);

 private:
  // A way to a node with a given label, and the state that it came from.
  struct State {
    Index node, from;
    double cost;
    CocycleLabel label;
    bool done;
  };

  double edge_length(Index v) const {
    return (surface_.position[surface_.target(surface_.vertex_halfedge[v])] - surface_.position[v]).norm();
  }
  void place(Index node, const Vector3& start, const Vector3& way) {
    point_[node] = start + way;
    bound_[node] = way.norm() + 2e-7;
    clearance_[node] = kUnknown;
  }
  // Distance to the surface, 0 where the node is not usable. Found when first asked for: most nodes never
  // are.
  double clearance(Index node) {
    double& known = clearance_[node];
    if (known == kUnknown)
      known = solid_.inside(point_[node])
                  ? std::min(bound_[node], solid_.closest(point_[node], bound_[node]).distance)
                  : 0.0;
    return known;
  }
  double step_cost(Index u, Index w) {
    return (point_[u] - point_[w]).norm() / std::max(std::min(clearance(u), clearance(w)), 1e-6);
  }
  bool improves(Index node, double cost, const CocycleLabel& label) const;
  void reach(Index node, double cost, CocycleLabel label, Index from);
  void expand(Index state);
  std::vector<std::pair<double, Index>> entries(const Vector3& x);
  std::vector<Vector3> trace(Index state) const {
    std::vector<Vector3> points;
    for (; state != kNone; state = states_[state].from) points.push_back(point_[states_[state].node]);
    std::reverse(points.begin(), points.end());
    return points;
  }

  static constexpr std::size_t kLabels = 12;  // at a node
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  std::vector<Vector3> point_;
  static constexpr double kUnknown = -1;
  std::vector<double> clearance_, bound_;
  std::vector<State> states_;
  std::vector<std::vector<Index>> at_;  // states of each node
  std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>> queue_;
};

// Whether reach would keep the way.
inline bool LabelledPaths::improves(Index node, double cost, const CocycleLabel& label) const {
  for (const Index s : at_[node])
    if (states_[s].label == label) return !states_[s].done && cost < states_[s].cost;
  return at_[node].size() < kLabels;
}

// Keeps the cheapest way for each label, and few labels a node: those are the ways that wind least.
inline void LabelledPaths::reach(Index node, double cost, CocycleLabel label, Index from) {
  if (!improves(node, cost, label)) return;
  for (const Index s : at_[node]) {
    if (states_[s].label != label) continue;
    states_[s].cost = cost;
    states_[s].from = from;
    queue_.push({cost, s});
    return;
  }
  at_[node].push_back(static_cast<Index>(states_.size()));
  queue_.push({cost, static_cast<Index>(states_.size())});
  states_.push_back({node, from, cost, std::move(label), false});
}

inline void LabelledPaths::expand(Index state) {
  const Index n = surface_.vertex_count(), node = states_[state].node, v = node % n;
  const CocycleLabel label = states_[state].label;
  const double cost = states_[state].cost;
  const auto step = [&](Index to) {
    if (clearance(to) <= 0) return;
    const double there = cost + step_cost(node, to);
    const CocycleLabel winding = label + crossings_(point_[node], point_[to]);
    // Most steps lead back to where a cheaper way has been, and need no query.
    if (improves(to, there, winding) && !solid_.segment_crosses(point_[node], point_[to]))
      reach(to, there, winding, state);
  };
  step(node < n ? node + n : v);
  const Index first = surface_.vertex_halfedge[v];
  Index h = first;
  do {
    step(surface_.target(h));
    step(surface_.target(h) + n);
    h = surface_.next_outgoing(h);
  } while (h != first);
}

// The nearest nodes that x sees, with their distances.
inline std::vector<std::pair<double, Index>> LabelledPaths::entries(const Vector3& x) {
  constexpr std::size_t kWanted = 8, kTried = 128;
  std::vector<std::pair<double, Index>> all, seen;
  for (std::size_t i = 0; i < point_.size(); ++i)
    if (clearance_[i] != 0) all.push_back({(point_[i] - x).norm(), static_cast<Index>(i)});
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), kTried));
  std::partial_sort(all.begin(), end, all.end());
  for (auto it = all.begin(); it != end && seen.size() < kWanted; ++it)
    if (clearance(it->second) > 0 && !solid_.segment_crosses(x, point_[it->second])) seen.push_back(*it);
  return seen;
}

template <class Wanted>
std::optional<std::vector<Vector3>> LabelledPaths::find(const Vector3& a, const Vector3& b, Wanted wanted) {
  states_.clear();
  at_.assign(point_.size(), {});
  queue_ = {};
  for (const auto& [distance, node] : entries(a))
    reach(node, distance / clearance(node), crossings_(a, point_[node]), kNone);
  std::map<Index, CocycleLabel> goal;
  for (const auto& [distance, node] : entries(b)) goal[node] = crossings_(point_[node], b);
  while (!queue_.empty()) {
    const auto [cost, state] = queue_.top();
    queue_.pop();
    if (states_[state].done || cost > states_[state].cost) continue;
    states_[state].done = true;
    const auto end = goal.find(states_[state].node);
    if (end != goal.end() && wanted(states_[state].label + end->second)) return trace(state);
    expand(state);
  }
  return std::nullopt;
}

inline CocycleLabel label_along(const CrossingLabels& crossings, const std::vector<Vector3>& points) {
  CocycleLabel label;
  for (std::size_t i = 1; i < points.size(); ++i) label += crossings(points[i - 1], points[i]);
  return label;
}

// Arcs in the order in which their cycles count: doubtful ones last, each kind by length.
inline std::vector<Index> arcs_by_trust(const ArcGraph& graph, const std::vector<bool>& doubtful) {
  std::vector<std::pair<std::pair<bool, double>, Index>> keyed;
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (graph.arcs[a].alive)
      keyed.push_back({{!doubtful.empty() && doubtful[a], arc_length(graph.arcs[a])}, a});
  std::sort(keyed.begin(), keyed.end());
  std::vector<Index> order;
  order.reserve(keyed.size());
  for (const auto& [key, a] : keyed) order.push_back(a);
  return order;
}

}  // namespace detail

MSPSKEL_INLINE CycleRestoration restore_cycles(ArcGraph& graph, const SurfaceSnapshot& surface,
                                               const BoundingVolumeHierarchy& solid,
                                               const VolumeCocycles& cocycles,
                                               const std::vector<bool>& doubtful) {
  CycleRestoration result;
  if (cocycles.rank == 0) return result;
  const CrossingLabels crossings(cocycles);
  LabelledForest forest(graph.hub_count());
  LabelRank rank;
  CocycleLabel loop;
  std::optional<detail::LabelledPaths> paths;
  std::vector<std::pair<Index, CocycleLabel>> dependent;  // arc, label of its cycle
  for (const Index a : detail::arcs_by_trust(graph, doubtful)) {
    const Arc& arc = graph.arcs[a];
    const CocycleLabel label = detail::label_along(crossings, arc.points);
    if (forest.join(arc.hub[0], arc.hub[1], label, loop)) continue;
    ++result.cycles;
    if (!rank.insert(loop)) dependent.push_back({a, loop - label});
  }
  for (const auto& [a, rest] : dependent) {
    Arc& arc = graph.arcs[a];
    if (!paths) paths.emplace(surface, solid, crossings);
    CocycleLabel found;
    const auto way =
        paths->find(arc.points.front(), arc.points.back(), [&, back = rest](const CocycleLabel& label) {
          found = back + label;
          return !found.is_zero() && !rank.depends(found);
        });
    if (!way) {
      ++result.abandoned;
      continue;
    }
    rank.insert(found);
    ++result.restored;
    std::vector<Vector3> points{arc.points.front()};
    points.insert(points.end(), way->begin(), way->end());
    points.push_back(arc.points.back());
    arc.points = std::move(points);
  }
  result.rank = rank.rank();
  return result;
}

}  // namespace mspskel
