// When a part of the shape is a limb that deserves an arc.
#pragma once

#include <algorithm>
#include <cmath>

#include "mspskel/base/error.h"
#include "mspskel/base/types.h"

namespace mspskel {

namespace detail {
// So much of a limb's end, in half widths, has its mean in the middle of it, on flat ends as well.
inline constexpr double kEnd = 0.5;
// And so much of it is the cap that a leaf arc has to have.
inline constexpr double kTipCap = 1.2;

// Slenderness times the number of vertices of a part is 7 (depth / edge length)²; below 1.5 edges the
// triangles decide what is slender.
inline constexpr double kLeastEvidence = 16;
}  // namespace detail

struct LimbOptions {
  // The least slenderness of a limb, 0 to 1000; larger keeps fewer features. It is 1 for the corner of a cube
  // as its centre sees it.
  double slenderness = 1.25;
  // As a share of the model's extent, 0 to 1. Limbs are some times deeper; below it everything is noise.
  double smallest = 0.01;
};

inline void validate(const LimbOptions& o) {
  if (!(o.slenderness >= 0 && o.slenderness <= 1000))
    throw UsageError("slenderness of limbs must be from 0 to 1000");
  if (!(o.smallest >= 0 && o.smallest <= 1))
    throw UsageError("smallest feature must be from 0 to 1 of the extent");
}

// What a limb is judged by: how far it protrudes for its surface, for its width, and how much smaller its
// slices are than those of the part that it leaves (the saturation of Eq. 4.5 lifted from nodes to branches).
struct LimbMeasures {
  double depth = 0.0;  // how far the limb's surface reaches beyond the rest
  // The radius of a tube of its area and depth. Its slices' own widths move with the few triangles of an end.
  double half_width = 0.0;
  double half_chord = 0.0;      // half the chord inward from its surface, the median
  double half_thickness = 0.0;  // the lower quartile: chords from the edges of a slab are longer
  // The same of the surface beside its root, the mean of the logarithms: a median jumps where a thin part
  // and a thick one meet.
  double carrier_half_chord = 0.0;
  double carrier_half_thickness = 0.0;  // their lower quartile
  double msp_ratio = 1.0;               // MSP of the part that it leaves / MSP of the limb, at least 1
  // 2π depth² / area: length over radius of a tube, 2 / sin of the half angle of a cone. An area moves little
  // under noise and with the triangles, so this decides.
  double slenderness = 0.0;
  double mean_depth =
      0.5;  // of its surface below its tip, over depth: 1/2 of a tube, 2/3 of a cone or corner
  // 2π depth / length of the contour where it leaves the rest: 1 / sin of the half angle of a cone.
  double depth_over_mouth = 0.0;
};

// Depth over mouth of a right-angled cone.
inline constexpr double kSharp = 1.4142;

// Whether a part is blunter than that. Spikes and fins are deep for their mouths.
inline bool is_blunt(double depth_over_mouth) { return depth_over_mouth < kSharp; }

// Whether a part is no sharper than the right-angled corner of a slab, by both of its measures: beyond a
// level across such a corner lie 2 depth² of area on the two sides and 2√2 depth · thickness on the edges,
// and the level is 4 depth + 2 thickness long. A share more will do, as `slack` says, since arcs and other
// limbs bend the level; where a twig leaves what the arcs cover, the level may run along all of that and says
// nothing, but its area does. What is thicker than twice its depth is a bump of a body. The blunt end of a
// plank is as a corner until it is half as deep as wide.
inline bool is_slab_corner(double depth, double depth_over_mouth, double slenderness, double thickness,
                           double slack) {
  const double relative = thickness / depth;
  return relative < 2 && slenderness * (1 + 1.4142 * relative) < slack * kPi &&
         depth_over_mouth * (2 + relative) < slack * kPi;
}

// Whether a part is hardly sharper than the corner of a block, whose depth is 0.855 of its mouth's radius.
inline bool is_block_corner(double depth_over_mouth) { return depth_over_mouth < 1.25 * 0.855; }

// The bend of a bar, the bow of a handle, the corner where bars meet: its slices are hardly smaller than
// those beside it.
inline bool is_bend(const LimbMeasures& m) {
  return is_block_corner(m.depth_over_mouth) && m.msp_ratio < 1.4;
}

// A fold of the surface onto itself, or a slit, that encloses nothing. Sheets are three times as thick at
// least.
inline bool is_flap(const LimbMeasures& m) { return m.half_chord < 0.01 * m.half_width; }

// A piece of the edge of a disc or a plate: its area is less than that of a flat disc with a rim as long. The
// middle of a square plate sees its corners with three quarters of that. No cone has less than all of it, but
// noise makes rims longer.
inline bool is_rim(const LimbMeasures& m) {
  constexpr double kLeast = 0.75;
  return 2 * m.depth_over_mouth * m.depth_over_mouth < kLeast * m.slenderness;
}

// The corner of a body: a rim, a bend, the corner of a slab (a fin leaves what is thicker), or blunt, and
// widening in proportion to its depth or wider than what carries it. A limb is about as wide at its root as
// before it. Where the whole body lies behind the surface, less of a taper will do. The slab's thickness is
// told better beside the corner, where fewer chords lead from its edges, and needs no slack.
inline bool is_corner(const LimbMeasures& m) {
  constexpr double kSlack = 1.1, kWider = 1.35;
  if (is_bend(m) || is_rim(m)) return true;
  const bool of_slab = m.carrier_half_thickness < kWider * m.half_thickness;
  const auto of_thickness = [&](double thickness, double slack) {
    return is_slab_corner(m.depth, m.depth_over_mouth, m.slenderness, thickness, slack);
  };
  if (of_slab &&
      (of_thickness(2 * m.half_thickness, kSlack) || of_thickness(2 * m.carrier_half_thickness, 1)))
    return true;
  const bool widens = m.mean_depth > (m.half_chord > 2.25 * m.half_width ? 0.61 : 0.655);
  return is_blunt(m.depth_over_mouth) && (widens || m.half_width > kWider * m.carrier_half_chord);
}

// A limb by its slenderness. Its surface faces itself: inward of the corner of a block is the whole block.
inline bool is_limb(const LimbMeasures& m, const LimbOptions& o) {
  return m.slenderness >= o.slenderness && m.half_chord <= 1.75 * m.half_width && !is_corner(m) &&
         !is_flap(m);
}

// Whether two measures differ by a share that parts which people call equal may differ by.
inline bool about_equal(double a, double b) {
  constexpr double kAlike = 1.2;
  return a < kAlike * b && b < kAlike * a;
}

// Slenderness of fingers, in those of limbs.
inline constexpr double kFinger = 1.6;

// A finger or a toe, beside others of a palm.
inline bool is_digit(double depth, double slenderness, const LimbOptions& o) {
  return slenderness >= kFinger * o.slenderness && depth >= 1.6 * o.smallest;
}

// Slenderness of ears, in that of limbs, times what they are smaller than what carries them.
inline constexpr double kSlenderEar = 0.65;

// An ear or a horn: a bump rather than a limb, but much smaller than what carries it, and no wider unless it
// is sharp. Only in a shape that has limbs or whose body ends: a ridge of a plain body may be as much.
inline bool is_ear(const LimbMeasures& m, const LimbOptions& o) {
  constexpr double kAsWide = 1.25;  // a bump's radius by its area is larger than that of its slices
  if (is_blunt(m.depth_over_mouth) && m.half_width > kAsWide * m.carrier_half_chord) return false;
  return m.slenderness >= 0.3 * o.slenderness && m.slenderness * m.msp_ratio >= kSlenderEar * o.slenderness &&
         !is_corner(m) && !is_flap(m);
}

// How slender a part that no arc comes near has to be to get one: as a limb where it is sharp and as a digit
// where it is blunt, since the rest of the shape, which the arcs cover, is no part of its measure. A step
// between the two would make equal parts differ that noise puts on both sides of it.
inline double uncovered_slenderness(double depth_over_mouth, const LimbOptions& o) {
  constexpr double kSteepness = 1.5;
  return o.slenderness * std::clamp(std::pow(kSharp / depth_over_mouth, kSteepness), 1.0, kFinger);
}

}  // namespace mspskel
