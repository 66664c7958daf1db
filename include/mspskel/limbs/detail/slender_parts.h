// Parts of a surface that protrude by some distance, each at the level at which it is most slender.
#pragma once

#include <utility>
#include <vector>

#include "mspskel/limbs/detail/growing_parts.h"

namespace mspskel {
namespace detail {

struct SlenderPart {
  Index top;           // where it reaches farthest
  double depth;        // of the top beyond the level
  double slenderness;  // 2π depth² / area of what lies beyond the level: length over radius of a tube
  double radius;       // of a tube with that area and depth
};

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

// Among the parts of the given vertices that grow from the maxima of the distance until a farther one takes
// them, those that somewhere deeper than least_depth(vertex) are at least so slender. The area is that of all
// triangles that the part touches, so a part of few triangles is rather too blunt than too slender. In no
// particular order.
template <class LeastDepth>
std::vector<SlenderPart> slender_parts(const SurfaceSnapshot& surface, const std::vector<double>& distance,
                                       std::vector<Index> vertices, double least_slenderness,
                                       LeastDepth least_depth) {
  struct Notes {
    double area = 0;
    double slenderness = 0, depth = 0, radius = 0;
  };
  using Parts = GrowingParts<Notes>;
  std::vector<Index> place(surface.position.size(), kNone);
  Parts parts(surface, distance, std::move(vertices), place);
  std::vector<SlenderPart> found;
  const auto finish = [&](const typename Parts::Part& part) {
    if (part.notes.slenderness >= least_slenderness && part.notes.slenderness > 0)
      found.push_back({part.top, part.notes.depth, part.notes.slenderness, part.notes.radius});
  };
  parts.grow(
      [&](typename Parts::Part& high, typename Parts::Part& low, Index) {
        finish(low);
        high.notes.area += low.notes.area;
      },
      [&](typename Parts::Part& part, Index v) {
        Notes& notes = part.notes;
        notes.area += area_first_touched(surface, distance, v);
        const double depth = distance[part.top] - distance[v];
        // Within rounding a line, which encloses nothing.
        if (!(depth > least_depth(v)) || !(notes.area > 1e-12 * depth)) return;
        const double slenderness = 2 * kPi * depth * depth / notes.area;
        if (slenderness <= notes.slenderness) return;
        notes.slenderness = slenderness;
        notes.depth = depth;
        notes.radius = depth / slenderness;
      });
  parts.for_each_left(finish);
  return found;
}

}  // namespace detail
}  // namespace mspskel
