#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/base/linkage.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/part_level.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/inner_distance.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// Where a leaf arc may spread into digits.
struct Palm {
  Vector3 centre = Vector3::Zero();
  Vector3 onward = Vector3::Zero();  // unit vector, towards the tip
  double radius = 0.0;               // of the ball
  double reach = 0.0;                // along the arc to its tip
};

// Where the palm lies before the tip, in smallest features.
constexpr double kNearestPalm = 4.0, kFarthestPalm = 12.0;

// Such a way to the tip of a leaf arc, of the given length or longer where the graph has as much. Beyond a
// joint it is that of the arc that leads there most straightly: whether other digits have arcs already is
// nothing to the palm.
class WayToTip {
 public:
  WayToTip(const ArcGraph& graph, const BoundingVolumeHierarchy& solid)
      : graph_(graph), solid_(solid), at_(graph.incidence()) {}

  std::vector<Vector3> operator()(const LeafArc& leaf, double length) const {
    std::vector<Vector3> way = leaf_points(graph_, leaf);
    std::reverse(way.begin(), way.end());  // from the tip
    double walked = length_of(way);
    std::vector<Index> arcs{leaf.arc};
    for (Index hub = leaf.joint; walked < length;) {
      const Index arc = straight_on(way, hub, arcs);
      if (arc == kNone) break;
      arcs.push_back(arc);
      const std::vector<Vector3> next = from_hub(arc, hub);
      walked += length_of(next);
      way.insert(way.end(), next.begin() + 1, next.end());
      hub = graph_.arcs[arc].hub[graph_.arcs[arc].hub[0] == hub ? 1 : 0];
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

 private:
  std::vector<Vector3> from_hub(Index arc, Index hub) const {
    return points_from(graph_.arcs[arc], graph_.arcs[arc].hub[0] == hub ? 0 : 1);
  }

  // The arc at a hub that goes on where a way to it leads, by the directions over the joint's ball; kNone
  // where the way has come by all of them.
  Index straight_on(const std::vector<Vector3>& way, Index hub, const std::vector<Index>& taken) const {
    const Vector3& joint = graph_.hub_position[hub];
    const double radius = solid_.distance(joint);
    const Vector3 along = joint - point_before_end(way, radius);
    Index best = kNone;
    double straightest = 0;
    for (const Index arc : at_[hub]) {
      if (std::find(taken.begin(), taken.end(), arc) != taken.end()) continue;
      std::vector<Vector3> next = from_hub(arc, hub);
      std::reverse(next.begin(), next.end());
      const double straight = along.dot((point_before_end(next, radius) - joint).normalized());
      if (best != kNone && straight <= straightest) continue;
      best = arc;
      straightest = straight;
    }
    return best;
  }

  const ArcGraph& graph_;
  const BoundingVolumeHierarchy& solid_;
  const std::vector<std::vector<Index>> at_;
};

// On the points of a way to a tip; nothing on short ones.
inline std::optional<Palm> find_palm(const std::vector<Vector3>& points, const BoundingVolumeHierarchy& solid,
                                     const LimbOptions& options) {
  Palm palm;
  std::size_t at = 0;
  double walked = 0;
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    walked += (points[i] - points[i - 1]).norm();
    if (walked > kFarthestPalm * options.smallest) break;
    if (walked < kNearestPalm * options.smallest) continue;
    const double radius = solid.distance(points[i - 1]);
    if (radius <= palm.radius) continue;
    palm.centre = points[i - 1];
    palm.radius = radius;
    palm.reach = walked;
    at = i - 1;
  }
  if (palm.radius == 0) return std::nullopt;
  std::size_t ahead = at + 1;
  while (ahead + 1 < points.size() && (points[ahead] - palm.centre).norm() < palm.radius) ++ahead;
  palm.onward = (points[ahead] - palm.centre).normalized();
  return palm;
}

class DigitSearch {
 public:
  DigitSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
              const LimbOptions& options)
      : surface_(surface),
        solid_(solid),
        options_(options),
        distance_(surface.position.size(), kElsewhere),
        taken_(surface.position.size(), 0),
        place_(surface.position.size(), kNone) {}

