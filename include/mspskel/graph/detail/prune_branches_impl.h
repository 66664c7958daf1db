#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "mspskel/graph/detail/arc_balls.h"

namespace mspskel {

namespace detail {

// A leaf arc of which the surface itself tells nothing needs better evidence: what it is measured by changes
// with the rest of the skeleton.
inline constexpr double kNoTipCaution = 2.2;

inline constexpr std::size_t kNoLeaf = static_cast<std::size_t>(-1);

// Which vertices belong to which arc, and for every leaf arc the joint that it leaves.
struct ArcParts {
  std::vector<std::vector<Index>> vertices;      // per arc; a leaf arc has those of its tip as well
  std::vector<std::vector<Index>> hub_vertices;  // per hub
  std::vector<std::array<Index, 2>> leaves;      // {arc, joint}

  ArcParts(const ArcGraph& graph, const std::vector<std::vector<Index>>& at)
      : vertices(graph.arcs.size()), hub_vertices(graph.hub_position.size()) {
    std::vector<Index> leaf_arc_of_hub(graph.hub_position.size(), kNone);
    for (Index a = 0; a < graph.arc_count(); ++a) {
      if (!graph.arcs[a].alive) continue;
      for (const int end : {0, 1}) {
        const Index tip = graph.arcs[a].hub[end], joint = graph.arcs[a].hub[1 - end];
        if (at[tip].size() != 1 || at[joint].size() < 3) continue;
        leaves.push_back({a, joint});
        leaf_arc_of_hub[tip] = a;
      }
    }
    for (Index v = 0; v < static_cast<Index>(graph.arc_of_vertex.size()); ++v) {
      const Index hub = graph.hub_of_vertex[v];
      const Index a = graph.arc_of_vertex[v] != kNone ? graph.arc_of_vertex[v]
                      : hub != kNone                  ? leaf_arc_of_hub[hub]
                                                      : kNone;
      if (a != kNone) vertices[a].push_back(v);
      if (hub != kNone) hub_vertices[hub].push_back(v);
    }
  }
};

// The slices of the part that a leaf arc leaves: those of the other arcs' vertices near the joint.
struct ParentSlices {
  double perimeter = 0.0;   // median
  double half_width = 0.0;  // median

