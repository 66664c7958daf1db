// The limbs of a surface by the persistence of the inner distance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/limb_end.h"
#include "mspskel/limbs/detail/limb_head.h"
#include "mspskel/limbs/detail/limb_measurement.h"
#include "mspskel/limbs/detail/part_level.h"
#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

// The limbs and ears of a surface, each measured at the level at which it is most slender.
class LimbTipSearch {
 public:
  LimbTipSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                const VertexSlices& slices, const LimbOptions& options, const std::vector<double>& distance,
                const ProgressCallback& progress)
      : surface_(surface),
        solid_(solid),
        options_(options),
        distance_(distance),
        watch_(progress, "arcs"),
        half_area_(half_areas_of_components(surface)),
        measurement_(surface, solid, slices, options, distance, watch_) {}

  LimbTipSearch(const LimbTipSearch&) = delete;  // what it measures asks its own watch

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
    if (!(level.depth > kLeastTipDepth * measurement_.smallest_feature(v)) ||
        !(level.area > 1e-12 * level.depth))
      return;
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
    std::optional<FoundLimb> found = measurement_.run(top, level.distance, notes.own);
    if (found && is_flap(found->tip.measures) && notes.deepest > 0)
      found = measurement_.run(top, notes.deepest, notes.own);
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
            ends_alone ? find_head(surface_, solid_, distance_, measurement_.walk(), tip, found->part)
                       : std::nullopt) {
      if (carries_on(*head)) return false;
      tip.target = head->end;
      tip.cap = tip.head = head->part;
      tip.flat_end = head->neck;
    } else if (fork != nullptr) {
      end_before_fork(surface_, distance_, measurement_.walk(), fork->distance, tip);
    }
    limbs_.push_back(std::move(*found));
    return true;
  }

  // Whether a limb that was found before leaves a head where the limb that carries it would end.
  bool carries_on(const LimbHead& head) const {
    return std::any_of(limbs_.begin(), limbs_.end(), [&](const FoundLimb& limb) {
      if (!measurement_.walk().holds(limb.tip.vertex)) return false;
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
    std::array<std::optional<FoundLimb>, 2> lobes{measurement_.run(top, fork.distance, 0.0),
                                                  measurement_.run(fork.other, fork.distance, 0.0)};
    for (const auto& lobe : lobes)
      if (!lobe) return false;
    for (auto& lobe : lobes) limbs_.push_back(std::move(*lobe));
    return true;
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const LimbOptions& options_;
  const std::vector<double>& distance_;
  Watch watch_;
  std::vector<double> half_area_;  // of each component
  LimbMeasurement measurement_;
  std::vector<FoundLimb> limbs_;
};

}  // namespace detail
}  // namespace mspskel
