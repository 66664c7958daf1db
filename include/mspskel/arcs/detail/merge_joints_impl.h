#pragma once

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

// Replaces the arc's end at `hub` and the points that follow inside the ball by a straight line from the
// centre.
inline void enter_ball(Arc& arc, int end, const Vector3& centre, double radius) {
  if (end == 1) std::reverse(arc.points.begin(), arc.points.end());
  std::size_t first_outside = 1;
  while (first_outside + 1 < arc.points.size() && (arc.points[first_outside] - centre).norm() < radius)
    ++first_outside;
  // Keep the last point inside: from there on the arc is as it was.
  const std::size_t keep = first_outside > 1 ? first_outside - 1 : first_outside;
  std::vector<Vector3> points{centre};
  if (first_outside == 1) points.push_back(arc.points.front());
  points.insert(points.end(), arc.points.begin() + static_cast<std::ptrdiff_t>(keep), arc.points.end());
  arc.points = std::move(points);
  if (end == 1) std::reverse(arc.points.begin(), arc.points.end());
}

// The contraction of arcs, one joint after the other. Only the arcs at a joint change when it takes in
// another one, so only these are judged again.
class JointMerging {
 public:
  JointMerging(ArcGraph& graph, const BoundingVolumeHierarchy& solid, double overlap,
               const CrossingLabels& crossings)
      : graph_(graph),
        solid_(solid),
        overlap_(overlap),
        crossings_(crossings),
        at_(graph.incidence()),
        radius_(graph.hub_position.size(), 0.0),
        hub_now_(graph.hub_position.size()),
        gone_to_(graph.arcs.size(), kNone) {
    std::iota(hub_now_.begin(), hub_now_.end(), 0);
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h] && at_[h].size() > 2) radius_[h] = solid.distance(graph.hub_position[h]);
    for (Index a = 0; a < graph.arc_count(); ++a) push(a);
  }

  Index run() {
    Index merged = 0;
    while (!queue_.empty()) {
      const auto [distance, arc] = queue_.top();
      queue_.pop();
      if (distance != this->distance(arc) || !may_go(arc)) continue;
      contract(arc);
      ++merged;
    }
    if (merged > 0) pass_vertices_on();
    return merged;
  }

 private:
  double distance(Index a) const {
    const Arc& arc = graph_.arcs[a];
    return arc.alive ? (arc.points.front() - arc.points.back()).norm() : -1.0;
  }
  double reach(const Arc& arc) const { return overlap_ * std::min(radius_[arc.hub[0]], radius_[arc.hub[1]]); }
  void push(Index a) {
    const Arc& arc = graph_.arcs[a];
    if (arc.alive && arc.hub[0] != arc.hub[1] && distance(a) < reach(arc)) queue_.push({distance(a), a});
  }

  bool may_go(Index a) const {
    const Arc& arc = graph_.arcs[a];
    if (arc.hub[0] == arc.hub[1]) return false;
    if (at_[arc.hub[0]].size() < 3 || at_[arc.hub[1]].size() < 3) return false;
    // An arc that leaves the balls goes round something and is no connection within them.
    if (distance(a) >= reach(arc) || arc_length(arc) > 3 * std::max(reach(arc), distance(a))) return false;
    // Balls that overlap by less than a joint may have the surface between their centres.
    if (distance(a) >= std::max(radius_[arc.hub[0]], radius_[arc.hub[1]]) &&
        solid_.segment_crosses(arc.points.front(), arc.points.back()))
      return false;
    // Contracting one of two parallel arcs would make a loop of the other.
    const auto joins = [&](Index b, int end) {
      const Arc& other = graph_.arcs[b];
      return other.hub[0] == arc.hub[end] && other.hub[1] == arc.hub[1 - end];
    };
    for (const Index b : at_[arc.hub[0]])
      if (b != a && (joins(b, 0) || joins(b, 1))) return false;
    return keeps_classes(a);
  }

  // Of the arc's hubs, the one that stays: that with the larger ball.
  int staying_end(const Arc& arc) const { return radius_[arc.hub[0]] < radius_[arc.hub[1]] ? 1 : 0; }

  // Whether every arc that would enter the ball anew goes round nothing on the way there.
  bool keeps_classes(Index a) const {
    if (crossings_.rank() == 0) return true;
    const Arc& arc = graph_.arcs[a];
    const int stays = staying_end(arc);
    const Index keep = arc.hub[stays], gone = arc.hub[1 - stays];
    const std::vector<Vector3> back = points_from(arc, 1 - stays);
    for (const Index b : at_[gone])
      for (const int end : {0, 1}) {
        if (b == a || graph_.arcs[b].hub[end] != gone) continue;
        Arc entered = graph_.arcs[b];
        enter_ball(entered, end, graph_.hub_position[keep], radius_[keep]);
        std::vector<Vector3> ring = points_from(entered, end);
        const std::vector<Vector3> before = points_from(graph_.arcs[b], 1 - end);
        ring.insert(ring.end(), before.begin() + 1, before.end());
        ring.insert(ring.end(), back.begin() + 1, back.end() - 1);
        if (crossings_.goes_round(ring)) return false;
      }
    return true;
  }

  void contract(Index a) {
    Arc& arc = graph_.arcs[a];
    const int stays = staying_end(arc);
    const Index keep = arc.hub[stays], gone = arc.hub[1 - stays];
    for (const Index b : at_[gone])
      if (b != a)
        for (const int end : {0, 1})
          if (graph_.arcs[b].hub[end] == gone)
            enter_ball(graph_.arcs[b], end, graph_.hub_position[keep], radius_[keep]);
    arc.alive = false;
    graph_.hub_alive[gone] = false;
    gone_to_[a] = hub_now_[gone] = keep;
    for (const Index b : at_[gone])
      for (Index& hub : graph_.arcs[b].hub)
        if (hub == gone) hub = keep;
    std::vector<Index> both;
    std::merge(at_[keep].begin(), at_[keep].end(), at_[gone].begin(), at_[gone].end(),
               std::back_inserter(both));
    both.erase(std::remove(both.begin(), both.end(), a), both.end());
    at_[keep] = std::move(both);
    at_[gone].clear();
    for (const Index b : at_[keep]) push(b);
  }

  void pass_vertices_on() {
    const auto current = [&](Index hub) {
      while (hub_now_[hub] != hub) hub = hub_now_[hub] = hub_now_[hub_now_[hub]];
      return hub;
    };
    for (std::size_t v = 0; v < graph_.arc_of_vertex.size(); ++v) {
      Index& hub = graph_.hub_of_vertex[v];
      if (const Index arc = graph_.arc_of_vertex[v]; arc != kNone && gone_to_[arc] != kNone) {
        graph_.arc_of_vertex[v] = kNone;
        hub = gone_to_[arc];
      }
      if (hub != kNone) hub = current(hub);
    }
  }

  using Entry = std::pair<double, Index>;  // distance of the hubs, arc

  ArcGraph& graph_;
  const BoundingVolumeHierarchy& solid_;
  const double overlap_;
  const CrossingLabels& crossings_;
  std::vector<std::vector<Index>> at_;
  std::vector<double> radius_;  // of joints
  std::vector<Index> hub_now_;  // per hub the one that took it in, or itself
  std::vector<Index> gone_to_;  // per arc the hub that it was contracted to, or kNone
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace detail

MSPSKEL_INLINE Index merge_joints(ArcGraph& graph, const BoundingVolumeHierarchy& solid, double overlap,
                                  const CrossingLabels& crossings) {
  return detail::JointMerging(graph, solid, overlap, crossings).run();
}

}  // namespace mspskel
