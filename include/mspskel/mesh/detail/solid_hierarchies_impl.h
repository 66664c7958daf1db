#pragma once

#include <algorithm>

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/detail/components_around.h"

namespace mspskel {

MSPSKEL_INLINE SolidHierarchies::SolidHierarchies(const SurfaceSnapshot& surface,
                                                  const BoundingVolumeHierarchy& whole,
                                                  const ProgressCallback& progress)
    : whole_(whole), components_(find_component_solids(surface, progress)) {
  const Index n = surface.component_count;
  const std::vector<detail::ComponentBox> boxes = detail::component_boxes(surface);
  for (Index c = 0; c < n; ++c) {
    boxes_.add(c, boxes[c].low, boxes[c].high);
    if (n == 1) break;
    if (c % 64 == 0) report_progress(progress, "solids", static_cast<double>(c) / n);
    own_.emplace_back(surface, components_.faces[c], progress);
  }
  boxes_.build();
}

MSPSKEL_INLINE std::vector<Index> SolidHierarchies::around(const Vector3& p) const {
  std::vector<Index> found;
  boxes_.in_box(p, p, [&](Index c) {
    if ((*this)(c).inside(p)) found.push_back(c);
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace mspskel
