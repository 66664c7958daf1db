// A part of a surface measured as a limb, and where it ends.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/value_at_rank.h"
#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/limb_end.h"
#include "mspskel/limbs/detail/part_level.h"
#include "mspskel/limbs/detail/part_shape.h"
#include "mspskel/limbs/detail/part_walk.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// The least depth of a limb from the middle of the shape, in smallest features.
inline constexpr double kLeastTipDepth = 1.5;

struct FoundLimb {
  LimbTip tip;
  std::vector<Index> part;         // its surface
  Vector3 root = Vector3::Zero();  // the middle of the ring where it leaves the rest
};

class LimbMeasurement {
 public:
  // Walks long ways only as the watch lets it, which throws Cancelled.
  LimbMeasurement(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                  const VertexSlices& slices, const LimbOptions& options, const std::vector<double>& distance,
                  Watch& watch)
      : surface_(surface),
        solid_(solid),
        slices_(slices),
        options_(options),
        distance_(distance),
        watch_(watch),
        walk_(surface, distance),
        end_(surface),
        flooded_(surface.position.size(), 0) {}

  // The part round a top beyond a level as a limb; nothing if it has no slices, or is the bow of a handle.
  std::optional<FoundLimb> run(Index top, double level, double own) {
    FoundLimb found;
    found.part = walk_.beyond(top, level);
    const std::vector<Index>& part = found.part;
    const std::vector<Index> round = walk_.ring(part);
    if (openings(round, part) > 1) return std::nullopt;
    for (const Index v : round) found.root += surface_.position[v] / static_cast<double>(round.size());
    LimbTip& tip = found.tip;
    tip.vertex = top;
    LimbMeasures& m = tip.measures;
    m.depth = distance_[top] - level;
    double sliced = 0, perimeter = 0;
    PartShapeSum sum(surface_, distance_, level);
    for (const Index v : part) {
      sum.add_vertex(v);
      if (!slices_.valid[v]) continue;
      sliced += surface_.vertex_area[v];
      perimeter += surface_.vertex_area[v] * slices_.perimeter[v];
    }
    if (!(perimeter > 0)) return std::nullopt;
    const std::vector<double> chords = half_chords(some_of(part));
    m.half_chord = value_at_rank(chords, 0.5);
    m.half_thickness = value_at_rank(chords, 0.25);
    const PartShape shape = sum.shape(distance_[top]);
    const PartLevel cut{m.depth, shape.area, shape.mouth};
    m.half_width = shape.area / (2 * kPi * m.depth);
    m.slenderness = cut.slenderness();
    m.mean_depth = shape.mean_depth / m.depth;
    m.depth_over_mouth = cut.depth_over_mouth();
    const double reach = std::max(2 * m.half_width, options_.smallest);
    const std::vector<Index> carrier = walk_.surface_beside(round, found.root, reach);
    const std::vector<Index> beside = some_of(carrier);
    const std::vector<double> carrier_chords = half_chords(beside);
    m.carrier_half_chord = mean_of_logarithms(beside, carrier_chords);
    m.carrier_half_thickness = value_at_rank(carrier_chords, 0.25);
    m.msp_ratio = std::max(1.0, mean_perimeter(carrier) * sliced / perimeter);
    // A spike that noise or a slit leaves on something thick is no twig, however thin it is. Beside a fold
    // most chords end in the fold, and some lead on into what is thick.
    if (!(m.depth > kLeastTipDepth * own_smallest(value_at_rank(carrier_chords, 0.75)))) return std::nullopt;
    if (!set_end(tip, own)) return std::nullopt;
    return found;
  }

  double smallest_feature(Index v) const {
    return slices_.valid[v] ? own_smallest(slices_.half_width[v]) : options_.smallest;
  }

  PartWalk& walk() { return walk_; }
  const PartWalk& walk() const { return walk_; }

 private:
  // Where the shape is narrower than the usual smallest feature, what is small is as much smaller.
  double own_smallest(double half_width) const {
    return options_.smallest * std::min(1.0, half_width / LimbOptions().smallest);
  }

  // The cap and the target, on what hangs together with the tip.
  bool set_end(LimbTip& tip, double own) {
    const LimbMeasures& m = tip.measures;
    const double end = std::min(0.5 * m.depth, kEnd * m.half_width);
    tip.cap = walk_.beyond(
        tip.vertex, std::max(own, distance_[tip.vertex] - std::min(0.5 * m.depth, kTipCap * m.half_width)));
    PartShapeSum sum(surface_, distance_, distance_[tip.vertex] - end);
    for (const Index v : tip.cap)
      if (distance_[tip.vertex] - distance_[v] <= end) sum.add_vertex(v);
    const PartShape shape = sum.shape(distance_[tip.vertex]);
    tip.target = shape.centre;
    if (!(shape.area > 0)) return false;
    set_straight_end(tip, end);
    return true;
  }

