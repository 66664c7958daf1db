// Parts of a surface that protrude by some distance, each at the level at which it is most slender.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/part_level.h"
#include "mspskel/limbs/detail/part_shape.h"
#include "mspskel/limbs/limb_measures.h"

namespace mspskel {
namespace detail {

// A bump that is no wider than what carries it, as a fin, a nose or a boss: deep for its mouth and bulging
// from it by a quarter more than the corner of a block, which has 1.05, the mouth no longer than the rim of a
// square as wide as the ball that carries it. The foot of a goblet or the top of a mushroom widens beyond its
// mouth: it has a rim, and no end.
inline bool is_bump(const PartLevel& level, double carrier_rim, const LimbOptions& options) {
  constexpr double kSquare = 4 / kPi;  // over the rim of a ball of that width
  return level.depth_over_mouth() >= 0.64 * options.slenderness && level.bulge() >= 1.3 &&
         level.slenderness() >= std::min(0.6 * options.slenderness, 0.5 * level.depth_over_mouth()) &&
         level.mouth <= kSquare * carrier_rim;
}

// A part at the levels at which it is most so.
struct SlenderPart {
  Index top;             // where it reaches farthest
  PartLevel slenderest;  // for its area; of no depth where it never is of enough vertices to tell
  PartLevel narrowest;   // for its mouth; the same where it never is less than half of its component
  // The same of the levels at which it has few vertices, where no other evidence is asked for; if asked for.
  PartLevel slenderest_of_few, narrowest_of_few;
};

// How much of its component a part may be: of two sides of a level the smaller one is the limb. Where it is
// known which side stands for the body, the other may be most of the component.
enum class LargestPart { kHalf, kAny };

// The parts of the given vertices that grow from the maxima of the distance until a farther one takes them,
// as they are where they are deeper than least_depth(vertex); with `few` also at the levels of few vertices.
// In no particular order.
template <class LeastDepth>
std::vector<SlenderPart> slender_parts(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                       std::vector<Index> vertices, LeastDepth least_depth,
                                       LargestPart largest = LargestPart::kHalf, bool few = false) {
  struct Notes {
    LevelSum sum;
    Index vertices = 0;
    PartLevel slenderest, narrowest, slenderest_of_few, narrowest_of_few;
  };
  using Parts = GrowingParts<Notes>;
  const std::vector<double> half_area = half_areas_of_components(surface);
  const auto too_large = [&](const PartLevel& level, Index v) {
    return largest == LargestPart::kHalf && level.area > half_area[surface.component[v]];
  };
  std::vector<Index> place(surface.position.size(), kNone);
  Parts parts(surface, distance, std::move(vertices), place);
  std::vector<SlenderPart> found;
  const auto finish = [&](const typename Parts::Part& part) {
    const Notes& n = part.notes;
    if (n.slenderest.depth > 0 || n.narrowest.depth > 0 || n.slenderest_of_few.depth > 0)
      found.push_back({part.top, n.slenderest, n.narrowest, n.slenderest_of_few, n.narrowest_of_few});
  };
  const auto measure_few = [&](typename Parts::Part& part, Index v) {
    Notes& notes = part.notes;
    if (!few || notes.vertices >= kLeastEvidence) return;
    PartLevel level = notes.sum.at(distance[v], distance[part.top]);
    if (!(level.depth > least_depth(part.top)) || !(level.area > 1e-12 * level.depth) || !(level.mouth > 0) ||
        too_large(level, v))
      return;
    PartLevel &slenderest = notes.slenderest_of_few, &narrowest = notes.narrowest_of_few;
    const bool is_slenderest = slenderest.depth == 0 || level.slenderness() > slenderest.slenderness();
    const bool is_narrowest = narrowest.depth == 0 || level.depth_over_mouth() > narrowest.depth_over_mouth();
    if (!is_slenderest && !is_narrowest) return;
    PartShapeSum shape(surface, distance, distance[v]);
    for (const Index w : part.vertices) shape.add_vertex(w);
    level.span = shape.shape(distance[part.top]).span;
    if (is_slenderest) slenderest = level;
    if (is_narrowest) narrowest = level;
  };
  parts.grow(
      [&](typename Parts::Part& high, typename Parts::Part& low, Index saddle) {
        measure_few(high, saddle);
        measure_few(low, saddle);
        finish(low);
        high.notes.sum.add(low.notes.sum);
        high.notes.vertices += low.notes.vertices;
      },
      [&](typename Parts::Part& part, Index v) {
        Notes& notes = part.notes;
        notes.sum.add(change_at(surface, distance, v));
        ++notes.vertices;
        measure_few(part, v);
        const PartLevel level = notes.sum.at(distance[v], distance[part.top]);
        // Within rounding a line, which encloses nothing.
        if (!(level.depth > least_depth(v)) || !(level.area > 1e-12 * level.depth) || !(level.mouth > 0) ||
            too_large(level, v))
          return;
        const double evidence = level.slenderness() * notes.vertices;
        const bool tells = evidence >= kLeastEvidence || is_twig(level);
        if (tells && (notes.slenderest.depth == 0 || level.slenderness() > notes.slenderest.slenderness()))
          notes.slenderest = level;
        // A mouth is a matter of fewer triangles, so that a depth of one edge suffices.
        if (evidence < 0.5 * kLeastEvidence) return;
        if (notes.narrowest.depth == 0 || level.depth_over_mouth() > notes.narrowest.depth_over_mouth())
          notes.narrowest = level;
      });
  parts.for_each_left(finish);
  return found;
}

}  // namespace detail
}  // namespace mspskel