  // The digits on the surface beyond the palm, as far as it hangs together with the vertex `tip`; none if
  // they are fewer than three.
  std::vector<Digit> run(const Palm& palm, Index tip) {
    digits_.clear();
    const std::vector<Index> region = surface_beyond(palm, tip);
    // By straight ways first, which cost no queries: most palms have nothing like digits.
    if (find(region, 0.5)) {
      inner_distances(surface_, solid_, palm.centre, region, distance_);
      if (find(region, 1.0))
        for (Digit& digit : digits_) set_way(digit);
    }
    for (const Index v : region) distance_[v] = kElsewhere;
    digits_.erase(
        std::remove_if(digits_.begin(), digits_.end(), [](const Digit& digit) { return digit.way.empty(); }),
        digits_.end());
    return std::move(digits_);
  }

 private:
  static constexpr double kElsewhere = -std::numeric_limits<double>::infinity();

  struct Notes {
    LevelSum sum;
    bool ended = false;    // has met a digit, or come to where the region ends
    PartLevel slenderest;  // before that, of those at which it is a digit; else of no depth
  };
  using Part = GrowingParts<Notes>::Part;

  // With the straight ways for distances. The plane lies behind the palm's middle for the sake of thumbs.
  std::vector<Index> surface_beyond(const Palm& palm, Index tip) {
    constexpr double kBehind = 0.5;  // radii
    const double reach = 1.2 * std::max(palm.reach, 8 * options_.smallest) + 2 * palm.radius;
    std::vector<Index> region;
    const auto add = [&](Index v) {
      if (distance_[v] != kElsewhere) return;
      const Vector3 x = surface_.position[v] - palm.centre;
      const double straight = x.norm();
      if (straight > reach || x.dot(palm.onward) < -kBehind * palm.radius) return;
      distance_[v] = straight;
      region.push_back(v);
    };
    add(tip);
    for (std::size_t i = 0; i < region.size(); ++i) for_each_neighbour(surface_, region[i], add);
    return region;
  }

  // Whether there are three digits or more, of so much of the length and the slenderness that is asked.
  bool find(const std::vector<Index>& region, double share) {
    constexpr std::size_t kFewest = 3;
    LimbOptions least = options_;
    least.slenderness *= share;
    least.smallest *= share;
    digits_.clear();
    GrowingParts<Notes> parts(surface_, distance_, region, place_);
    parts.grow(
        [&](Part& high, Part& low, Index saddle) {
          const double level = std::nextafter(distance_[saddle], distance_[high.top]);
          judge(high, level, least);
          judge(low, level, least);
          high.notes.ended = add_if_digit(low) || low.notes.ended || high.notes.ended;
          if (!high.notes.ended) high.notes.sum.add(low.notes.sum);
        },
        [&](Part& part, Index v) { join(part, v, least); });
    parts.for_each_left([&](Part& part) { add_if_digit(part); });
    for (const Index v : region) taken_[v] = 0;
    return digits_.size() >= kFewest;
  }

  void join(Part& part, Index v, const LimbOptions& least) {
    Notes& notes = part.notes;
    for_each_neighbour(surface_, v,
                       [&](Index w) { notes.ended = notes.ended || distance_[w] == kElsewhere; });
    if (notes.ended) return;
    notes.sum.add(change_at(surface_, distance_, v));
    judge(part, distance_[v], least);
  }

  void judge(Part& part, double at, const LimbOptions& least) const {
    Notes& notes = part.notes;
    if (notes.ended) return;
    const PartLevel level = notes.sum.at(at, distance_[part.top]);
    if (!(level.area > 1e-12 * level.depth)) return;
    const double slenderness = level.slenderness();
    const bool more = notes.slenderest.depth == 0 || slenderness > notes.slenderest.slenderness();
    if (more && is_digit(level.depth, slenderness, least)) notes.slenderest = level;
  }

  bool add_if_digit(const Part& part) {
    const PartLevel& level = part.notes.slenderest;
    // Where vertices lie in one place, its top may be another's already.
    if (!(level.depth > 0) || taken_[part.top]) return false;
    Digit digit;
    digit.tip = surface_.position[part.top];
    digit.length = level.depth;
    digit.radius = level.depth / level.slenderness();
    const double base = distance_[part.top] - digit.length;
    const auto add = [&](Index v) {
      if (taken_[v] || distance_[v] < base) return;
      taken_[v] = 1;
      digit.vertices.push_back(v);
    };
    add(part.top);
    for (std::size_t i = 0; i < digit.vertices.size(); ++i)
      for_each_neighbour(surface_, digit.vertices[i], add);
    digits_.push_back(std::move(digit));
    return true;
  }

