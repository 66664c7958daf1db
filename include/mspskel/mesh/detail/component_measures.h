// What a mesh report says of components.
#pragma once

#include "mspskel/mesh/mesh_report.h"

namespace mspskel {
namespace detail {

// Counts, areas and volumes, in normalised units.
inline void measure_components(const SurfaceSnapshot& s, MeshReport& r) {
  r.components.resize(s.component_count);
  for (Index v = 0; v < s.vertex_count(); ++v) {
    if (s.component[v] == kNone)
      ++r.isolated_vertices;
    else
      ++r.components[s.component[v]].vertices;
  }
  for (Index f = 0; f < s.face_count(); ++f) {
    ComponentReport& c = r.components[s.component[s.origin[3 * f]]];
    const Vector3 normal = s.face_normal_times_twice_area(f);
    ++c.faces;
    c.area += normal.norm() / 2;
    c.signed_volume += normal.dot(s.position[s.origin[3 * f]]) / 6;
  }
  for (ComponentReport& c : r.components) {
    c.edges = c.faces / 2 * 3;
    c.genus = (2 - (c.vertices - c.edges + c.faces)) / 2;
    r.edges += c.edges;
    r.genus += c.genus;
    r.area += c.area;
    r.signed_volume += c.signed_volume;
  }
}

}  // namespace detail
}  // namespace mspskel