  ParentSlices(const ArcGraph& graph, const SurfaceSnapshot& surface, const VertexSlices& slices,
               const ArcParts& parts, const std::vector<Index>& arcs_at_joint, Index leaf, Index joint,
               double reach) {
    std::vector<double> perimeters, widths;
    const auto collect = [&](Index v) {
      if (!slices.valid[v] || (surface.position[v] - graph.hub_position[joint]).norm() >= reach) return;
      perimeters.push_back(slices.perimeter[v]);
      widths.push_back(slices.half_width[v]);
    };
    for (const Index b : arcs_at_joint)
      if (b != leaf)
        for (const Index v : parts.vertices[b]) collect(v);
    for (const Index v : parts.hub_vertices[joint]) collect(v);
    perimeter = value_at_rank(std::move(perimeters), 0.5);
    half_width = value_at_rank(std::move(widths), 0.5);
  }
};

// Half width and perimeter of the visible section across a direction; zeros where there is none.
inline std::array<double, 2> section_size(const BoundingVolumeHierarchy& solid, const Vector3& x,
                                          const Vector3& along) {
  constexpr int kRays = 16;
  if (along.norm() == 0) return {0.0, 0.0};
  const VisibleSection section = visible_section(solid, x, along.normalized(), kRays);
  if (!section.closed) return {0.0, 0.0};
  const double area = kPi * section.radius * section.radius;
  const double perimeter = std::sqrt(4 * kPi * area / std::max(section.roundness, 1e-6));
  return {section.half_width, perimeter};
}

// Medians over at most nine points of an arc outside the joint's ball.
inline std::array<double, 2> arc_sections(const Arc& arc, const Ball& joint,
                                          const BoundingVolumeHierarchy& solid) {
  constexpr std::size_t kMost = 9;
  std::vector<std::size_t> outside;
  for (std::size_t i = 1; i + 1 < arc.points.size(); ++i)
    if ((arc.points[i] - joint.centre).norm() >= joint.radius) outside.push_back(i);
  std::vector<double> widths, perimeters;
  const std::size_t count = std::min(kMost, outside.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = outside[(2 * k + 1) * outside.size() / (2 * count)];
    const auto [width, perimeter] = section_size(solid, arc.points[i], arc.points[i + 1] - arc.points[i - 1]);
    if (perimeter == 0) continue;
    widths.push_back(width);
    perimeters.push_back(perimeter);
  }
  return {value_at_rank(std::move(widths), 0.5), value_at_rank(std::move(perimeters), 0.5)};
}

inline LeafSignificance leaf_significance(const ArcGraph& graph, const SurfaceSnapshot& surface,
                                          const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                          const ArcBalls& balls, const ArcParts& parts,
                                          const std::vector<Index>& arcs_at_joint, Index a, Index joint) {
  LeafSignificance s;
  const Ball& hub = balls.hub[joint];
  const auto [own_width, own_perimeter] = arc_sections(graph.arcs[a], hub, solid);
  s.half_width = own_width;
  const ParentSlices parent(graph, surface, slices, parts, arcs_at_joint, a, joint,
                            2 * std::max(hub.radius, own_width));
  // A flat part fills its slices, not its balls.
  const double covered = std::max(hub.radius, parent.half_width);
  for (const Index v : parts.vertices[a]) {
    const Vector3& x = surface.position[v];
    double outside = (x - hub.centre).norm() - covered;
    for (std::size_t b = 0; b < balls.arc.size() && outside > s.depth; ++b)
      if (static_cast<Index>(b) != a && graph.arcs[b].alive)
        outside = std::min(outside, balls.arc[b].distance_outside(x, s.depth));
    s.depth = std::max(s.depth, outside);
  }
  if (own_perimeter > 0) s.msp_ratio = std::max(1.0, parent.perimeter / own_perimeter);
  return s;
}

// For each tip the leaf arc that stands for it, as a place in parts.leaves: the one that has most of its cap
// and at least a third; kNoLeaf if that stands for another tip of which it has more.
inline std::vector<std::size_t> leaves_of_tips(const ArcGraph& graph, const ArcParts& parts,
                                               const std::vector<LimbTip>& tips) {
  std::vector<std::size_t> leaf_of_vertex(graph.arc_of_vertex.size(), kNoLeaf);
  for (std::size_t i = 0; i < parts.leaves.size(); ++i)
    for (const Index v : parts.vertices[parts.leaves[i][0]]) leaf_of_vertex[v] = i;
  std::vector<std::size_t> leaf_of_tip(tips.size(), kNoLeaf), tip_of_leaf(parts.leaves.size(), kNoLeaf);
  std::vector<double> share_of_leaf(parts.leaves.size(), 1.0 / 3);
  std::vector<std::size_t> count(parts.leaves.size());
  for (std::size_t t = 0; t < tips.size(); ++t) {
    std::fill(count.begin(), count.end(), 0);
    for (const Index v : tips[t].cap)
      if (leaf_of_vertex[v] != kNoLeaf) ++count[leaf_of_vertex[v]];
    const auto most = std::max_element(count.begin(), count.end());
    if (most == count.end()) continue;
    const auto leaf = static_cast<std::size_t>(most - count.begin());
    const double share = static_cast<double>(*most) / static_cast<double>(tips[t].cap.size());
    if (share < share_of_leaf[leaf]) continue;
    if (tip_of_leaf[leaf] != kNoLeaf) leaf_of_tip[tip_of_leaf[leaf]] = kNoLeaf;
    tip_of_leaf[leaf] = t;
    leaf_of_tip[t] = leaf;
    share_of_leaf[leaf] = share;
  }
  return leaf_of_tip;
}

// Removes insignificant leaf arcs from a graph without through hubs, the weakest first.
class LeafPruner {
 public:
  LeafPruner(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
             const VertexSlices& slices, const std::vector<LimbTip>& tips, const PruningOptions& options,
             const Execution& execution)
      : graph_(graph),
        surface_(surface),
        solid_(solid),
        slices_(slices),
        options_(options),
        at_(graph.incidence()),
        parts_(graph, at_),
        score_(parts_.leaves.size()),
        has_tip_(parts_.leaves.size(), false),
        limbless_(static_cast<std::size_t>(surface.component_count), false),
        stale_(parts_.leaves.size(), false) {
    for (const LimbTip& tip : tips)
      if (tip.significance.depth == 0) limbless_[surface.component[tip.vertex]] = true;
    for (const std::size_t leaf : leaves_of_tips(graph, parts_, tips))
      if (leaf != kNoLeaf) has_tip_[leaf] = true;
    // Once the hairs are gone every leaf arc has its tip, and nothing is to be measured.
    if (std::all_of(has_tip_.begin(), has_tip_.end(), [](bool has) { return has; })) {
      std::fill(score_.begin(), score_.end(), 1.0);
      return;
    }
    balls_.emplace(graph, solid, execution);
    parallel_for(
        static_cast<Index>(score_.size()), "arcs", execution, [] { return 0; },
        [&](Index i, int) { score_[i] = score(static_cast<std::size_t>(i)); }, 1);
  }

