#pragma once

#include <algorithm>
#include <functional>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "mspskel/base/linkage.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// Points inside the solid for each vertex of the surface: the middle of its inward chord, and one just below
// the surface. Found when first asked for.
//
// Labels of ways begin at the vertex where cocycles are regions. A linking number cannot: its loop may pass
// through the vertex. It begins at the point just below, and is carried from vertex to vertex by the straight
// steps between these.
class ChordPoints {
 public:
  enum Layer { kMiddle, kShallow };
  struct Point {
    Vector3 x = Vector3::Zero();
    double clearance = 0.0;  // a lower bound of the distance to the surface; 0: x is the vertex itself
    CocycleLabel from_vertex;
  };

  ChordPoints(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
              const CrossingLabels& crossings)
      : surface_(surface), solid_(solid), crossings_(crossings) {}

  // The label's entries whose cocycles are regions, or the other ones.
  CocycleLabel part(const CocycleLabel& label, bool of_regions) const {
    CocycleLabel result;
    for (const auto& [index, value] : label.entries())
      if (crossings_.is_region(index) == of_regions) result += CocycleLabel::unit(index, value);
    return result;
  }
  // Of the straight way from the vertex, which x sees.
  CocycleLabel from_vertex(Index v, const Vector3& x) {
    const Vector3& position = surface_.position[v];
    const CocycleLabel label = crossings_(position, x);
    if (!crossings_.has_loops()) return label;
    return part(label, true) + part(crossings_(base(v), x), false);
  }
  // Linking numbers of the step along the half-edge below the surface.
  CocycleLabel below(Index h) {
    return part(crossings_(base(surface_.origin[h]), base(surface_.target(h))), false);
  }

  // Whether that step has its ends below the surface and stays inside.
  bool stays_below(Index h) {
    const Point a = (*this)(surface_.origin[h], kShallow), b = (*this)(surface_.target(h), kShallow);
    return a.clearance > 0 && b.clearance > 0 && !solid_.segment_crosses(a.x, b.x);
  }

  const Point& operator()(Index v, Layer layer) {
    const auto [it, fresh] = points_.try_emplace(2 * std::int64_t{v} + layer);
    if (!fresh) return it->second;
    Point point;
    point.x = surface_.position[v];
    place(v, layer, point);
    return points_[2 * std::int64_t{v} + layer] = std::move(point);
  }

 private:
  void place(Index v, Layer layer, Point& point) {
    constexpr double kShallowShare = 0.05, kOfEdge = 0.02;
    if (surface_.vertex_halfedge[v] == kNone) return;
    const auto chord = inward_chord(surface_, solid_, v);
    if (!chord) return;
    const Vector3& position = surface_.position[v];
    double depth = 0.5 * chord->length;
    if (layer == kShallow)
      for_each_neighbour(surface_, v, [&](Index w) {
        depth = std::min(
            {depth, kShallowShare * chord->length, kOfEdge * (surface_.position[w] - position).norm()});
      });
    if (!(depth > 0)) return;
    const Vector3 x = chord->start - depth * surface_.normal[v];
    if (!solid_.inside(x)) return;
    point.x = x;
    point.clearance = std::min(depth, solid_.closest(point.x, depth).distance);
    if (layer == kMiddle || !crossings_.has_loops())
      point.from_vertex = from_vertex(v, point.x);
    else
      point.from_vertex = part(crossings_(position, point.x), true);
  }
  Vector3 base(Index v) {
    const Point& shallow = (*this)(v, kShallow);
    return shallow.clearance > 0 ? shallow.x : surface_.position[v];
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  std::unordered_map<std::int64_t, Point> points_;
};

class TubeRouter {
 public:
  TubeRouter(ArcGraph& graph, const CollapseTubes& tubes, const SurfaceSnapshot& surface,
             const BoundingVolumeHierarchy& solid, const CrossingLabels& crossings)
      : graph_(graph),
        tubes_(tubes),
        surface_(surface),
        solid_(solid),
        crossings_(crossings),
        points_(surface, solid, crossings),
        hubs_(graph.hub_position.size()) {
    index_nodes();
    if (crossings.has_loops()) find_potential();
  }

  ClassRouting run(const Execution& execution) {
    const std::vector<bool> in_cycle = arcs_of_cycles(graph_);
    const auto count = std::min(graph_.arcs.size(), tubes_.arcs.tube.size());
    std::vector<Index> arcs;
    for (std::size_t a = 0; a < count; ++a)
      if (in_cycle[a]) arcs.push_back(static_cast<Index>(a));
    for (const Index a : arcs)
      for (const Index hub : graph_.arcs[a].hub) settle(hub);
    ClassRouting result;
    result.checked = static_cast<Index>(arcs.size());
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      report_progress(execution.progress, "arcs", static_cast<double>(i) / static_cast<double>(arcs.size()));
      const bool in_class = crossings_.along(graph_.arcs[arcs[i]].points) == wanted(arcs[i]);
      if (in_class && stays_inside(arcs[i])) continue;
      execution_ = &execution;
      const bool led = lead(arcs[i], false) || (!in_class && lead(arcs[i], true));
      ++(led ? result.routed : result.abandoned);
    }
    return result;
  }

