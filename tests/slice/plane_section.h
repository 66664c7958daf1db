// An independent answer to "the contours of this plane": every triangle is cut, the segments are chained.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel::test {

struct SectionLoop {
  double perimeter = 0.0;
  double area = 0.0;  // positive round material
  bool through_vertex = false;
};

// All contours of the plane through vertex v, which counts as positive. The area is half the integral of
// x · ν along the contour (divergence theorem), ν the outward surface normal within the plane.
inline std::vector<SectionLoop> plane_section(const SurfaceSnapshot& s, Index v, const Vector3& normal) {
  using Edge = std::pair<Index, Index>;
  struct Segment {
    std::array<Edge, 2> end;
    std::array<Vector3, 2> point;
    Index face;
  };
  const Vector3 origin = s.position[v];
  const auto side = [&](Index w) { return w == v ? 0.0 : normal.dot(s.position[w] - origin); };
  std::vector<Segment> segments;
  std::map<Edge, std::vector<std::size_t>> at;
  for (Index f = 0; f < s.face_count(); ++f) {
    Segment segment;
    segment.face = f;
    int ends = 0;
    for (Index k = 0; k < 3; ++k) {
      const Index a = s.origin[3 * f + k], b = s.origin[3 * f + (k + 1) % 3];
      const double da = side(a), db = side(b);
      if ((da >= 0) == (db >= 0)) continue;
      segment.end[ends] = {std::min(a, b), std::max(a, b)};
      segment.point[ends++] = (db * s.position[a] - da * s.position[b]) / (db - da);
    }
    if (ends != 2) continue;
    for (const Edge& e : segment.end) at[e].push_back(segments.size());
    segments.push_back(segment);
  }
  std::vector<SectionLoop> loops;
  std::vector<char> used(segments.size(), 0);
  for (std::size_t first = 0; first < segments.size(); ++first) {
    if (used[first]) continue;
    SectionLoop loop;
    std::vector<std::size_t> open = {first};
    used[first] = 1;
    while (!open.empty()) {
      const Segment& segment = segments[open.back()];
      open.pop_back();
      const Vector3 along = segment.point[1] - segment.point[0];
      const Vector3 outward = s.face_normal_times_twice_area(segment.face);
      const Vector3 across = (outward - outward.dot(normal) * normal).normalized();
      loop.perimeter += along.norm();
      loop.area += 0.25 * along.norm() * across.dot(segment.point[0] + segment.point[1] - 2 * origin);
      for (const Edge& e : segment.end) {
        loop.through_vertex = loop.through_vertex || e.first == v || e.second == v;
        for (const std::size_t other : at[e])
          if (!used[other]) {
            used[other] = 1;
            open.push_back(other);
          }
      }
    }
    loops.push_back(loop);
  }
  return loops;
}

// The shortest contour through v that bounds material; infinity if there is none.
inline double shortest_section(const SurfaceSnapshot& s, Index v, const Vector3& normal) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const SectionLoop& loop : plane_section(s, v, normal))
    if (loop.through_vertex && loop.area > 1e-15) shortest = std::min(shortest, loop.perimeter);
  return shortest;
}

}  // namespace mspskel::test
