// Turns inner shells outward, so that each shell bounds a solid of its own.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// A cavity's shell is oriented towards the cavity: seen from there its slices bound no material and none is
// valid. A copy of the surface in which the components of negative volume are turned over, or nothing if
// there are none. Vertices keep their numbers; half-edges of turned faces do not. Cost: O(faces).
inline std::optional<SurfaceSnapshot> orient_shells_outward(const SurfaceSnapshot& surface) {
  std::vector<double> volume(surface.component_count, 0.0);
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Vector3 &a = surface.position[surface.origin[3 * f]],
                  &b = surface.position[surface.origin[3 * f + 1]],
                  &c = surface.position[surface.origin[3 * f + 2]];
    volume[surface.component[surface.origin[3 * f]]] += a.dot(b.cross(c)) / 6;
  }
  const auto turned = [&](Index h) { return volume[surface.component[surface.origin[h]]] < 0; };
  // Face a b c becomes a c b: the reverse of half-edge 3f stays first, the other two change places.
  const auto reversed = [&](Index h) { return !turned(h) || h % 3 == 0 ? h : h % 3 == 1 ? h + 1 : h - 1; };
  std::optional<SurfaceSnapshot> result;
  for (const double v : volume)
    if (v < 0 && !result) result = surface;
  if (!result) return result;
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    if (!turned(h)) continue;
    result->origin[reversed(h)] = surface.target(h);
    result->twin[reversed(h)] = reversed(surface.twin[h]);
  }
  for (Index h = 0; h < result->halfedge_count(); ++h) result->vertex_halfedge[result->origin[h]] = h;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.component[v] != kNone && volume[surface.component[v]] < 0)
      result->normal[v] = -surface.normal[v];
  return result;
}

}  // namespace mspskel
