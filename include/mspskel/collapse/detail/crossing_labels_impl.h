#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/detail/flat_regions.h"

namespace mspskel {
MSPSKEL_INLINE CrossingLabels::CrossingLabels(const VolumeCocycles& cocycles, int attempt) {
  parts_.resize(static_cast<std::size_t>(cocycles.rank));
  for (const VolumeCocycle& cocycle : cocycles.cocycle) {
    Row row{cocycles.image_of(static_cast<Index>(rows_.size())), cocycle.contours.empty(), cocycle.plane, {}};
    for (const auto& entry : row.image.entries()) parts_[entry.index] = {cocycle.component, row.is_loop};
    const detail::PlaneFrame frame(cocycle.plane.normal);
    for (const Contour& contour : cocycle.contours) {
      Outline& outline = row.outlines.emplace_back();
      for (const Vector3& p : contour.point) {
        outline.point.push_back(frame(p));
        outline.box.extend(outline.point.back());
      }
    }
    rows_.push_back(std::move(row));
  }
  index_regions(cocycles);
  index_loops(cocycles, attempt);
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

MSPSKEL_INLINE void CrossingLabels::index_loops(const VolumeCocycles& cocycles, int attempt) {
  constexpr double kGolden = 0.6180339887498949;  // its multiples fall between each other
  for (Index i = 0; i < static_cast<Index>(rows_.size()); ++i) {
    const std::vector<Vector3>& loop = cocycles.cocycle[i].loop;
    if (rows_[i].image.is_zero() || loop.empty()) continue;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vector3 &p = loop[k], &q = loop[k + 1 == loop.size() ? 0 : k + 1];
      loop_edges_.add(i, p.cwiseMin(q), p.cwiseMax(q));
    }
    for (int which = 0; which < 2; ++which) {
      const double turn = kGolden * (2 * attempt + which);
      const auto start =
          static_cast<std::size_t>((turn - std::floor(turn)) * static_cast<double>(loop.size()));
      Filling& filling = filling_[which];
      detail::fill_polygon(loop, start, [&](const detail::FillingTriangle& t) {
        filling.boxes.add(static_cast<Index>(filling.triangles.size()), t[0].cwiseMin(t[1]).cwiseMin(t[2]),
                          t[0].cwiseMax(t[1]).cwiseMax(t[2]));
        filling.triangles.push_back({i, t});
      });
    }
  }
  loop_edges_.build();
  for (Filling& filling : filling_) filling.boxes.build();
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

MSPSKEL_INLINE CocycleLabel CrossingLabels::label(const Vector3& a, const Vector3& b, const Filling& filling,
                                                  bool& clear) const {
  CocycleLabel result;
  const Vector3 low = a.cwiseMin(b), high = a.cwiseMax(b);
  regions_.in_box(low, high, [&](Index i) {
    const int value = region_crossing(rows_[i], a, b);
    if (value != 0) result += rows_[i].image * value;
  });
  filling.boxes.in_box(low, high, [&](Index i) {
    const std::optional<int> value = detail::crossing_of(filling.triangles[i].corner, a, b);
    if (!value)
      clear = false;
    else if (*value != 0)
      result += rows_[filling.triangles[i].row].image * *value;
  });
  return result;
}

MSPSKEL_INLINE CocycleLabel CrossingLabels::along(const std::vector<Vector3>& points) const {
  CocycleLabel label;
  if (rows_.empty()) return label;
  for (std::size_t i = 1; i < points.size(); ++i) label += (*this)(points[i - 1], points[i]);
  return label;
}

MSPSKEL_INLINE bool CrossingLabels::may_link(const Vector3& low, const Vector3& high) const {
  bool any = false;
  loop_edges_.in_box(low, high, [&](Index) { any = true; });
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
  if (!label.is_zero() || !may_link(low, high)) return !label.is_zero();
  bool clear = true;
  for (std::size_t i = 0; i < ring.size(); ++i) label += (*this)(ring[i], next(i), clear);
  return !clear || !label.is_zero();
}

}  // namespace mspskel
