// The points of all arcs under one numbering, and moves of them that stay in the solid.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {
namespace detail {

// All points of an arc graph under one numbering: hubs first, then the inner points of the arcs.
struct ArcPoints {
  enum class Kind : std::uint8_t { kInner, kJoint, kLeaf, kDead };

  Index hub_count = 0;
  std::vector<Vector3> x;
  std::vector<Kind> kind;
  std::vector<std::vector<Index>> next;  // neighbours
  std::vector<std::vector<Index>>
      chains;  // the points of each arc in order, hubs included; empty for dead arcs

  explicit ArcPoints(const ArcGraph& graph)
      : hub_count(graph.hub_count()), x(graph.hub_position), chains(graph.arcs.size()) {
    kind.assign(x.size(), Kind::kDead);
    const auto at = graph.incidence();
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h]) kind[h] = at[h].size() == 1 ? Kind::kLeaf : Kind::kJoint;
    for (Index a = 0; a < graph.arc_count(); ++a) {
      const Arc& arc = graph.arcs[a];
      if (!arc.alive) continue;
      chains[a].push_back(arc.hub[0]);
      for (std::size_t i = 1; i + 1 < arc.points.size(); ++i) {
        chains[a].push_back(static_cast<Index>(x.size()));
        x.push_back(arc.points[i]);
        kind.push_back(Kind::kInner);
      }
      chains[a].push_back(arc.hub[1]);
    }
    next.resize(x.size());
    for (const auto& chain : chains)
      for (std::size_t i = 1; i < chain.size(); ++i) {
        next[chain[i]].push_back(chain[i - 1]);
        next[chain[i - 1]].push_back(chain[i]);
      }
  }

  void write_back(ArcGraph& graph) const {
    for (Index h = 0; h < graph.hub_count(); ++h) graph.hub_position[h] = x[h];
    for (std::size_t a = 0; a < chains.size(); ++a)
      for (std::size_t i = 0; i < chains[a].size(); ++i) graph.arcs[a].points[i] = x[chains[a][i]];
  }

  Index count() const { return static_cast<Index>(x.size()); }

  // Of all arcs.
  double length() const {
    double sum = 0;
    for (const auto& chain : chains)
      for (std::size_t i = 1; i < chain.size(); ++i) sum += (x[chain[i]] - x[chain[i - 1]]).norm();
    return sum;
  }
};

// The arc at even steps; where a step would cut a corner through the surface or round a handle, the corner
// stays between.
inline std::vector<Vector3> resampled_inside(const Arc& arc, double step,
                                             const BoundingVolumeHierarchy& solid,
                                             const CrossingLabels& crossings) {
  const std::vector<Vector3> even = resampled(arc, step);
  const double share = arc_length(arc) / static_cast<double>(even.size() - 1);
  std::vector<Vector3> points{even.front()}, cut;
  std::size_t corner = 0;
  double walked = 0;  // from the start to the corner
  const auto pass = [&] {
    ++corner;
    walked += (arc.points[corner] - arc.points[corner - 1]).norm();
  };
  for (std::size_t k = 1; k < even.size(); ++k) {
    const double from = share * static_cast<double>(k - 1), to = share * static_cast<double>(k);
    while (corner + 1 < arc.points.size() && walked <= from) pass();
    cut.assign(1, even[k - 1]);
    for (; corner + 1 < arc.points.size() && walked < to; pass()) cut.push_back(arc.points[corner]);
    cut.push_back(even[k]);
    if (solid.segment_crosses(even[k - 1], even[k]) || crossings.goes_round(cut))
      points.insert(points.end(), cut.begin() + 1, cut.end() - 1);
    points.push_back(even[k]);
  }
  return points;
}

// The move of every point towards its goal, shortened until no edge of the graph meets the surface that did
// not before, none goes round a handle on its way, and no piece of the graph has left the solid as a whole.
class InsideMove {
 public:
  InsideMove(ArcPoints& points, const BoundingVolumeHierarchy& solid, const std::vector<Vector3>& goal,
             const CrossingLabels& crossings, const Execution& execution)
      : points_(points),
        solid_(solid),
        goal_(goal),
        crossings_(crossings),
        execution_(execution),
        share_(points.x.size(), 1.0),
        cuts_(points.x.size(), 0) {
    for (const auto& chain : points.chains)
      for (std::size_t i = 1; i < chain.size(); ++i) edges_.push_back({chain[i - 1], chain[i]});
    asked_.assign(edges_.size(), -1);
    crosses_.assign(edges_.size(), 0);
  }

