// The limbs of a surface by the persistence of the inner distance.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/value_at_rank.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/part_shape.h"
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
                const VertexSlices& slices, const LimbOptions& options, const std::vector<double>& distance)
      : surface_(surface),
        solid_(solid),
        slices_(slices),
        options_(options),
        distance_(distance),
        half_area_(static_cast<std::size_t>(surface.component_count), 0.0),
        walked_(surface.position.size(), 0),
        flooded_(surface.position.size(), 0) {
    for (Index v = 0; v < surface.vertex_count(); ++v)
      if (surface.vertex_halfedge[v] != kNone)
        half_area_[surface.component[v]] += 0.5 * surface.vertex_area[v];
  }

  std::vector<FoundLimb> run() {
    std::vector<Index> reached, place(surface_.position.size(), kNone);
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (std::isfinite(distance_[v])) reached.push_back(v);
    GrowingParts<Notes> parts(surface_, distance_, std::move(reached), place);
    parts.grow(
        [&](Part& high, Part& low, Index saddle) {
          judge_twig(high, distance_[saddle]);
          judge_twig(low, distance_[saddle]);
          if (finish(low)) high.notes.own = std::max(high.notes.own, distance_[saddle]);
          high.notes.area += low.notes.area;
          high.notes.vertices += low.notes.vertices;
          high.notes.euler += low.notes.euler;
        },
        [&](Part& part, Index v) { join(part, v); });
    parts.for_each_left([&](Part& part) { finish(part); });
    return std::move(limbs_);
  }

 private:
  struct Level {
    double slenderness = 0, distance = 0;
  };
  struct Notes {
    double area = 0;
    Index vertices = 0;
    Index euler = 0;   // its Euler characteristic: 1 while it is a disc
    Level slenderest;  // of all levels
    Level slenderest_disc;
    double own = 0;  // where it first met another limb
  };
  using Part = GrowingParts<Notes>::Part;

  // A limb is less than half of its component.
  void join(Part& part, Index v) {
    Notes& notes = part.notes;
    notes.area += surface_.vertex_area[v];
    ++notes.vertices;
    notes.euler += euler_change(v);
    if (notes.area > half_area_[surface_.component[v]]) return;
    const double depth = distance_[part.top] - distance_[v];
    const double slenderness = 2 * kPi * depth * depth / notes.area;
    if (!(depth > kLeastTipDepth * smallest_feature(v)) || slenderness * notes.vertices < kLeastEvidence)
      return;
    const Level level{slenderness, distance_[v]};
    if (slenderness > notes.slenderest.slenderness) notes.slenderest = level;
    if (notes.euler == 1 && slenderness > notes.slenderest_disc.slenderness) notes.slenderest_disc = level;
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

  // A part of so few triangles that its vertices tell no slenderness, with its triangles cut at the level
  // where it meets another. It has to stand out as a finger does, and as deep as two radii of its mouth: a
  // slice through the only vertex of a twig may lie along it and tells no width.
  void judge_twig(Part& part, double level) {
    constexpr double kDeep = 2;
    const double depth = distance_[part.top] - level;
    if (part.notes.slenderest.slenderness > 0 || part.notes.vertices >= kLeastEvidence ||
        !(depth > kLeastTipDepth * smallest_feature(part.top)))
      return;
    PartShapeSum sum(surface_, distance_, level);
    for (const Index v : part.vertices) sum.add_vertex(v);
    const PartShape shape = sum.shape(distance_[part.top]);
    const double slenderness = 2 * kPi * depth * depth / shape.area;
    if (!(slenderness >= kFinger * options_.slenderness) || 2 * kPi * depth < kDeep * shape.mouth) return;
    part.notes.slenderest = {slenderness, std::nextafter(level, distance_[part.top])};  // without the saddle
  }

  // Where the slices are narrower than the usual smallest feature, what is small is as much smaller.
  double smallest_feature(Index v) const {
    const double usual = LimbOptions().smallest;
    return slices_.valid[v] ? options_.smallest * std::min(1.0, slices_.half_width[v] / usual)
                            : options_.smallest;
  }

  // Whether the part holds a limb.
  bool finish(const Part& part) {
    const Notes& notes = part.notes;
    if (notes.slenderest.slenderness == 0) return notes.own > 0;
    std::optional<FoundLimb> found = measure(part.top, notes.slenderest.distance, notes.own);
    // The bow of a handle may hold a limb that ends before the handle begins; its bend is none, and blunt.
    if (!found && notes.slenderest_disc.slenderness > 0) {
      found = measure(part.top, notes.slenderest_disc.distance, notes.own);
      if (found && is_blunt(found->tip.measures.depth_over_mouth)) found.reset();
    }
    if (!found) return notes.own > 0;
    if (!is_limb(found->tip.measures, options_)) {
      if (!is_ear(found->tip.measures, options_)) return notes.own > 0;
      found->tip.kind = TipKind::kEar;
    }
    limbs_.push_back(std::move(*found));
    return true;
  }

  // The part round a top beyond a level as a limb; nothing if it has no slices, or is the bow of a handle.
  std::optional<FoundLimb> measure(Index top, double level, double own) {
    FoundLimb found;
    found.part = beyond(top, level);
    const std::vector<Index>& part = found.part;
    const std::vector<Index> round = ring(part);
    if (openings(round, part) > 1) return std::nullopt;
    for (const Index v : round) found.root += surface_.position[v] / static_cast<double>(round.size());
    LimbTip& tip = found.tip;
    tip.vertex = top;
    LimbMeasures& m = tip.measures;
    m.depth = distance_[top] - level;
    std::vector<double> widths;
    double whole = 0, sliced = 0, perimeter = 0;
    PartShapeSum sum(surface_, distance_, level);
    for (const Index v : part) {
      whole += surface_.vertex_area[v];
      sum.add_vertex(v);
      if (!slices_.valid[v]) continue;
      sliced += surface_.vertex_area[v];
      perimeter += surface_.vertex_area[v] * slices_.perimeter[v];
      widths.push_back(slices_.half_width[v]);
    }
    if (!(whole > 0 && perimeter > 0)) return std::nullopt;
    m.half_width = value_at_rank(std::move(widths), 0.5);
    m.half_chord = median_half_chord(part);
    m.slenderness = 2 * kPi * m.depth * m.depth / whole;
    const PartShape shape = sum.shape(distance_[top]);
    m.mean_depth = shape.mean_depth / m.depth;
    m.depth_over_mouth = 2 * kPi * m.depth / shape.mouth;
    const std::vector<Index> carrier = surface_beside(round, found.root, 2 * m.half_width);
    m.carrier_half_chord = median_half_chord(carrier);
    m.msp_ratio = std::max(1.0, mean_perimeter(carrier) * sliced / perimeter);
    if (!set_end(tip, own)) return std::nullopt;
    return found;
  }

  // The cap and the target, on what hangs together with the tip.
  bool set_end(LimbTip& tip, double own) {
    const LimbMeasures& m = tip.measures;
    const double end = std::min(0.5 * m.depth, kEnd * m.half_width);
    tip.cap = beyond(tip.vertex,
                     std::max(own, distance_[tip.vertex] - std::min(0.5 * m.depth, 1.5 * m.half_width)));
    double area = 0;
    for (const Index v : tip.cap) {
      if (distance_[tip.vertex] - distance_[v] > end) continue;
      tip.target += surface_.vertex_area[v] * surface_.position[v];
      area += surface_.vertex_area[v];
    }
    if (area > 0) tip.target /= area;
    return area > 0;
  }

  // The vertices beyond a level that hang together with a top; they are marked as walked.
  std::vector<Index> beyond(Index top, double level) {
    ++walk_;
    std::vector<Index> part{top};
    walked_[top] = walk_;
    for (std::size_t i = 0; i < part.size(); ++i)
      for_each_neighbour(surface_, part[i], [&](Index w) {
        if (walked_[w] == walk_ || distance_[w] < level) return;
        walked_[w] = walk_;
        part.push_back(w);
      });
    return part;
  }

  // The vertices next to a part that has just been walked.
  std::vector<Index> ring(const std::vector<Index>& part) {
    const Index inside = walk_++;
    std::vector<Index> round;
    for (const Index v : part)
      for_each_neighbour(surface_, v, [&](Index w) {
        if (walked_[w] == inside || walked_[w] == walk_) return;
        walked_[w] = walk_;
        round.push_back(w);
      });
    for (const Index v : part) walked_[v] = walk_;
    return round;
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
      area += surface_.vertex_area[loop[i]];
      for_each_neighbour(surface_, loop[i], [&](Index w) {
        if (walked_[w] == walk_ || flooded_[w] == flood) return;
        flooded_[w] = flood;
        loop.push_back(w);
      });
    }
    return area > least;
  }

  // The ring round a part that has just been walked, and the surface beyond it as far as `reach`.
  std::vector<Index> surface_beside(std::vector<Index> round, const Vector3& middle, double reach) {
    for (std::size_t i = 0; i < round.size(); ++i)
      for_each_neighbour(surface_, round[i], [&](Index w) {
        if (walked_[w] == walk_ || (surface_.position[w] - middle).squaredNorm() >= reach * reach) return;
        walked_[w] = walk_;
        round.push_back(w);
      });
    return round;
  }

  double median_half_chord(const std::vector<Index>& vertices) const {
    constexpr std::size_t kChords = 64;
    std::vector<double> chords;
    for (std::size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / kChords)
      chords.push_back(half_chord(surface_, solid_, vertices[i]));
    return value_at_rank(std::move(chords), 0.5);
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
  std::vector<double> half_area_;  // of each component
  std::vector<Index> walked_;      // the last walk that came by
  Index walk_ = 0;
  std::vector<Index> flooded_;  // the last flood that came by
  Index last_flood_ = 0;
  std::vector<FoundLimb> limbs_;
};

}  // namespace detail
}  // namespace mspskel
