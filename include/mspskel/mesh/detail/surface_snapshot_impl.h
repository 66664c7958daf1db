#pragma once

#include <algorithm>
#include <cmath>

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/detail/extent.h"
#include "mspskel/mesh/detail/unit_scale.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

MSPSKEL_INLINE void normalise(SurfaceSnapshot& s) {
  for (std::size_t v = 0; v < s.position.size(); ++v)
    if (!s.position[v].allFinite())
      throw MeshError("vertex " + std::to_string(v) + " has a coordinate that is not finite");
  // Brought to the size of 1, areas and squares of lengths are numbers.
  const double unit = unit_scale(s.position);
  for (Vector3& p : s.position) p *= unit;
  // A first shift keeps the centroid's rounding small for models far from the origin.
  const Vector3 shift = s.position[static_cast<std::size_t>(s.origin[0])];
  Vector3 weighted = Vector3::Zero();
  double area = 0;
  for (Index f = 0; f < s.face_count(); ++f) {
    const Vector3 a = s.position[s.origin[3 * f]] - shift, b = s.position[s.origin[3 * f + 1]] - shift,
                  c = s.position[s.origin[3 * f + 2]] - shift;
    const double twice = (b - a).cross(c - a).norm();
    area += twice;
    weighted += twice * (a + b + c) / 3.0;
  }
  if (!(area > 0)) throw MeshError("the surface has no area");
  s.frame.origin = shift + weighted / area;
  std::vector<Vector3> used;
  for (std::size_t v = 0; v < s.position.size(); ++v)
    if (s.vertex_halfedge[v] != kNone) used.push_back(s.position[v]);
  s.frame.scale = extent(used, s.frame.origin);
  for (Vector3& p : s.position) p = s.frame.to_normalised(p);
  s.frame.origin /= unit;
  s.frame.scale /= unit;
  if (!std::isfinite(s.frame.scale * s.frame.scale))
    throw MeshError("the coordinates are too large: areas would not be numbers; make the model smaller");
}

// Angle-weighted vertex normals, barycentric vertex areas.
inline void measure_vertices(SurfaceSnapshot& s) {
  s.normal.assign(s.position.size(), Vector3::Zero());
  s.vertex_area.assign(s.position.size(), 0.0);
  for (Index f = 0; f < s.face_count(); ++f) {
    const Index corner[3] = {s.origin[3 * f], s.origin[3 * f + 1], s.origin[3 * f + 2]};
    const Vector3 ab = s.position[corner[1]] - s.position[corner[0]],
                  ac = s.position[corner[2]] - s.position[corner[0]], n = ab.cross(ac);
    const double twice = n.norm();
    for (const Index v : corner) s.vertex_area[v] += twice / 6.0;
    if (!(twice > 0)) continue;
    const double at_a = std::atan2(twice, ab.dot(ac)), at_b = std::atan2(twice, ab.dot(ab - ac));
    const double angle[3] = {at_a, at_b, std::max(kPi - at_a - at_b, 0.0)};
    for (int k = 0; k < 3; ++k) s.normal[corner[k]] += angle[k] / twice * n;
  }
  for (std::size_t v = 0; v < s.normal.size(); ++v) {
    const double length = s.normal[v].norm();
    // All faces at v are degenerate or cancel out: any direction serves, slices there are rejected on their
    // merits.
    s.normal[v] = length > 0 ? Vector3(s.normal[v] / length) : Vector3::UnitX();
  }
}

inline void number_components(SurfaceSnapshot& s) {
  s.component.assign(s.position.size(), kNone);
  std::vector<Index> stack;
  for (Index seed = 0; seed < s.vertex_count(); ++seed) {
    if (s.component[seed] != kNone || s.vertex_halfedge[seed] == kNone) continue;
    s.component[seed] = s.component_count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Index first = s.vertex_halfedge[stack.back()];
      stack.pop_back();
      Index h = first;
      do {
        const Index w = s.target(h);
        if (s.component[w] == kNone) {
          s.component[w] = s.component_count;
          stack.push_back(w);
        }
        h = s.next_outgoing(h);
      } while (h != first);
    }
    ++s.component_count;
  }
}

MSPSKEL_INLINE void check_vertex_fans(const SurfaceSnapshot& s) {
  const auto fan_size = [&](Index v) {
    const Index first = s.vertex_halfedge[v];
    Index size = 0, h = first;
    do {
      ++size;
      h = s.next_outgoing(h);
    } while (h != first);
    return size;
  };
  // One fan a vertex reaches all half-edges, unless some vertex has more.
  Index reached = 0;
  for (Index v = 0; v < s.vertex_count(); ++v)
    if (s.vertex_halfedge[v] != kNone) reached += fan_size(v);
  if (reached == s.halfedge_count()) return;
  std::vector<Index> incident(s.position.size(), 0);
  for (Index h = 0; h < s.halfedge_count(); ++h) ++incident[s.origin[h]];
  for (Index v = 0; v < s.vertex_count(); ++v)
    if (s.vertex_halfedge[v] != kNone && fan_size(v) != incident[v])
      throw MeshError("several fans of faces meet at vertex " + std::to_string(v));
}

MSPSKEL_INLINE void complete_snapshot(SurfaceSnapshot& s) {
  s.vertex_halfedge.assign(s.position.size(), kNone);
  for (Index h = s.halfedge_count() - 1; h >= 0; --h) s.vertex_halfedge[s.origin[h]] = h;
  measure_vertices(s);
  number_components(s);
}

}  // namespace detail

MSPSKEL_INLINE std::vector<Index> twice_euler_characteristics(const SurfaceSnapshot& surface) {
  std::vector<Index> result(static_cast<std::size_t>(surface.component_count), 0);
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.vertex_halfedge[v] != kNone) result[surface.component[v]] += 2;
  for (Index h = 0; h < surface.halfedge_count(); h += 3) --result[surface.component[surface.origin[h]]];
  return result;
}

MSPSKEL_INLINE std::vector<Index> handles_of_components(const SurfaceSnapshot& surface) {
  std::vector<Index> handles = twice_euler_characteristics(surface);
  for (Index& count : handles) count = (4 - count) / 4;
  return handles;
}

}  // namespace mspskel
