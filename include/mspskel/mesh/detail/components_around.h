// Boxes of components, and which component lies inside which.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

struct ComponentBox {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  Vector3 first = Vector3::Zero();  // a vertex of the component

  bool contains(const Vector3& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};

inline std::vector<std::vector<Index>> faces_of_components(const SurfaceSnapshot& surface) {
  std::vector<std::vector<Index>> faces(surface.component_count);
  for (Index f = 0; f < surface.face_count(); ++f)
    faces[surface.component[surface.origin[3 * f]]].push_back(f);
  return faces;
}

inline std::vector<ComponentBox> component_boxes(const SurfaceSnapshot& surface) {
  std::vector<ComponentBox> boxes(surface.component_count);
  for (Index v = surface.vertex_count() - 1; v >= 0; --v) {
    const Index c = surface.component[v];
    if (c == kNone) continue;
    ComponentBox& box = boxes[c];
    const Vector3& p = surface.position[v];
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
    box.first = p;
  }
  return boxes;
}

// Per component those around it, found by a sweep along x over the components' first vertices.
inline std::vector<std::vector<Index>> components_around(const SurfaceSnapshot& surface,
                                                         const std::vector<std::vector<Index>>& own_faces,
                                                         const std::vector<ComponentBox>& boxes,
                                                         const ProgressCallback& progress) {
  const Index n = surface.component_count;
  std::vector<std::pair<double, Index>> by_x;
  for (Index c = 0; c < n; ++c) by_x.emplace_back(boxes[c].first.x(), c);
  std::sort(by_x.begin(), by_x.end());
  std::vector<std::vector<Index>> around(n);
  for (Index outer = 0; outer < n; ++outer) {
    if (outer % 64 == 0) report_progress(progress, "components", static_cast<double>(outer) / n);
    std::vector<Index> candidates;
    for (auto it = std::lower_bound(by_x.begin(), by_x.end(), std::make_pair(boxes[outer].low.x(), Index{0}));
         it != by_x.end() && it->first <= boxes[outer].high.x(); ++it)
      if (it->second != outer && boxes[outer].contains(boxes[it->second].first))
        candidates.push_back(it->second);
    if (candidates.empty()) continue;
    const BoundingVolumeHierarchy hierarchy(surface, own_faces[outer]);
    for (const Index inner : candidates)
      if (hierarchy.inside(boxes[inner].first)) around[inner].push_back(outer);
  }
  return around;
}

}  // namespace detail
}  // namespace mspskel
