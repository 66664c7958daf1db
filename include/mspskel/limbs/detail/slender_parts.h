// Parts of a surface that protrude by some distance, each at the level at which it is most slender.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/limb_measures.h"

namespace mspskel {
namespace detail {

// What a part is at one level. Its mouth is the level's contour round it.
struct PartLevel {
  double depth = 0, area = 0, mouth = 0;

  double slenderness() const { return 2 * kPi * depth * depth / area; }
  // Depth over the radius of a disc with such a rim: 0.82 for the corner of a cube, 1 for a right-angled
  // cone.
  double depth_over_mouth() const { return 2 * kPi * depth / mouth; }
  // Area over that of the disc: 1 for what is flat, 2 for a half ball, less than 1 for the corner of a cube
  // and at most pi / 2 for that of a thin plate.
  double bulge() const { return 4 * kPi * area / (mouth * mouth); }
};

// A bump that is no wider than what carries it, as a fin, a nose or a boss: deep for its mouth and bulging
// from it, the mouth no longer than the rim of a square as wide as the ball that carries it.
inline bool is_bump(const PartLevel& level, double carrier_rim, const LimbOptions& options) {
  constexpr double kSquare = 4 / kPi;  // over the rim of a ball of that width
  return level.depth_over_mouth() >= 0.64 * options.slenderness && level.bulge() >= 1.5 &&
         level.mouth <= kSquare * carrier_rim;
}

// A part at the levels at which it is most so.
struct SlenderPart {
  Index top;             // where it reaches farthest
  PartLevel slenderest;  // for its area
  PartLevel narrowest;   // for its mouth; of no depth where it never is less than half of its component, or
                         // of enough vertices to tell
};

// How long the contour of a level is in one triangle: no more than linear in the level between the corners,
// so that the contours of a part add up as it grows.
struct ContourLength {
  double at_zero = 0, slope = 0;  // at_zero + slope · level

  double at(double level) const { return at_zero + slope * level; }
  ContourLength& operator+=(const ContourLength& o) {
    at_zero += o.at_zero;
    slope += o.slope;
    return *this;
  }
  ContourLength& operator-=(const ContourLength& o) {
    at_zero -= o.at_zero;
    slope -= o.slope;
    return *this;
  }
};

// What the contour in a triangle changes by once the corner v lies beyond the level. Where two corners are as
// far, it stays until both of them are beyond: the part rather has too long a contour than too short a one.
inline ContourLength contour_change(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                    std::array<Index, 3> corner, Index v) {
  std::sort(corner.begin(), corner.end(),
            [&](Index a, Index b) { return distance[a] != distance[b] ? distance[a] > distance[b] : a < b; });
  constexpr double kLeastFall = 1e-7;  // nearly level triangles would leave rounding errors behind
  const double high = distance[corner[0]], middle = distance[corner[1]], low = distance[corner[2]];
  const bool has_upper = high - middle > kLeastFall, has_lower = middle - low > kLeastFall;
  ContourLength change;
  if (!has_upper && !has_lower) return change;
  const Vector3& a = surface.position[corner[0]];
  const Vector3 opposite = a + (high - middle) / (high - low) * (surface.position[corner[2]] - a);
  const double length = (surface.position[corner[1]] - opposite).norm();
  if (has_upper && (v == corner[0] || v == corner[has_lower ? 1 : 2])) {
    const ContourLength upper{length * high / (high - middle), -length / (high - middle)};
    v == corner[0] ? change += upper : change -= upper;
  }
  if (has_lower && (v == corner[2] || v == corner[has_upper ? 1 : 0])) {
    const ContourLength lower{-length * low / (middle - low), length / (middle - low)};
    v == corner[2] ? change -= lower : change += lower;
  }
  return change;
}

// The area of the triangles at v whose other corners lie less far, so that no triangle counts twice.
inline double area_first_touched(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                 Index v) {
  const auto less_far = [&](Index w) {
    return distance[w] != distance[v] ? distance[w] < distance[v] : w > v;
  };
  double twice = 0;
  const Index first = surface.vertex_halfedge[v];
  Index h = first;
  do {
    if (less_far(surface.target(h)) && less_far(surface.apex(h)))
      twice += surface.face_normal_times_twice_area(SurfaceSnapshot::face(h)).norm();
    h = surface.next_outgoing(h);
  } while (h != first);
  return 0.5 * twice;
}

// What the contours of a vertex's triangles change by once it lies beyond the level.
inline ContourLength contour_change_at(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                       Index v) {
  ContourLength change;
  const Index first = surface.vertex_halfedge[v];
  Index h = first;
  do {
    change += contour_change(surface, distance, {v, surface.target(h), surface.apex(h)}, v);
    h = surface.next_outgoing(h);
  } while (h != first);
  return change;
}

inline std::vector<double> half_areas_of_components(const SurfaceSnapshot& surface) {
  std::vector<double> half(static_cast<std::size_t>(surface.component_count), 0.0);
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.vertex_halfedge[v] != kNone) half[surface.component[v]] += 0.5 * surface.vertex_area[v];
  return half;
}

// The parts of the given vertices that grow from the maxima of the distance until a farther one takes them,
// as they are where they are deeper than least_depth(vertex). The area is that of all triangles that the part
// touches, so a part of few triangles is rather too blunt than too slender. In no particular order.
template <class LeastDepth>
std::vector<SlenderPart> slender_parts(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                       std::vector<Index> vertices, LeastDepth least_depth) {
  struct Notes {
    double area = 0;
    Index vertices = 0;
    ContourLength mouth;
    PartLevel slenderest, narrowest;
  };
  using Parts = GrowingParts<Notes>;
  const std::vector<double> half_area = half_areas_of_components(surface);
  std::vector<Index> place(surface.position.size(), kNone);
  Parts parts(surface, distance, std::move(vertices), place);
  std::vector<SlenderPart> found;
  const auto finish = [&](const typename Parts::Part& part) {
    if (part.notes.slenderest.depth > 0)
      found.push_back({part.top, part.notes.slenderest, part.notes.narrowest});
  };
  parts.grow(
      [&](typename Parts::Part& high, typename Parts::Part& low, Index) {
        finish(low);
        high.notes.area += low.notes.area;
        high.notes.vertices += low.notes.vertices;
        high.notes.mouth += low.notes.mouth;
      },
      [&](typename Parts::Part& part, Index v) {
        Notes& notes = part.notes;
        notes.area += area_first_touched(surface, distance, v);
        ++notes.vertices;
        notes.mouth += contour_change_at(surface, distance, v);
        const PartLevel level{distance[part.top] - distance[v], notes.area, notes.mouth.at(distance[v])};
        // Within rounding a line, which encloses nothing.
        if (!(level.depth > least_depth(v)) || !(level.area > 1e-12 * level.depth)) return;
        if (notes.slenderest.depth == 0 || level.slenderness() > notes.slenderest.slenderness())
          notes.slenderest = level;
        if (!(level.mouth > 0) || level.area > half_area[surface.component[v]]) return;
        // A mouth is cut within triangles, so that a depth of one edge suffices.
        if (level.slenderness() * notes.vertices < 0.5 * kLeastEvidence) return;
        if (notes.narrowest.depth == 0 || level.depth_over_mouth() > notes.narrowest.depth_over_mouth())
          notes.narrowest = level;
      });
  parts.for_each_left(finish);
  return found;
}

}  // namespace detail
}  // namespace mspskel
