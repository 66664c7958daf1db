#pragma once

#include <algorithm>

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/detail/components_around.h"

namespace mspskel {
MSPSKEL_INLINE ComponentSolids find_component_solids(const SurfaceSnapshot& surface,
                                                     const ProgressCallback& progress) {
  const Index n = surface.component_count;
  ComponentSolids solids;
  solids.around.assign(n, kNone);
  solids.cavity.assign(n, 0);
  solids.signed_volume.assign(n, 0.0);
  solids.faces.resize(n);
  const std::vector<detail::ComponentBox> boxes = detail::component_boxes(surface);
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Index c = surface.component[surface.origin[3 * f]];
    solids.faces[c].push_back(f);
    solids.signed_volume[c] += surface.face_normal_times_twice_area(f).dot(
                                   surface.position[surface.origin[3 * f]] - boxes[c].first) /
                               6;
  }
  const auto around = detail::components_around(surface, solids.faces, boxes, progress);
  // What lies around another one has fewer around itself. Of pieces that cross, each may be found around the
  // other: neither is.
  for (Index c = 0; c < n; ++c)
    for (const Index outer : around[c])
      if (around[outer].size() < around[c].size() &&
          (solids.around[c] == kNone || around[outer].size() > around[solids.around[c]].size()))
        solids.around[c] = outer;
  const std::vector<std::vector<Index>> own = solids.faces;
  for (Index c = 0; c < n; ++c) {
    const Index outer = solids.around[c];
    if (outer == kNone || (solids.signed_volume[c] < 0) == (solids.signed_volume[outer] < 0)) continue;
    solids.faces[outer].insert(solids.faces[outer].end(), own[c].begin(), own[c].end());
    // What floats in a cavity is turned as the outermost one is, and no cavity itself.
    Index depth = 0;
    for (Index d = outer; d != kNone; d = solids.around[d]) ++depth;
    solids.cavity[c] = depth % 2 == 1;
  }
  return solids;
}

MSPSKEL_INLINE SurfacePart surface_part(const SurfaceSnapshot& surface, const std::vector<Index>& faces,
                                        std::size_t measured) {
  SurfacePart part;
  for (const Index f : faces)
    for (Index h = 3 * f; h < 3 * f + 3; ++h) part.vertex.push_back(surface.origin[h]);
  std::sort(part.vertex.begin(), part.vertex.end());
  part.vertex.erase(std::unique(part.vertex.begin(), part.vertex.end()), part.vertex.end());
  const auto place_in = [](const std::vector<Index>& list, std::size_t begin, std::size_t end, Index x) {
    const auto first = list.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = list.begin() + static_cast<std::ptrdiff_t>(end);
    return static_cast<Index>(std::lower_bound(first, last, x) - list.begin());
  };
  std::vector<Index> sorted = faces;
  const auto others = sorted.begin() + static_cast<std::ptrdiff_t>(measured);
  std::sort(sorted.begin(), others);
  std::sort(others, sorted.end());
  SurfaceSnapshot& s = part.surface;
  for (const Index v : part.vertex) s.position.push_back(surface.frame.to_model(surface.position[v]));
  for (std::size_t k = 0; k < sorted.size(); ++k) {
    // A face and its neighbours are of one component, so they stand in the same of the two lists.
    const std::size_t begin = k < measured ? 0 : measured, end = k < measured ? measured : sorted.size();
    for (Index h = 3 * sorted[k]; h < 3 * sorted[k] + 3; ++h) {
      const Index twin = surface.twin[h];
      s.origin.push_back(place_in(part.vertex, 0, part.vertex.size(), surface.origin[h]));
      s.twin.push_back(3 * place_in(sorted, begin, end, twin / 3) + twin % 3);
    }
  }
  if (measured == faces.size()) {
    s.vertex_halfedge.assign(s.position.size(), 0);  // every vertex has faces
    detail::normalise(s);
  } else {
    s.frame = surface_part(surface, {faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(measured)},
                           measured)
                  .surface.frame;
    for (Vector3& p : s.position) p = s.frame.to_normalised(p);
  }
  detail::complete_snapshot(s);
  return part;
}

}  // namespace mspskel
