#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/detail/flat_regions.h"
#include "mspskel/collapse/detail/linking_cocycles.h"

namespace mspskel {
MSPSKEL_INLINE CrossingLabels::CrossingLabels(const VolumeCocycles& cocycles, int attempt) {
  const detail::View view(detail::view_direction(attempt));
  u_ = view.u, v_ = view.v, d_ = view.d;
  parts_.resize(static_cast<std::size_t>(cocycles.rank));
  for (const VolumeCocycle& cocycle : cocycles.cocycle) {
    Row row{
        cocycles.image_of(static_cast<Index>(rows_.size())), cocycle.contours.empty(), cocycle.plane, {}, {}};
    for (const auto& entry : row.image.entries()) parts_[entry.index] = {cocycle.component, row.is_loop};
    const detail::PlaneFrame frame(cocycle.plane.normal);
    for (const Contour& contour : cocycle.contours) {
      Outline& outline = row.outlines.emplace_back();
      for (const Vector3& p : contour.point) {
        outline.point.push_back(frame(p));
        outline.box.extend(outline.point.back());
      }
    }
    for (const Vector3& p : cocycle.loop) row.loop.push_back(view(p));
    rows_.push_back(std::move(row));
  }
  index_regions(cocycles);
  index_loops();
}

MSPSKEL_INLINE void CrossingLabels::index_regions(const VolumeCocycles& cocycles) {
  for (Index i = 0; i < static_cast<Index>(rows_.size()); ++i) {
    if (rows_[i].is_loop || rows_[i].image.is_zero()) continue;
    Eigen::AlignedBox3d box;
    for (const Vector3& p : cocycles.cocycle[i].contours.front().point) box.extend(p);
    regions_.add(i, box.min(), box.max());
  }
  regions_.build();
}

MSPSKEL_INLINE void CrossingLabels::index_loops() {
  constexpr double kEndless = 1e3;  // model extents
  for (Index i = 0; i < static_cast<Index>(rows_.size()); ++i) {
    if (rows_[i].image.is_zero()) continue;
    const std::vector<Vector3>& loop = rows_[i].loop;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      Eigen::AlignedBox3d box(loop[k]);
      box.extend(loop[k + 1 == loop.size() ? 0 : k + 1]);
      loop_boxes_.add(static_cast<Index>(loop_edges_.size()), box.min(), box.max());
      box.min().z() = -kEndless;
      box.max().z() = kEndless;
      loops_.add(static_cast<Index>(loop_edges_.size()), box.min(), box.max());
      loop_edges_.push_back({i, static_cast<Index>(k)});
    }
  }
  loops_.build();
  loop_boxes_.build();
}

// +1 from the plane's negative to its positive side.
MSPSKEL_INLINE int CrossingLabels::region_crossing(const Row& row, const Vector3& a, const Vector3& b) {
  const double from = row.plane.signed_distance(a), to = row.plane.signed_distance(b);
  if ((from >= 0) == (to >= 0)) return 0;
  const Eigen::Vector2d x = detail::PlaneFrame(row.plane.normal)(a + from / (from - to) * (b - a));
  bool inside = false;
  for (const Outline& outline : row.outlines)
    if (outline.box.contains(x)) inside = inside != detail::inside_polygon(outline.point, x);
  return !inside ? 0 : to >= 0 ? 1 : -1;
}

MSPSKEL_INLINE CocycleLabel CrossingLabels::label(const Vector3& a, const Vector3& b, bool below,
                                                  bool& clear) const {
  CocycleLabel result;
  regions_.in_box(a.cwiseMin(b), a.cwiseMax(b), [&](Index i) {
    const int value = region_crossing(rows_[i], a, b);
    if (value != 0) result += rows_[i].image * value;
  });
  if (loop_edges_.empty()) return result;
  const Vector3 va = in_view(a), vb = in_view(b);
  loops_.in_box(va.cwiseMin(vb), va.cwiseMax(vb), [&](Index e) {
    const std::vector<Vector3>& loop = rows_[loop_edges_[e].row].loop;
    const auto k = static_cast<std::size_t>(loop_edges_[e].point);
    detail::CrossingCount count;
    if (!detail::count_crossing(loop[k], loop[k + 1 == loop.size() ? 0 : k + 1], va, vb, count))
      clear = false;
    const std::int64_t value = below ? -count.below : count.above;
    if (value != 0) result += rows_[loop_edges_[e].row].image * static_cast<std::int32_t>(value);
  });
  return result;
}

MSPSKEL_INLINE CocycleLabel CrossingLabels::along(const std::vector<Vector3>& points) const {
  CocycleLabel label;
  if (rows_.empty()) return label;
  for (std::size_t i = 1; i < points.size(); ++i) label += (*this)(points[i - 1], points[i]);
  return label;
}

MSPSKEL_INLINE Vector3 CrossingLabels::in_view(const Vector3& p) const {
  return {u_.dot(p), v_.dot(p), d_.dot(p)};
}

MSPSKEL_INLINE bool CrossingLabels::may_link(const std::vector<Vector3>& points) const {
  if (loop_edges_.empty()) return false;
  Eigen::AlignedBox3d box;
  for (const Vector3& p : points) box.extend(in_view(p));
  bool any = false;
  loop_boxes_.in_box(box.min(), box.max(), [&](Index) { any = true; });
  return any;
}

MSPSKEL_INLINE bool CrossingLabels::goes_round(const std::vector<Vector3>& ring) const {
  if (rows_.empty() || ring.empty()) return false;
  const auto next = [&](std::size_t i) -> const Vector3& { return ring[i + 1 == ring.size() ? 0 : i + 1]; };
  Vector3 low = ring.front(), high = ring.front();
  for (const Vector3& p : ring) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  CocycleLabel label;
  regions_.in_box(low, high, [&](Index row) {
    const Plane& plane = rows_[row].plane;
    const bool positive = plane.signed_distance(ring.front()) >= 0;
    // Most planes near a ring miss it.
    if (std::all_of(ring.begin() + 1, ring.end(),
                    [&](const Vector3& p) { return (plane.signed_distance(p) >= 0) == positive; }))
      return;
    int sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) sum += region_crossing(rows_[row], ring[i], next(i));
    if (sum != 0) label += rows_[row].image * sum;
  });
  if (!label.is_zero() || !may_link(ring)) return !label.is_zero();
  bool clear = true;
  for (std::size_t i = 0; i < ring.size(); ++i) label += (*this)(ring[i], next(i), clear);
  return !clear || !label.is_zero();
}

}  // namespace mspskel
