// The surface beyond the balls of arcs, and the parts of it that protrude.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/progress.h"
#include "mspskel/base/value_at_rank.h"
#include "mspskel/limbs/detail/end_target.h"
#include "mspskel/limbs/detail/part_walk.h"
#include "mspskel/limbs/detail/slender_parts.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/solid/detail/ball_chain.h"
#include "mspskel/solid/detail/ball_tree.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// What no ball comes near and protrudes less is none, in smallest features.
inline constexpr double kLeastProtrusion = 3.5;
// Of the corners of slabs: levels bend round the balls of arcs.
inline constexpr double kSlabSlack = 1.2;

class UncoveredSurface {
 public:
  // Beyond the given balls; vertices that belong to nothing of the graph count as covered.
  // Cost: O(vertices · log balls).
  UncoveredSurface(const ArcGraph& graph, const SurfaceSnapshot& surface, std::vector<Ball> balls,
                   const Execution& execution)
      : surface_(surface),
        distance_(surface.position.size(), 0.0),
        carrier_(distance_),
        walk_(surface, distance_) {
    const BallTree tree(std::move(balls));
    parallel_for(
        surface_.vertex_count(), "arcs", execution, [] { return 0; },
        [&](Index v, int) {
          if (graph.arc_of_vertex[v] == kNone && graph.hub_of_vertex[v] == kNone) return;
          const BallTree::Nearest nearest = tree.nearest(surface_.position[v]);
          distance_[v] = nearest.distance;
          carrier_[v] = nearest.radius;
        });
  }

  UncoveredSurface(const UncoveredSurface&) = delete;  // its walks go by its own distances

  // How far a vertex is beyond all balls, at most 0 where done with.
  double distance(Index v) const { return distance_[v]; }
  const std::vector<double>& distances() const { return distance_; }
  // The radius of the ball that it is least beyond.
  double carrier(Index v) const { return carrier_[v]; }

  // The parts that reach `least` beyond the balls, or as far as a thin ball is wide: on something thin a twig
  // is told by its own scale, which is that of what carries it. With `few` those of few vertices, too.
  std::vector<SlenderPart> parts(double least, bool few) const {
    std::vector<Index> beyond;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (distance_[v] > 0) beyond.push_back(v);
    const double usual = kLeastProtrusion * LimbOptions().smallest;
    const auto least_depth = [&](Index v) { return least * std::min(1.0, 2 * carrier_[v] / usual); };
    return slender_parts(surface_, distance_, std::move(beyond), least_depth, LargestPart::kHalf, few);
  }

  // A part as a limb. Its cap and target are as those of limbs, on what hangs together with the top.
  LimbTip limb(Index top, const PartLevel& level, const BoundingVolumeHierarchy& solid) {
    LimbTip tip;
    tip.vertex = top;
    tip.position = surface_.position[top];
    tip.measures.depth = level.depth;
    tip.measures.slenderness = level.slenderness();
    const double radius = level.depth / level.slenderness();
    tip.measures.half_width = radius;
    const double cap = std::min(0.5 * level.depth, kTipCap * radius), end = std::min(cap, kEnd * radius);
    PartShapeSum sum(surface_, distance_, distance_[top] - end);
    tip.cap = walk_.beyond(top, distance_[top] - cap);
    for (const Index v : tip.cap)
      if (distance_[top] - distance_[v] <= end) sum.add_vertex(v);
    tip.target = sum.shape(distance_[top]).centre;
    keep_target_well_inside(tip, solid);
    return tip;
  }

  // How thick the solid is beside the part beyond a level: the median chord inward from the ring round it.
  double thickness_beside(Index top, const PartLevel& level, const BoundingVolumeHierarchy& solid) {
    std::vector<double> chords;
    for (const Index v : walk_.ring(walk_.beyond(top, distance_[top] - level.depth)))
      chords.push_back(chord(v, solid));
    return value_at_rank(std::move(chords), 0.5);
  }

  // Takes more balls in, and calls nearer(v) for what they cover better.
  template <class Nearer>
  void cover(const BallChain& balls, Nearer nearer) {
    for (Index v = 0; v < surface_.vertex_count(); ++v) {
      const double before = distance_[v];
      balls.find_nearest(surface_.position[v], distance_[v], carrier_[v]);
      if (before > 0 && distance_[v] < before) nearer(v);
    }
  }

  // What lies round a vertex whose arc would be insignificant is not tried again.
  void dismiss(Index v) {
    const double reach = distance_[v];
    for (Index w = 0; w < surface_.vertex_count(); ++w)
      if ((surface_.position[w] - surface_.position[v]).norm() <= reach) distance_[w] = 0;
  }

 private:
  // The same are asked for in every round of completion.
  double chord(Index v, const BoundingVolumeHierarchy& solid) {
    if (chord_.empty()) chord_.assign(surface_.position.size(), -1.0);
    if (chord_[v] < 0) chord_[v] = 2 * half_chord(surface_, solid, v);
    return chord_[v];
  }

  const SurfaceSnapshot& surface_;
  std::vector<double> distance_, carrier_;  // per vertex
  std::vector<double> chord_;               // inward, per vertex; negative where it was not asked for
  PartWalk walk_;
};

}  // namespace detail
}  // namespace mspskel