  void run() {
    // Each attempt after the first ones stops a point for good, so this ends.
    for (attempt_ = 0; cut_crossing_edges() || cut_pieces_outside(); ++attempt_) {
    }
    for (Index i = 0; i < points_.count(); ++i) points_.x[i] = moved(i);
  }

 private:
  Vector3 moved(Index i) const { return points_.x[i] + share_[i] * (goal_[i] - points_.x[i]); }
  void cut(Index i) {
    share_[i] = attempt_ < 4 ? 0.5 * share_[i] : 0.0;
    ++cuts_[i];
  }

  bool crosses(std::size_t e) const {
    const auto [a, b] = edges_[e];
    return solid_.segment_crosses(moved(a), moved(b)) ||
           crossings_.goes_round({points_.x[a], points_.x[b], moved(b), moved(a)});
  }

  bool moves(std::size_t e) const {
    const auto [a, b] = edges_[e];
    return share_[a] != 0 || share_[b] != 0;
  }

  // An edge is asked again if the share of one of its ends was cut.
  void ask(std::size_t e) {
    const auto [a, b] = edges_[e];
    if (asked_[e] == cuts_[a] + cuts_[b]) return;
    asked_[e] = cuts_[a] + cuts_[b];
    crosses_[e] = crosses(e);
  }

  // All are asked at once, and then again, in order, those whose ends the ones before have cut.
  bool cut_crossing_edges() {
    std::fill(crosses_.begin(), crosses_.end(), 0);
    parallel_for(
        static_cast<Index>(edges_.size()), "arcs", execution_, [] { return 0; },
        [&](Index e, int) {
          if (moves(e)) ask(e);
        });
    bool changed = false;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!moves(e)) continue;
      ask(e);
      if (!crosses_[e]) continue;
      for (const Index i : edges_[e]) cut(i);
      changed = true;
    }
    return changed;
  }

  // Edges that cross nothing hold for the whole piece that they join: one point tells where it is.
  bool cut_pieces_outside() {
    bool changed = false;
    std::vector<bool> seen(points_.x.size(), false);
    std::vector<Index> piece;
    for (Index seed = 0; seed < points_.count(); ++seed) {
      if (seen[seed] || points_.kind[seed] == ArcPoints::Kind::kDead) continue;
      piece.assign(1, seed);
      seen[seed] = true;
      for (std::size_t k = 0; k < piece.size(); ++k)
        for (const Index next : points_.next[piece[k]])
          if (!seen[next]) {
            seen[next] = true;
            piece.push_back(next);
          }
      const auto moves = std::find_if(piece.begin(), piece.end(), [&](Index i) { return share_[i] > 0; });
      if (moves == piece.end() || solid_.inside(moved(*moves)) || !solid_.inside(points_.x[*moves])) continue;
      for (const Index i : piece) cut(i);
      changed = true;
    }
    return changed;
  }

  ArcPoints& points_;
  const BoundingVolumeHierarchy& solid_;
  const std::vector<Vector3>& goal_;
  const CrossingLabels& crossings_;
  const Execution& execution_;
  std::vector<double> share_;
  std::vector<int> cuts_;              // how often a point's share was cut
  std::vector<int> asked_;             // per edge, the cuts of its ends when it was last asked
  std::vector<std::uint8_t> crosses_;  // per edge, what it answered in this pass
  std::vector<std::array<Index, 2>> edges_;
  int attempt_ = 0;
};

inline void move_inside(ArcPoints& points, const BoundingVolumeHierarchy& solid,
                        const std::vector<Vector3>& goal, const CrossingLabels& crossings,
                        const Execution& execution) {
  InsideMove(points, solid, goal, crossings, execution).run();
}

}  // namespace detail
}  // namespace mspskel
