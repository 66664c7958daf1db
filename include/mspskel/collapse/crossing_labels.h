// Labels of segments inside the solid: the volume cocycles read off the geometry instead of the surface's
// edges.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mspskel/collapse/detail/flat_regions.h"
#include "mspskel/collapse/detail/linking_cocycles.h"
#include "mspskel/collapse/volume_cocycles.h"

namespace mspskel {

// Signed crossings of a segment with the region of each cocycle (disc, flat region with holes), or its share
// of the linking number with the cocycle's loop. Along a closed polyline inside the solid the labels add up
// to the values of the cocycles on its homology class; on a single segment they mean nothing.
//
// Holds the regions' outlines; the cocycles may go. const and safe to share between threads.
class CrossingLabels {
 public:
  // `attempt` picks the direction along which loops are looked at (linking numbers only).
  explicit CrossingLabels(const VolumeCocycles& cocycles, int attempt = 0);

  Index rank() const { return static_cast<Index>(rows_.size()); }
  // The component of the surface that cocycle i belongs to.
  Index component(Index i) const { return rows_[i].component; }

  // Label of the way from a to b. `clear` is set to false where rounding leaves a doubt, else left alone.
  // Cost: O(rank + crossings of the regions' outlines whose plane is met).
  CocycleLabel operator()(const Vector3& a, const Vector3& b, bool& clear) const;
  CocycleLabel operator()(const Vector3& a, const Vector3& b) const {
    bool clear = true;
    return (*this)(a, b, clear);
  }

  // Labels by the crossings below the loops (negated) instead of those above; equal round every closed
  // polyline, which is the check on rounding. The same for regions.
  CocycleLabel from_below(const Vector3& a, const Vector3& b, bool& clear) const {
    return label(a, b, true, clear);
  }

 private:
  struct Row {
    Index component;
    bool is_loop;
    Plane plane;
    std::vector<std::vector<Eigen::Vector2d>> outlines;  // of a region, in the plane
    std::vector<Vector3> loop;                           // in view coordinates
  };

  CocycleLabel label(const Vector3& a, const Vector3& b, bool below, bool& clear) const;
  static int region_crossing(const Row& row, const Vector3& a, const Vector3& b);
  static std::int64_t loop_crossing(const Row& row, const Vector3& a, const Vector3& b, bool below,
                                    bool& clear);

  detail::View view_;
  std::vector<Row> rows_;
};

inline CrossingLabels::CrossingLabels(const VolumeCocycles& cocycles, int attempt)
    : view_(detail::view_direction(attempt)) {
  for (const VolumeCocycle& cocycle : cocycles.cocycle) {
    Row row{cocycle.component, cocycle.contours.empty(), cocycle.plane, {}, {}};
    const detail::PlaneFrame frame(cocycle.plane.normal);
    for (const Contour& contour : cocycle.contours) {
      row.outlines.emplace_back();
      for (const Vector3& p : contour.point) row.outlines.back().push_back(frame(p));
    }
    for (const Vector3& p : cocycle.loop) row.loop.push_back(view_(p));
    rows_.push_back(std::move(row));
  }
}

// +1 from the plane's negative to its positive side.
inline int CrossingLabels::region_crossing(const Row& row, const Vector3& a, const Vector3& b) {
  const double from = row.plane.signed_distance(a), to = row.plane.signed_distance(b);
  if ((from >= 0) == (to >= 0)) return 0;
  const Eigen::Vector2d x = detail::PlaneFrame(row.plane.normal)(a + from / (from - to) * (b - a));
  bool inside = false;
  for (const auto& outline : row.outlines) inside = inside != detail::inside_polygon(outline, x);
  return !inside ? 0 : to >= 0 ? 1 : -1;
}

inline std::int64_t CrossingLabels::loop_crossing(const Row& row, const Vector3& a, const Vector3& b,
                                                  bool below, bool& clear) {
  detail::CrossingCount count;
  for (std::size_t i = 0, n = row.loop.size(); i < n; ++i)
    if (!detail::count_crossing(row.loop[i], row.loop[i + 1 == n ? 0 : i + 1], a, b, count)) clear = false;
  return below ? -count.below : count.above;
}

inline CocycleLabel CrossingLabels::label(const Vector3& a, const Vector3& b, bool below, bool& clear) const {
  CocycleLabel result;
  const Vector3 va = view_(a), vb = view_(b);
  for (Index i = 0; i < rank(); ++i) {
    const Row& row = rows_[i];
    const std::int64_t value =
        row.is_loop ? loop_crossing(row, va, vb, below, clear) : region_crossing(row, a, b);
    if (value != 0) result += CocycleLabel::unit(i, static_cast<std::int32_t>(value));
  }
  return result;
}

inline CocycleLabel CrossingLabels::operator()(const Vector3& a, const Vector3& b, bool& clear) const {
  return label(a, b, false, clear);
}

}  // namespace mspskel
