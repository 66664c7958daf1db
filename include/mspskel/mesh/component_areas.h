// How much surface each component has, and for each of its handles.
#pragma once

#include <limits>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// In squares of the normalised frame's unit. O(vertices).
inline std::vector<double> component_areas(const SurfaceSnapshot& surface) {
  std::vector<double> area(static_cast<std::size_t>(surface.component_count), 0.0);
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.vertex_halfedge[v] != kNone) area[surface.component[v]] += surface.vertex_area[v];
  return area;
}

// The area of each component for one of its handles, in squares of the normalised frame's unit; infinite
// where it has none. A planar section that is wide beside it goes round many handles, as those of a sponge
// do, and what bounds it far away says nothing of the solid here. O(faces).
inline std::vector<double> areas_per_handle(const SurfaceSnapshot& surface) {
  std::vector<double> area = component_areas(surface);
  const std::vector<Index> handles = handles_of_components(surface);
  for (std::size_t c = 0; c < area.size(); ++c)
    area[c] = handles[c] > 0 ? area[c] / handles[c] : std::numeric_limits<double>::infinity();
  return area;
}

}  // namespace mspskel