 private:
  // A hub and a way to it from the origin of its node.
  struct Hub {
    bool settled = false;
    CocycleLabel from_origin;
    std::vector<Index> near;  // vertices of its part, the nearest first
  };
  // A point of a vertex at a place along the tube.
  struct State {
    Index place, vertex;
    ChordPoints::Layer layer;
  };
  struct Record {
    State state;
    double cost;
    std::int64_t before;  // key of the state before it, or kStart
    bool done;
  };
  static constexpr std::int64_t kStart = -1;
  static constexpr std::size_t kNear = 64;
  static constexpr double kLeastClearance = 1e-9;

  void index_nodes() {
    Index nodes = 0;
    for (const Index node : tubes_.node_of_vertex) nodes = std::max(nodes, node + 1);
    begin_.assign(static_cast<std::size_t>(nodes) + 1, 0);
    for (const Index node : tubes_.node_of_vertex)
      if (node != kNone) ++begin_[node + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    vertices_.resize(static_cast<std::size_t>(begin_.back()));
    std::vector<Index> fill(begin_.begin(), begin_.end() - 1);
    for (std::size_t v = 0; v < tubes_.node_of_vertex.size(); ++v)
      if (const Index node = tubes_.node_of_vertex[v]; node != kNone)
        vertices_[fill[node]++] = static_cast<Index>(v);
  }

  // The surface's labels and the linking numbers of the straight steps below its edges differ by a potential
  // of the vertices. It is carried along steps that stay inside; the few others, at edges as sharp as a step
  // is deep, may pass on the wrong side of a loop.
  void find_potential() {
    potential_.resize(tubes_.node_of_vertex.size());
    std::vector<bool> reached(potential_.size(), false);
    std::vector<Index> queue, doubtful;
    const auto reach = [&](Index h) {
      const Index v = surface_.origin[h], w = surface_.target(h);
      reached[w] = true;
      potential_[w] = potential_[v] + points_.below(h) - points_.part(tubes_.halfedge[h], false);
      queue.push_back(w);
    };
    for (const Index root : vertices_) {
      if (reached[root]) continue;
      reached[root] = true;
      queue.push_back(root);
      while (!queue.empty() || !doubtful.empty()) {
        if (queue.empty()) {
          const Index h = doubtful.back();
          doubtful.pop_back();
          if (!reached[surface_.target(h)]) reach(h);
          continue;
        }
        const Index v = queue.back();
        queue.pop_back();
        for_each_outgoing(v, [&](Index h) {
          if (reached[surface_.target(h)]) return;
          if (points_.stays_below(h))
            reach(h);
          else
            doubtful.push_back(h);
        });
      }
    }
  }
  template <class Visit>
  void for_each_outgoing(Index v, Visit visit) const {
    const Index first = surface_.vertex_halfedge[v];
    Index h = first;
    do {
      visit(h);
      h = surface_.next_outgoing(h);
    } while (h != first);
  }

  // Of a way from the origin of its node to the vertex. What the origins' potential adds cancels along a
  // tube.
  CocycleLabel to_vertex(Index v) const {
    if (potential_.empty()) return tubes_.to_vertex[v];
    return tubes_.to_vertex[v] + potential_[v];
  }
  CocycleLabel along_halfedge(Index h) const {
    if (potential_.empty()) return tubes_.halfedge[h];
    return tubes_.halfedge[h] + potential_[surface_.target(h)] - potential_[surface_.origin[h]];
  }

  // Finds a way from the origin of the hub's node to the hub: over the surface to the nearest vertex of its
  // part that sees the hub. Where none does the hub moves to a chord of its part. Where there is no chord,
  // the straight way to the hub is as good as any.
  void settle(Index h) {
    Hub& hub = hubs_[h];
    if (hub.settled) return;
    hub.settled = true;
    const Index node = tubes_.arcs.node_of_hub[h];
    const Vector3& x = graph_.hub_position[h];
    std::vector<std::pair<double, Index>> all;
    for (Index i = begin_[node]; i < begin_[node + 1]; ++i)
      all.push_back({(surface_.position[vertices_[i]] - x).squaredNorm(), vertices_[i]});
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), kNear));
    std::partial_sort(all.begin(), end, all.end());
    for (auto it = all.begin(); it != end; ++it) hub.near.push_back(it->second);
    if (solid_.inside(x))
      for (const Index v : hub.near) {
        const Vector3 start = surface_.position[v] - 1e-7 * surface_.normal[v];
        if (!solid_.inside(start) || solid_.segment_crosses(start, x)) continue;
        hub.from_origin = to_vertex(v) + points_.from_vertex(v, x);
        return;
      }
    for (const Index v : hub.near)
      for (const auto layer : {ChordPoints::kMiddle, ChordPoints::kShallow}) {
        const ChordPoints::Point& point = points_(v, layer);
        if (point.clearance == 0) continue;
        graph_.move_hub(h, point.x);
        hub.from_origin = to_vertex(v) + point.from_vertex;
        return;
      }
    if (!hub.near.empty())
      hub.from_origin = to_vertex(hub.near.front()) + points_.from_vertex(hub.near.front(), x);
  }

  CocycleLabel wanted(Index a) const {
    const Arc& arc = graph_.arcs[a];
    CocycleLabel label = hubs_[arc.hub[1]].from_origin - hubs_[arc.hub[0]].from_origin;
    for (const CocycleLabel& step : tubes_.arcs.tube[a].step) label += step;
    return label;
  }

  bool stays_inside(Index a) const {
    const std::vector<Vector3>& points = graph_.arcs[a].points;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (solid_.segment_crosses(points[i - 1], points[i])) return false;
    return true;
  }

  std::int64_t key(const State& s) const {
    return (std::int64_t{s.place} * surface_.vertex_count() + s.vertex) * 2 + s.layer;
  }

  // Whether the place along the tube may be had at vertex w after a step over half-edge h.
  bool follows(const ArcTube& tube, Index place, Index h, Index next) const {
    if (next < 0 || next >= static_cast<Index>(tube.nodes.size())) return false;
    const Index v = surface_.origin[h], w = surface_.target(h);
    if (tube.nodes[next] != tubes_.node_of_vertex[w]) return false;
    CocycleLabel label = tubes_.to_vertex[v] + tubes_.halfedge[h] - tubes_.to_vertex[w];
    if (next > place) label -= tube.step[place];
    if (next < place) label += tube.step[next];
    return label.is_zero();
  }

  // Whether a straight step between two points has the class of the edge.
  bool step_keeps_class(const State& from, const State& to, Index h) {
    const ChordPoints::Point a = points_(from.vertex, from.layer), b = points_(to.vertex, to.layer);
    const CocycleLabel edge = h == kNone ? CocycleLabel{} : along_halfedge(h);
    return a.from_vertex + crossings_(a.x, b.x) == edge + b.from_vertex;
  }

  // The points of the hub's part that it sees, in its class, with what it costs to get there. From outside
  // none has to be seen.
  std::vector<std::pair<double, State>> entries(Index h, Index place, bool outside) {
    constexpr std::size_t kWanted = 8;
    std::vector<std::pair<double, State>> result;
    const Vector3 x = graph_.hub_position[h];
    for (const auto layer : {ChordPoints::kMiddle, ChordPoints::kShallow}) {
      for (const Index v : hubs_[h].near) {
        if (result.size() >= kWanted) return result;
        const ChordPoints::Point& point = points_(v, layer);
        const bool inside = point.clearance > 0 && !solid_.segment_crosses(x, point.x);
        if (!inside && !outside) continue;
        const CocycleLabel label = to_vertex(v) + point.from_vertex + crossings_(point.x, x);
        if (label == hubs_[h].from_origin)
          result.push_back({cost_of(point.x - x, inside ? point.clearance : 0), {place, v, layer}});
      }
    }
    return result;
  }

  static double cost_of(const Vector3& step, double clearance) {
    return step.norm() / std::max(clearance, kLeastClearance);
  }

  // The way of least length / clearance. One that may go outside does so where the surface has no inside,
  // since it crosses itself: steps outside have no clearance, but the class of their edges.
  bool lead(Index a, bool outside) {
    const ArcTube& tube = tubes_.arcs.tube[a];
    Arc& arc = graph_.arcs[a];
    records_.clear();
    queue_ = {};
    for (const auto& [cost, state] : entries(arc.hub[0], 0, outside)) push({cost, state});
    std::unordered_set<std::int64_t> goal;
    for (const auto& [cost, state] : entries(arc.hub[1], static_cast<Index>(tube.nodes.size()) - 1, outside))
      goal.insert(key(state));
    if (goal.empty()) return false;
    for (Index popped = 0; !queue_.empty(); ++popped) {
      if (popped % 1024 == 0) report_progress(execution_->progress, "arcs", 0.5);
      const Step step = queue_.top();
      queue_.pop();
      Record& record = records_[key(step.to)];
      if (record.done || !may_go(step, outside)) continue;
      record = {step.to, step.cost, step.before, true};
      if (goal.count(key(step.to)) > 0) {
        write(arc, key(step.to));
        return true;
      }
      expand(tube, step.to, step.cost, outside);
    }
    return false;
  }

  struct Step {
    double cost;
    State to;
    std::int64_t before = kStart;
    Index halfedge = kNone;  // kNone: between the two points of a vertex
    bool outside = false;    // known to leave the solid, and to cost what that costs
    std::int64_t order = 0;
    bool operator>(const Step& other) const {
      return cost != other.cost ? cost > other.cost : order > other.order;
    }
  };

  void push(Step step) {
    step.order = order_++;
    queue_.push(step);
  }

  // Whether a step stays inside is asked where it would be the cheapest, which few steps are. One that does
  // not is put back at its price, or dropped.
  bool may_go(Step step, bool outside) {
    if (step.before == kStart) return true;
    const Record& from = records_[step.before];
    if (!step.outside) {
      const Vector3 a = points_(from.state.vertex, from.state.layer).x;
      const Vector3 b = points_(step.to.vertex, step.to.layer).x;
      if (solid_.segment_crosses(a, b)) {
        if (!outside) return false;
        step.outside = true;
        step.cost = from.cost + cost_of(b - a, 0);
        push(step);
        return false;
      }
    }
    return step_keeps_class(from.state, step.to, step.halfedge);
  }

  void expand(const ArcTube& tube, const State& from, double cost, bool outside) {
    const ChordPoints::Point here = points_(from.vertex, from.layer);
    const std::int64_t before = key(from);
    const auto step = [&](const State& to, Index h) {
      const auto known = records_.find(key(to));
      if (known != records_.end() && known->second.done) return;
      const ChordPoints::Point& there = points_(to.vertex, to.layer);
      if (there.clearance == 0 && !outside) return;
      push({cost + cost_of(there.x - here.x, std::min(here.clearance, there.clearance)), to, before, h});
    };
    step({from.place, from.vertex,
          from.layer == ChordPoints::kMiddle ? ChordPoints::kShallow : ChordPoints::kMiddle},
         kNone);
    const Index first = surface_.vertex_halfedge[from.vertex];
    Index h = first;
    do {
      for (Index next = from.place - 1; next <= from.place + 1; ++next)
        if (follows(tube, from.place, h, next)) step({next, surface_.target(h), from.layer}, h);
      h = surface_.next_outgoing(h);
    } while (h != first);
  }

  void write(Arc& arc, std::int64_t last) {
    std::vector<Vector3> points{graph_.hub_position[arc.hub[1]]};
    for (std::int64_t k = last; k != kStart; k = records_[k].before)
      points.push_back(points_(records_[k].state.vertex, records_[k].state.layer).x);
    points.push_back(graph_.hub_position[arc.hub[0]]);
    std::reverse(points.begin(), points.end());
    arc.points = std::move(points);
  }

  ArcGraph& graph_;
  const CollapseTubes& tubes_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  const Execution* execution_ = nullptr;
  ChordPoints points_;
  std::vector<Hub> hubs_;
  std::vector<Index> begin_, vertices_;  // of each node
  std::vector<CocycleLabel> potential_;  // per vertex; empty where all cocycles are regions
  std::unordered_map<std::int64_t, Record> records_;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> queue_;
  std::int64_t order_ = 0;
};

}  // namespace detail