  // Round a bend the levels cut a limb aslant: of the head of a hammer, seen from its handle, the farthest is
  // an edge. Then the end is what lies farthest along the walls. A short limb has walls of other directions
  // about its root, and what leads off at more than 45 degrees is none of its own.
  void set_straight_end(LimbTip& tip, double end) {
    constexpr double kLeastSlenderness = 2, kLength = 3, kEndLength = 2, kStraight = 0.95, kAslant = 0.7;
    const LimbMeasures& m = tip.measures;
    if (m.slenderness < kLeastSlenderness) return;
    const auto near_tip = [&](double half_widths) {
      return walk_.beyond(tip.vertex, distance_[tip.vertex] - std::min(m.depth, half_widths * m.half_width));
    };
    const std::optional<WallDirection> walls = direction_of_walls(surface_, near_tip(kLength));
    if (!walls) return;
    const double along = walls->axis.dot((tip.target - walls->middle).normalized());
    if (std::abs(along) > kStraight || std::abs(along) < kAslant) return;
    const Vector3 outward = along < 0 ? Vector3(-walls->axis) : walls->axis;
    if (const std::optional<Vector3> middle = end_.middle(near_tip(kEndLength), outward, end))
      tip.target = *middle;
  }

  // How many ways lead out of a part through the ring round it. A dip in the part is none.
  int openings(const std::vector<Index>& round, const std::vector<Index>& part) {
    double area = 0;
    for (const Index v : part) area += surface_.vertex_area[v];
    const Index in_ring = ++last_flood_, in_loop = ++last_flood_;
    for (const Index v : round) flooded_[v] = in_ring;
    int count = 0;
    for (const Index first : round) {
      if (flooded_[first] != in_ring) continue;
      std::vector<Index> loop{first};
      flooded_[first] = in_loop;
      for (std::size_t i = 0; i < loop.size(); ++i)
        for_each_neighbour(surface_, loop[i], [&](Index w) {
          if (flooded_[w] != in_ring) return;
          flooded_[w] = in_loop;
          loop.push_back(w);
        });
      if (leads_out(std::move(loop), 0.5 * area)) ++count;
    }
    return count;
  }

  // Whether more than the given area lies behind a loop of the ring round a part that has just been walked.
  bool leads_out(std::vector<Index> loop, double least) {
    const Index flood = ++last_flood_;
    double area = 0;
    for (std::size_t i = 0; i < loop.size() && area <= least; ++i) {
      watch_.step();
      area += surface_.vertex_area[loop[i]];
      for_each_neighbour(surface_, loop[i], [&](Index w) {
        if (walk_.holds(w) || flooded_[w] == flood) return;
        flooded_[w] = flood;
        loop.push_back(w);
      });
    }
    return area > least;
  }

  // As many as tell their chords well enough.
  static std::vector<Index> some_of(const std::vector<Index>& vertices) {
    constexpr std::size_t kChords = 64;
    std::vector<Index> some;
    for (std::size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / kChords)
      some.push_back(vertices[i]);
    return some;
  }

  std::vector<double> half_chords(const std::vector<Index>& vertices) const {
    std::vector<double> chords;
    for (const Index v : vertices) chords.push_back(half_chord(surface_, solid_, v));
    return chords;
  }

  // Of positive values at the vertices, by their areas.
  double mean_of_logarithms(const std::vector<Index>& vertices, const std::vector<double>& values) const {
    double sum = 0, area = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (!(values[i] > 0)) continue;
      sum += surface_.vertex_area[vertices[i]] * std::log(values[i]);
      area += surface_.vertex_area[vertices[i]];
    }
    return area > 0 ? std::exp(sum / area) : 0.0;
  }

  double mean_perimeter(const std::vector<Index>& vertices) const {
    double sum = 0, area = 0;
    for (const Index v : vertices) {
      if (!slices_.valid[v]) continue;
      sum += surface_.vertex_area[v] * slices_.perimeter[v];
      area += surface_.vertex_area[v];
    }
    return area > 0 ? sum / area : 0.0;
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const VertexSlices& slices_;
  const LimbOptions& options_;
  const std::vector<double>& distance_;
  Watch& watch_;
  PartWalk walk_;
  EndAlong end_;
  std::vector<Index> flooded_;  // the last flood that came by
  Index last_flood_ = 0;
};

}  // namespace detail
}  // namespace mspskel