  // Means of the middles of chords whose vertices are about as far away. Means of the surface itself lie
  // outside where few vertices surround a bent digit unevenly.
  void set_way(Digit& digit) const {
    constexpr std::size_t kChords = 256;  // more tell no more
    const double end = std::min(0.5 * digit.length, kEnd * digit.radius);
    const double bands = std::clamp(std::floor((digit.length - end) / digit.radius), 1.0, 16.0);
    const double base = distance_[digit.vertices.front()] - digit.length;
    std::vector<Vector3> sum(static_cast<std::size_t>(bands) + 1, Vector3::Zero());
    std::vector<double> area(sum.size(), 0.0);
    for (std::size_t i = 0; i < digit.vertices.size(); i += 1 + digit.vertices.size() / kChords) {
      const Index v = digit.vertices[i];
      const auto chord = inward_chord(surface_, solid_, v);
      if (!chord) continue;
      const double share = std::clamp((distance_[v] - base) / (digit.length - end), 0.0, 1.0);
      const auto band = static_cast<std::size_t>(share * bands);
      // A chord at the base may lead into what carries the digit.
      const double half = std::min(0.5 * chord->length, digit.radius);
      sum[band] += surface_.vertex_area[v] * (chord->start - half * surface_.normal[v]);
      area[band] += surface_.vertex_area[v];
    }
    for (std::size_t k = 0; k < sum.size(); ++k)
      if (area[k] > 0 && solid_.inside(sum[k] / area[k])) digit.way.push_back(sum[k] / area[k]);
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const LimbOptions& options_;
  std::vector<double> distance_;     // from the palm; kElsewhere but for the region
  std::vector<std::uint8_t> taken_;  // by a digit
  std::vector<Index> place_;         // scratch memory of GrowingParts
  std::vector<Digit> digits_;
};

// Palms of neighbouring limbs may share digits.
inline std::vector<Digit> without_shared(const std::vector<std::vector<Digit>>& of_palms,
                                         const SurfaceSnapshot& surface) {
  std::vector<Digit> found;
  for (const std::vector<Digit>& digits : of_palms) found.insert(found.end(), digits.begin(), digits.end());
  std::stable_sort(found.begin(), found.end(),
                   [](const Digit& a, const Digit& b) { return a.length > b.length; });
  std::vector<Digit> digits;
  std::vector<bool> taken(surface.position.size(), false);
  for (Digit& digit : found) {
    if (std::any_of(digit.vertices.begin(), digit.vertices.end(), [&](Index v) { return taken[v]; }))
      continue;
    for (const Index v : digit.vertices) taken[v] = true;
    digits.push_back(std::move(digit));
  }
  return digits;
}

}  // namespace detail

MSPSKEL_INLINE std::vector<Digit> find_digits(const ArcGraph& graph, const SurfaceSnapshot& surface,
                                              const BoundingVolumeHierarchy& solid,
                                              const LimbOptions& options, const Execution& execution) {
  const std::vector<detail::LeafArc> leaves = detail::ArcLeaves(graph, graph.incidence()).leaf;
  const detail::WayToTip way_to_tip(graph, solid);
  std::vector<std::vector<Digit>> found(leaves.size());
  parallel_for(
      static_cast<Index>(leaves.size()), "digits", execution,
      [&] { return detail::DigitSearch(surface, solid, options); },
      [&](Index i, detail::DigitSearch& search) {
        const auto palm = detail::find_palm(way_to_tip(leaves[i], detail::kFarthestPalm * options.smallest),
                                            solid, options);
        if (!palm) return;
        const Index face = solid.closest(graph.hub_position[leaves[i].tip]).face;
        if (face == kNone || face >= surface.face_count()) return;  // it ends at the wall of a cavity
        found[i] = search.run(*palm, surface.origin[3 * face]);
      },
      1);
  return detail::without_shared(found, surface);
}

}  // namespace mspskel