MSPSKEL_INLINE std::vector<bool> arcs_of_cycles(const ArcGraph& graph) {
  std::vector<bool> in(graph.arcs.size());
  for (std::size_t a = 0; a < in.size(); ++a) in[a] = graph.arcs[a].alive;
  const auto at = graph.incidence();
  std::vector<std::size_t> degree(at.size());
  std::vector<Index> leaves;
  for (std::size_t h = 0; h < at.size(); ++h) {
    degree[h] = at[h].size();
    if (degree[h] == 1) leaves.push_back(static_cast<Index>(h));
  }
  while (!leaves.empty()) {
    const Index leaf = leaves.back();
    leaves.pop_back();
    for (const Index a : at[leaf]) {
      if (!in[a]) continue;
      in[a] = false;
      const Index other = graph.arcs[a].hub[0] == leaf ? graph.arcs[a].hub[1] : graph.arcs[a].hub[0];
      if (--degree[other] == 1) leaves.push_back(other);
    }
  }
  return in;
}

MSPSKEL_INLINE ClassRouting route_by_class(ArcGraph& graph, const CollapseTubes& tubes,
                                           const SurfaceSnapshot& input, const BoundingVolumeHierarchy& solid,
                                           const CrossingLabels& crossings, const Execution& execution) {
  if (crossings.rank() == 0) return {};
  return detail::TubeRouter(graph, tubes, input, solid, crossings).run(execution);
}

}  // namespace mspskel
