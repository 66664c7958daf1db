#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mspskel/base/even_directions.h"
#include "mspskel/base/linkage.h"

namespace mspskel {

namespace detail::slice_centre {

// At a saddle a contour may come to its vertex twice, and rounding decides on which loop the walk began: the
// visit that the longest way follows.
inline Index first_visit(const Contour& contour, const std::vector<Index>& visits) {
  const std::size_t count = contour.point.size();
  Index best = visits.front();
  double longest = -1;
  for (std::size_t k = 0; k < visits.size() && visits.size() > 1; ++k) {
    const auto next = static_cast<std::size_t>(visits[(k + 1) % visits.size()]);
    double length = 0;
    for (auto i = static_cast<std::size_t>(visits[k]); i != next; i = (i + 1) % count)
      length += (contour.point[(i + 1) % count] - contour.point[i]).norm();
    if (length > longest) longest = length, best = visits[k];
  }
  return best;
}

}  // namespace detail::slice_centre

MSPSKEL_INLINE void flatten_slice(const SurfaceSnapshot& surface, SliceRegion& slice) {
  const Contour& contour = slice.contour;
  const auto count = static_cast<Index>(contour.point.size());
  const auto at_vertex = [&](Index i) {
    return slice.through != kNone && surface.target(contour.halfedge[i]) == slice.through;
  };
  // Every edge from the vertex's other side is crossed in the vertex itself: one point of the polygon.
  std::vector<Index> visits;
  std::vector<std::uint8_t> repeated(contour.point.size(), 0);
  bool before = count > 0 && at_vertex(count - 1);
  for (Index i = 0; i < count; ++i) {
    const bool here = at_vertex(i);
    repeated[i] = here && before;
    if (here && !before) visits.push_back(i);
    before = here;
  }
  const Index first = visits.empty() ? 0 : detail::slice_centre::first_visit(contour, visits);
  std::vector<Vector3> points;
  points.reserve(contour.point.size());
  for (Index k = 0; k < count; ++k) {
    const Index i = first + k < count ? first + k : first + k - count;
    if (k == 0 || !repeated[i]) points.push_back(contour.point[i]);
  }
  if (points.empty()) {
    slice.region = PlanarRegion();
    return;
  }
  slice.frame = make_plane_frame(points, slice.plane.normal);
  slice.region.set_outer(flatten(points, slice.frame));
}

MSPSKEL_INLINE bool may_have_holes(const SliceRegion& slice, const BoundingVolumeHierarchy& solid,
                                   const Vector2& from, int rays) {
  constexpr double kMargin = 1e-6;  // in perimeters: the same contour, found by two ways
  const double unit = slice.region.perimeter();
  const Vector3 origin = slice.frame.to_space(from);
  const auto free = [&](const Vector2& direction) {
    return unit * (slice.region.first_hit(from, unit * direction) - kMargin);
  };
  const std::vector<Vector2>& direction = even_directions(rays);
  for (int k = 0; k < rays / 2; ++k) {
    const Vector2& ahead = direction[k];
    const double back = free(-ahead), length = back + free(ahead);
    const Vector3 axis = ahead.x() * slice.frame.u + ahead.y() * slice.frame.v;
    if (solid.first_hit(origin - back * axis, axis, length)) return true;
  }
  return false;
}

namespace detail::slice_centre {

// Half-edges of the faces in the contour's box and on its plane that lead from the plane's negative to its
// positive side, ascending.
inline std::vector<Index> crossings_near(const SliceRegion& slice, const SurfaceSnapshot& surface,
                                         const BoundingVolumeHierarchy& solid) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : slice.contour.point) box.extend(p);
  const Vector3& n = slice.plane.normal;
  const auto positive = [&](Index v) {
    const Vector3& p = surface.position[v];
    // The sum in the order in which the tracer takes it, so that both see the same sign.
    return v == slice.through || (n.x() * p.x() + n.y() * p.y() + n.z() * p.z()) - slice.plane.offset >= 0;
  };
  std::vector<Index> starts;
  solid.for_each_in_box_on_plane(box.min(), box.max(), n, slice.plane.offset, [&](Index f) {
    const bool s[3] = {positive(surface.origin[3 * f]), positive(surface.origin[3 * f + 1]),
                       positive(surface.origin[3 * f + 2])};
    for (Index i = 0; i < 3; ++i)
      if (!s[i] && s[(i + 1) % 3]) starts.push_back(3 * f + i);
    return true;
  });
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
  return starts;
}

// Whether most of a polygon lies in the region, by a few of its points: contours of a plane may touch, but
// never cross.
inline bool mostly_inside(const std::vector<Vector2>& polygon, const PlanarRegion& region) {
  constexpr std::size_t kPoints = 9;
  const std::size_t points = std::min(kPoints, polygon.size());
  std::size_t inside = 0;
  for (std::size_t i = 0; i < points; ++i)
    inside += region.contains(polygon[i * polygon.size() / points]) ? 1 : 0;
  return 2 * inside > points;
}

}  // namespace detail::slice_centre

MSPSKEL_INLINE Index add_hole_contours(const SliceTracer& tracer, const BoundingVolumeHierarchy& solid,
                                       SliceRegion& slice) {
  const std::vector<Index> starts = detail::slice_centre::crossings_near(slice, tracer.surface(), solid);
  std::vector<bool> seen(starts.size(), false);
  const auto mark = [&](const Contour& contour) {
    for (const Index h : contour.halfedge) {
      const auto it = std::lower_bound(starts.begin(), starts.end(), h);
      if (it != starts.end() && *it == h) seen[static_cast<std::size_t>(it - starts.begin())] = true;
    }
  };
  mark(slice.contour);
  std::vector<std::pair<double, std::vector<Vector2>>> holes;  // by area
  Contour contour;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (seen[i]) continue;
    tracer.trace(starts[i], slice.plane, slice.through, contour);
    seen[i] = true;
    mark(contour);
    if (!(contour.area < 0)) continue;
    std::vector<Vector2> polygon = flatten(contour.point, slice.frame);
    if (detail::slice_centre::mostly_inside(polygon, slice.region))
      holes.emplace_back(contour.area, std::move(polygon));
  }
  // The largest first: a smaller one inside it belongs to an island.
  std::stable_sort(holes.begin(), holes.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Index count = 0;
  for (const auto& hole : holes) {
    if (!detail::slice_centre::mostly_inside(hole.second, slice.region)) continue;
    slice.region.add_hole(hole.second);
    ++count;
  }
  return count;
}

}  // namespace mspskel
