#pragma once

#include <algorithm>
#include <cmath>

#include "mspskel/base/linkage.h"
#include "mspskel/base/value_at_rank.h"
#include "mspskel/base/watch.h"
#include "mspskel/mesh/component_areas.h"
#include "mspskel/mesh/detail/solid_moments.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
MSPSKEL_INLINE std::vector<bool> find_shells(const SurfaceSnapshot& surface,
                                             const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                             const ProgressCallback& progress) {
  constexpr double kThin = 0.3;       // half widths
  constexpr double kWall = 2.0 / 3;   // share of the area
  constexpr double kPossible = 0.45;  // half the mean thickness, median half widths
  detail::Watch watch(progress, "arcs");
  std::vector<bool> shell(static_cast<std::size_t>(surface.component_count), false);
  std::vector<std::vector<Index>> vertices(shell.size());
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (slices.valid[v]) vertices[surface.component[v]].push_back(v);
  const std::vector<double> area = component_areas(surface);
  const std::vector<detail::SolidMoments> moments = detail::solid_moments(surface);
  const std::vector<double> of_a_handle = areas_per_handle(surface);
  for (std::size_t c = 0; c < shell.size(); ++c) {
    if (vertices[c].empty()) continue;
    std::vector<double> widths;
    double sliced = 0, thin = 0;
    for (const Index v : vertices[c]) widths.push_back(slices.half_width[v]);
    const double width = detail::value_at_rank(std::move(widths), 0.5);
    // A wall of area A, both sides, and thickness t has volume A t / 2.
    if (!(std::abs(moments[c].volume) < kPossible * width * area[c] / 2)) continue;
    if (width * width > of_a_handle[c]) continue;
    for (const Index v : vertices[c]) {
      watch.step();
      sliced += surface.vertex_area[v];
      if (detail::half_chord(surface, solid, v) < kThin * slices.half_width[v])
        thin += surface.vertex_area[v];
    }
    shell[c] = thin >= kWall * sliced;
  }
  return shell;
}

}  // namespace mspskel
