// The limbs of a surface by the persistence of the inner distance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/value_at_rank.h"
#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/limb_end.h"
#include "mspskel/limbs/detail/limb_head.h"
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

// The limbs and ears of a surface, each measured at the level at which it is most slender.
class LimbTipSearch {
 public:
  LimbTipSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                const VertexSlices& slices, const LimbOptions& options, const std::vector<double>& distance,
                const ProgressCallback& progress)
      : surface_(surface),
        solid_(solid),
        slices_(slices),
        options_(options),
        distance_(distance),
        watch_(progress, "arcs"),
        half_area_(half_areas_of_components(surface)),
        walk_(surface, distance),
        end_(surface),
        flooded_(surface.position.size(), 0) {}

  // Throws Cancelled.
  std::vector<FoundLimb> run() {
    std::vector<Index> reached, place(surface_.position.size(), kNone);
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (std::isfinite(distance_[v])) reached.push_back(v);
    GrowingParts<Notes> parts(surface_, distance_, std::move(reached), place);
    parts.grow(
        [&](Part& high, Part& low, Index saddle) {
          watch_.ask();
          judge_before(high, saddle);
          judge_before(low, saddle);
          if (finish(low))
            meet_limb(high.notes, distance_[saddle]);
          else if (are_lobes(high, low, saddle))
            high.notes.forks.push_back({distance_[saddle], low.top, are_knobs(high, low, saddle)});
          high.notes.sum.add(low.notes.sum);
          high.notes.vertices += low.notes.vertices;
          high.notes.euler += low.notes.euler;
        },
        [&](Part& part, Index v) {
          watch_.step();
          join(part, v);
        });
    parts.for_each_left([&](Part& part) {
      watch_.ask();
      finish(part);
    });
    return std::move(limbs_);
  }

 private:
  struct Level {
    double slenderness = 0, distance = 0;
  };
  // Where two lobes that are alike met, neither of them a limb.
  struct Fork {
    double distance;
    Index other;  // the top of the lower one
    bool knobs;   // or corners, which are flatter
  };
  struct Notes {
    LevelSum sum;
    Index vertices = 0;
    Index euler = 0;   // its Euler characteristic: 1 while it is a disc
    Level slenderest;  // of all levels
    Level slenderest_disc;
    double deepest = 0;  // the last level at which it is as slender as a limb; 0 if there is none
    double own = 0;      // where it first met another limb
    Level neck;          // where it leaves what carries it, which would be a part of the same limb farther in
    bool is_limb_alone = false;  // before it met that
    std::vector<Fork> forks;
  };
  using Part = GrowingParts<Notes>::Part;

  void join(Part& part, Index v) {
    Notes& notes = part.notes;
    notes.sum.add(change_at(surface_, distance_, v));
    ++notes.vertices;
    notes.euler += euler_change(v);
    judge(part, v, distance_[v]);
  }

  // Before it meets another one a part is judged without the saddle, and a twig of few triangles at last.
  void judge_before(Part& part, Index saddle) {
    const double level = std::nextafter(distance_[saddle], distance_[part.top]);
    judge(part, saddle, level);
    if (part.notes.slenderest.slenderness == 0) judge(part, saddle, level, true);
  }

  // A limb is less than half of its component. What few triangles tell, a twig, has to stand out as a finger
  // does, and as deep as two radii of its mouth: a slice through its only vertex may lie along it and tells
  // no width.
  void judge(Part& part, Index v, double at, bool twig = false) {
    Notes& notes = part.notes;
    const PartLevel level = notes.sum.at(at, distance_[part.top]);
    if (level.area > half_area_[surface_.component[v]]) return;
    if (!(level.depth > kLeastTipDepth * smallest_feature(v)) || !(level.area > 1e-12 * level.depth)) return;
    const double slenderness = level.slenderness();
    const bool tells = twig ? slenderness >= kFinger * options_.slenderness && is_twig(level)
                            : slenderness * notes.vertices >= kLeastEvidence;
    if (!tells) return;
    // A stub at the end of a pipe: the limb that ends with the pipe as well is slender again.
    constexpr double kWidens = 0.5;
    if (notes.slenderest.slenderness >= options_.slenderness &&
        slenderness < kWidens * notes.slenderest.slenderness && notes.neck.slenderness == 0 && notes.own == 0)
      notes.neck = notes.slenderest;
    if (slenderness > notes.slenderest.slenderness) notes.slenderest = {slenderness, at};
    if (slenderness >= options_.slenderness && level.depth > kLeastTipDepth * options_.smallest)
      notes.deepest = at;
    if (notes.euler == 1 && slenderness > notes.slenderest_disc.slenderness)
      notes.slenderest_disc = {slenderness, at};
  }

  void meet_limb(Notes& notes, double at) const {
    if (notes.own == 0)
      notes.is_limb_alone = notes.slenderest.slenderness >= kSlenderEar * options_.slenderness;
    notes.own = std::max(notes.own, at);
  }

  // Whether two parts that meet are as deep and as large as each other.
  bool are_lobes(const Part& high, const Part& low, Index saddle) const {
    const double level = distance_[saddle];
    const PartLevel a = high.notes.sum.at(level, distance_[high.top]);
    const PartLevel b = low.notes.sum.at(level, distance_[low.top]);
    return high.notes.own == 0 && low.notes.own == 0 && about_equal(a.depth, b.depth) &&
           about_equal(std::sqrt(std::max(a.area, 0.0)), std::sqrt(std::max(b.area, 0.0)));
  }

  // As the middle of the shape sees them, corners and pieces of rims bulge about half as much as a flat disc.
  bool are_knobs(const Part& high, const Part& low, Index saddle) const {
    constexpr double kKnob = 0.85;
    const auto is_knob = [&](const Part& part) {
      return part.notes.sum.at(distance_[saddle], distance_[part.top]).bulge() >= kKnob;
    };
    return is_knob(high) && is_knob(low);
  }

  // What the vertex adds to the Euler characteristic of the vertices beyond it: itself, the edges to them,
  // and the triangles with two of them.
  Index euler_change(Index v) const {
    const auto beyond = [&](Index w) {
      return distance_[w] != distance_[v] ? distance_[w] > distance_[v] : w < v;
    };
    Index change = 1;
    const Index first = surface_.vertex_halfedge[v];
    Index h = first;
    do {
      if (beyond(surface_.target(h))) change += beyond(surface_.apex(h)) ? 0 : -1;
      h = surface_.next_outgoing(h);
    } while (h != first);
    return change;
  }

  // Where the shape is narrower than the usual smallest feature, what is small is as much smaller.
  double own_smallest(double half_width) const {
    return options_.smallest * std::min(1.0, half_width / LimbOptions().smallest);
  }
  double smallest_feature(Index v) const {
    return slices_.valid[v] ? own_smallest(slices_.half_width[v]) : options_.smallest;
  }

  // Whether the part holds a limb. The bow of a handle may hold one that ends before the handle begins; its
  // bend is none.
  bool finish(const Part& part) {
    const Notes& notes = part.notes;
    return add_limb(part.top, notes.neck, notes) || add_limb(part.top, notes.slenderest, notes) ||
           add_limb(part.top, notes.slenderest_disc, notes) || notes.own > 0;
  }

  // Whether the part beyond a level is a limb or an ear, which is noted then. A tip as sharp as a knife is a
  // flap: what more there is of the part tells.
  bool add_limb(Index top, const Level& level, const Notes& notes) {
    if (level.slenderness == 0) return false;
    std::optional<FoundLimb> found = measure(top, level.distance, notes.own);
    if (found && is_flap(found->tip.measures) && notes.deepest > 0)
      found = measure(top, notes.deepest, notes.own);
    if (!found) return false;
    if (!is_limb(found->tip.measures, options_)) {
      if (!is_ear(found->tip.measures, options_)) return false;
      found->tip.kind = TipKind::kEar;
    }
    LimbTip& tip = found->tip;
    const Fork* const fork = last_fork(tip, level.distance, notes.forks);
    if (fork != nullptr && fork->knobs && add_lobes(*fork, tip.vertex)) return true;
    const bool ends_alone = notes.own == 0 || !notes.is_limb_alone;
    if (const std::optional<LimbHead> head =
            ends_alone ? find_head(surface_, solid_, distance_, walk_, tip, found->part) : std::nullopt) {
      if (carries_on(*head)) return false;
      tip.target = head->end;
      tip.cap = tip.head = head->part;
      tip.flat_end = head->neck;
    } else if (fork != nullptr) {
      end_before_fork(surface_, distance_, walk_, fork->distance, tip);
    }
    limbs_.push_back(std::move(*found));
    return true;
  }

  // The part round a top beyond a level as a limb; nothing if it has no slices, or is the bow of a handle.
  std::optional<FoundLimb> measure(Index top, double level, double own) {
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
    // A spike that noise or a slit leaves on something thick is no twig, however thin it is.
    if (!(m.depth > kLeastTipDepth * own_smallest(m.carrier_half_chord))) return std::nullopt;
    if (!set_end(tip, own)) return std::nullopt;
    return found;
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

  // Whether a limb that was found before leaves a head where the limb that carries it would end.
  bool carries_on(const LimbHead& head) const {
    return std::any_of(limbs_.begin(), limbs_.end(), [&](const FoundLimb& limb) {
      if (!walk_.holds(limb.tip.vertex)) return false;
      const Vector3 from_middle = limb.root - head.middle;
      return from_middle.dot(head.along) > 0 &&
             from_middle.cross(head.along).norm() <= limb.tip.measures.half_width;
    });
  }

  // The deepest fork of a limb's end, if it has one that is no dent.
  const Fork* last_fork(const LimbTip& tip, double level, const std::vector<Fork>& forks) const {
    constexpr double kDeepest = 2, kDent = 0.25;  // half widths
    const double width = tip.measures.half_width;
    const Fork* last = nullptr;
    for (const Fork& fork : forks) {
      const double depth = distance_[tip.vertex] - fork.distance;
      const double least = (fork.knobs ? kDent : kEnd) * width;
      if (fork.distance > level + kEnd * width && depth > least && depth <= kDeepest * width) last = &fork;
    }
    return last;
  }

  // Both lobes of a limb's end as limbs; neither, if one of them is none.
  bool add_lobes(const Fork& fork, Index top) {
    std::array<std::optional<FoundLimb>, 2> lobes{measure(top, fork.distance, 0.0),
                                                  measure(fork.other, fork.distance, 0.0)};
    for (const auto& lobe : lobes)
      if (!lobe) return false;
    for (auto& lobe : lobes) limbs_.push_back(std::move(*lobe));
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
  Watch watch_;
  std::vector<double> half_area_;  // of each component
  PartWalk walk_;
  EndAlong end_;
  std::vector<Index> flooded_;  // the last flood that came by
  Index last_flood_ = 0;
  std::vector<FoundLimb> limbs_;
};

}  // namespace detail
}  // namespace mspskel