  // An arc that lies near a removed one waits for the next sweep: two arcs in one limb cover each other, so
  // each looks insignificant, and only one may go. Arcs at the same joint are judged again at once, before
  // the joint dissolves: where a limb forks into the corners of its end, all prongs go.
  Index sweep() {
    Index removed = 0;
    while (true) {
      const std::size_t weakest = weakest_leaf();
      if (weakest == score_.size()) return removed;
      const auto [arc, joint] = parts_.leaves[weakest];
      remove_leaf_arc(graph_, arc, joint);
      at_[joint].erase(std::find(at_[joint].begin(), at_[joint].end(), arc));
      ++removed;
      for (std::size_t i = 0; i < score_.size(); ++i) {
        const auto [other, other_joint] = parts_.leaves[i];
        if (!graph_.arcs[other].alive) continue;
        if (other_joint == joint)
          score_[i] = score(i);
        else
          stale_[i] = stale_[i] || near(arc, other);
      }
    }
  }

 private:
  // Below 1: insignificant.
  double score(std::size_t i) const {
    if (has_tip_[i]) return 1.0;
    const auto [arc, joint] = parts_.leaves[i];
    // Where the surface has no limbs at all, as in a cup without a handle, any arc would do as well.
    const std::vector<Index>& vertices = parts_.vertices[arc];
    if (!vertices.empty() && limbless_[surface_.component[vertices.front()]]) return 0.0;
    const LeafSignificance s =
        leaf_significance(graph_, surface_, solid_, slices_, *balls_, parts_, at_[joint], arc, joint);
    return std::min(options_.significance > 0 ? s.value() / (kNoTipCaution * options_.significance) : 1.0,
                    options_.smallest > 0 ? s.depth / options_.smallest : 1.0);
  }

  std::size_t weakest_leaf() const {
    std::size_t best = score_.size();
    for (std::size_t i = 0; i < score_.size(); ++i) {
      const auto [arc, joint] = parts_.leaves[i];
      if (!graph_.arcs[arc].alive || stale_[i] || score_[i] >= 1.0 || at_[joint].size() < 2) continue;
      if (best == score_.size() || score_[i] < score_[best]) best = i;
    }
    return best;
  }

  bool near(Index a, Index b) const {
    for (const Ball& p : balls_->arc[a].balls())
      for (const Ball& q : balls_->arc[b].balls())
        if ((p.centre - q.centre).norm() < p.radius + q.radius) return true;
    return false;
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const VertexSlices& slices_;
  const PruningOptions& options_;
  std::vector<std::vector<Index>> at_;
  ArcParts parts_;
  std::optional<ArcBalls> balls_;
  std::vector<double> score_;
  std::vector<bool> has_tip_;
  std::vector<bool> limbless_;  // per component of the surface
  std::vector<bool> stale_;
};

}  // namespace detail

inline Index prune_branches(ArcGraph& graph, const SurfaceSnapshot& surface,
                            const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                            const std::vector<LimbTip>& tips, const PruningOptions& options,
                            const Execution& execution) {
  validate(options);
  Index removed = 0;
  while (true) {
    dissolve_through_hubs(graph);
    const Index swept = detail::LeafPruner(graph, surface, solid, slices, tips, options, execution).sweep();
    if (swept == 0) return removed;
    removed += swept;
  }
}

inline Index remove_spurs(ArcGraph& graph, const BoundingVolumeHierarchy& solid) {
  Index removed = 0;
  while (true) {
    dissolve_through_hubs(graph);
    const auto at = graph.incidence();
    Index spur = kNone, joint = kNone;
    for (Index a = 0; a < graph.arc_count() && spur == kNone; ++a) {
      if (!graph.arcs[a].alive) continue;
      for (const int end : {0, 1}) {
        const Index tip = graph.arcs[a].hub[end], hub = graph.arcs[a].hub[1 - end];
        if (at[tip].size() != 1 || at[hub].size() < 3) continue;
        const Vector3& centre = graph.hub_position[hub];
        if ((graph.hub_position[tip] - centre).norm() >= solid.distance(centre)) continue;
        spur = a;
        joint = hub;
      }
    }
    if (spur == kNone) return removed;
    remove_leaf_arc(graph, spur, joint);
    ++removed;
  }
}

}  // namespace mspskel
