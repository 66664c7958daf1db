// The way through a tube of the collapse, inside the solid and in the tube's class.
#pragma once

#include <algorithm>
#include <functional>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mspskel/arcs/detail/tube_classes.h"
#include "mspskel/base/progress.h"

namespace mspskel {
namespace detail {

// Places of hubs, and ways to them from the origins of their nodes.
struct SettledHubs {
  struct Hub {
    bool settled = false;
    CocycleLabel from_origin;
    std::vector<Index> near;  // vertices of its part, the nearest first
  };
  const std::vector<Vector3>& position;
  std::vector<Hub> hub;
};

// Searches for the ways of several arcs, one after the other; one object a thread.
class TubeSearch {
 public:
  TubeSearch(const CollapseTubes& tubes, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
             const CrossingLabels& crossings, const TubeClasses& classes, const SettledHubs& hubs,
             const ChordPoints& points, const Execution& execution)
      : tubes_(tubes),
        surface_(surface),
        solid_(solid),
        crossings_(crossings),
        classes_(classes),
        hubs_(hubs),
        points_(points),
        execution_(execution) {}

  // Gives the arc the way of least length / clearance. One that may go outside does so where the surface has
  // no inside, since it crosses itself: steps outside have no clearance, but the class of their edges. False
  // if there is none.
  bool lead(Arc& arc, const ArcTube& tube, bool outside) {
    records_.clear();
    queue_ = {};
    for (const auto& [cost, state] : entries(arc.hub[0], 0, outside)) push({cost, state});
    std::unordered_set<std::int64_t> goal;
    for (const auto& [cost, state] : entries(arc.hub[1], static_cast<Index>(tube.nodes.size()) - 1, outside))
      goal.insert(key(state));
    if (goal.empty()) return false;
    for (Index popped = 0; !queue_.empty(); ++popped) {
      if (popped % 1024 == 0) report_progress(execution_.progress, "arcs", 0.5);
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

 private:
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
  static constexpr double kLeastClearance = 1e-9;

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
  bool step_keeps_class(const State& from, const State& to, Index h) const {
    const ChordPoints::Point &a = points_(from.vertex, from.layer), &b = points_(to.vertex, to.layer);
    const CocycleLabel edge = h == kNone ? CocycleLabel{} : classes_.along_halfedge(h);
    return a.from_vertex + crossings_(a.x, b.x) == edge + b.from_vertex;
  }

  // The points of the hub's part that it sees, in its class, with what it costs to get there. From outside
  // none has to be seen.
  std::vector<std::pair<double, State>> entries(Index h, Index place, bool outside) {
    constexpr std::size_t kWanted = 8;
    std::vector<std::pair<double, State>> result;
    const Vector3 x = hubs_.position[h];
    for (const auto layer : {ChordPoints::kMiddle, ChordPoints::kShallow}) {
      for (const Index v : hubs_.hub[h].near) {
        if (result.size() >= kWanted) return result;
        const ChordPoints::Point& point = points_(v, layer);
        const bool inside = point.clearance > 0 && !solid_.segment_crosses(x, point.x);
        if (!inside && !outside) continue;
        const CocycleLabel label = classes_.to_vertex(v) + point.from_vertex + crossings_(point.x, x);
        if (label == hubs_.hub[h].from_origin)
          result.push_back({cost_of(point.x - x, inside ? point.clearance : 0), {place, v, layer}});
      }
    }
    return result;
  }

  static double cost_of(const Vector3& step, double clearance) {
    return step.norm() / std::max(clearance, kLeastClearance);
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
    const ChordPoints::Point& here = points_(from.vertex, from.layer);
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
    std::vector<Vector3> points{hubs_.position[arc.hub[1]]};
    for (std::int64_t k = last; k != kStart; k = records_[k].before)
      points.push_back(points_(records_[k].state.vertex, records_[k].state.layer).x);
    points.push_back(hubs_.position[arc.hub[0]]);
    std::reverse(points.begin(), points.end());
    arc.points = std::move(points);
  }

  const CollapseTubes& tubes_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  const TubeClasses& classes_;
  const SettledHubs& hubs_;
  const ChordPoints& points_;
  const Execution& execution_;
  std::unordered_map<std::int64_t, Record> records_;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> queue_;
  std::int64_t order_ = 0;
};

}  // namespace detail
}  // namespace mspskel
