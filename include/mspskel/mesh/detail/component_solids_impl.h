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

namespace detail {

// Numbers in order without repetition, each with its place among them. Where they lie close together, as
// those of a component mostly do, a table tells the place; else a search does.
class OrderedNumbers {
 public:
  explicit OrderedNumbers(const std::vector<Index>& numbers) {
    const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
    first_ = numbers.empty() ? 0 : *low;
    const std::size_t range = numbers.empty() ? 0 : static_cast<std::size_t>(*high - first_) + 1;
    if (range <= kLoosest * numbers.size()) {
      table_.assign(range, kNone);
      for (const Index x : numbers) table_[x - first_] = 0;
      for (std::size_t k = 0; k < range; ++k) {
        if (table_[k] == kNone) continue;
        table_[k] = static_cast<Index>(ordered_.size());
        ordered_.push_back(first_ + static_cast<Index>(k));
      }
    } else {
      ordered_ = numbers;
      std::sort(ordered_.begin(), ordered_.end());
      ordered_.erase(std::unique(ordered_.begin(), ordered_.end()), ordered_.end());
    }
  }
  const std::vector<Index>& ordered() const { return ordered_; }
  Index place(Index x) const {
    if (!table_.empty()) return table_[x - first_];
    return static_cast<Index>(std::lower_bound(ordered_.begin(), ordered_.end(), x) - ordered_.begin());
  }

 private:
  static constexpr std::size_t kLoosest = 8;  // entries of the table per number
  std::vector<Index> ordered_, table_;
  Index first_;
};

// Positions in model coordinates and connectivity. Each list of faces is that of whole components, so a
// face's neighbours are in its list.
inline SurfacePart connect_part(const SurfaceSnapshot& surface,
                                const std::vector<std::vector<Index>>& lists) {
  SurfacePart part;
  std::vector<Index> corners;
  for (const std::vector<Index>& faces : lists)
    for (const Index f : faces)
      corners.insert(corners.end(), &surface.origin[3 * f], &surface.origin[3 * f] + 3);
  const OrderedNumbers vertices(corners);
  part.vertex = vertices.ordered();
  SurfaceSnapshot& s = part.surface;
  for (const Index v : part.vertex) s.position.push_back(surface.frame.to_model(surface.position[v]));
  Index before = 0;  // faces of the lists before
  for (const std::vector<Index>& faces : lists) {
    const OrderedNumbers order(faces);
    for (const Index f : order.ordered())
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index twin = surface.twin[h];
        s.origin.push_back(vertices.place(surface.origin[h]));
        s.twin.push_back(3 * (before + order.place(twin / 3)) + twin % 3);
      }
    before += static_cast<Index>(faces.size());
  }
  return part;
}

}  // namespace detail

MSPSKEL_INLINE SurfacePart surface_part(const SurfaceSnapshot& surface, const std::vector<Index>& faces) {
  SurfacePart part = detail::connect_part(surface, {faces});
  part.surface.vertex_halfedge.assign(part.surface.position.size(), 0);  // every vertex has faces
  detail::normalise(part.surface);
  detail::complete_snapshot(part.surface);
  return part;
}

MSPSKEL_INLINE SurfacePart solid_part(const SurfaceSnapshot& surface, const std::vector<Index>& faces,
                                      std::size_t own, const NormalisedFrame& frame) {
  const auto cavities = faces.begin() + static_cast<std::ptrdiff_t>(own);
  SurfacePart part = detail::connect_part(surface, {{faces.begin(), cavities}, {cavities, faces.end()}});
  part.surface.frame = frame;
  for (Vector3& p : part.surface.position) p = frame.to_normalised(p);
  detail::complete_snapshot(part.surface);
  return part;
}

}  // namespace mspskel
