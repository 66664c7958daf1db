#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE CrossingLabels::CrossingLabels(const VolumeCocycles& cocycles, int attempt) {
  parts_.resize(static_cast<std::size_t>(cocycles.rank));
  for (const VolumeCocycle& cocycle : cocycles.cocycle) {
    Row row{cocycles.image_of(static_cast<Index>(rows_.size())), cocycle.contours.empty(), cocycle.plane,
            detail::PlaneFrame(cocycle.plane.normal)};
    for (const auto& entry : row.image.entries()) parts_[entry.index] = {cocycle.component, row.is_loop};
    rows_.push_back(std::move(row));
  }
  index_regions(cocycles);
  index_loops(cocycles, attempt);
  index_borders(cocycles);
}

MSPSKEL_INLINE void CrossingLabels::index_regions(const VolumeCocycles& cocycles) {
  for (Index i = 0; i < static_cast<Index>(rows_.size()); ++i) {
    const Row& row = rows_[i];
    if (row.is_loop || row.image.is_zero()) continue;
    std::vector<detail::Polygon2> outlines;
    for (const Contour& contour : cocycles.cocycle[i].contours) {
      detail::Polygon2& outline = outlines.emplace_back();
      for (const Vector3& p : contour.point) outline.push_back(row.frame(p));
    }
    detail::tile_region(outlines, [&](detail::RegionTile tile) {
      using Corner = Eigen::AlignedBox2d::CornerType;
      Eigen::AlignedBox3d box;
      for (const Corner at : {Corner::BottomLeft, Corner::BottomRight, Corner::TopLeft, Corner::TopRight})
        box.extend(row.frame.point(tile.box().corner(at)) + row.plane.offset * row.plane.normal);
      regions_.add(static_cast<Index>(tiles_.size()), box.min(), box.max());
      tiles_.push_back({i, std::move(tile)});
    });
  }
  regions_.build();
}

MSPSKEL_INLINE void CrossingLabels::index_loops(const VolumeCocycles& cocycles, int attempt) {
  constexpr double kGolden = 0.6180339887498949;  // its multiples fall between each other
  for (Index i = 0; i < static_cast<Index>(rows_.size()); ++i) {
    const std::vector<Vector3>& loop = cocycles.cocycle[i].loop;
    if (rows_[i].image.is_zero()) continue;
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
  for (Filling& filling : filling_) filling.boxes.build();
}

MSPSKEL_INLINE void CrossingLabels::index_borders(const VolumeCocycles& cocycles) {
  for (Index i = 0; i < static_cast<Index>(rows_.size()); ++i) {
    if (rows_[i].image.is_zero()) continue;
    const auto add = [&](const std::vector<Vector3>& border) {
      for (std::size_t k = 0, last = border.size() - 1; k < border.size(); last = k++) {
        const Vector3 &a = border[last], &b = border[k];
        border_boxes_.add(static_cast<Index>(border_edges_.size()), a.cwiseMin(b), a.cwiseMax(b));
        border_edges_.push_back({i, a, b});
      }
    };
    add(cocycles.cocycle[i].loop);
    for (const Contour& contour : cocycles.cocycle[i].contours) add(contour.point);
  }
  border_boxes_.build();
}

// +1 from the plane's negative to its positive side.
MSPSKEL_INLINE int CrossingLabels::region_crossing(const Tile& tile, const Vector3& a,
                                                   const Vector3& b) const {
  const Row& row = rows_[tile.row];
  const double from = row.plane.signed_distance(a), to = row.plane.signed_distance(b);
  if ((from >= 0) == (to >= 0)) return 0;
  const Eigen::Vector2d x = row.frame(a + from / (from - to) * (b - a));
  if (!tile.region.holds(x) || !tile.region.inside(x)) return 0;
  return to >= 0 ? 1 : -1;
}

MSPSKEL_INLINE CocycleLabel CrossingLabels::label(const Vector3& a, const Vector3& b, const Filling& filling,
                                                  const std::vector<Index>* rows, bool& clear) const {
  const auto is_wanted = [&](Index row) {
    return rows == nullptr || std::binary_search(rows->begin(), rows->end(), row);
  };
  CocycleLabel result;
  const Vector3 low = a.cwiseMin(b), high = a.cwiseMax(b);
  regions_.in_box(low, high, [&](Index i) {
    const Tile& tile = tiles_[i];
    if (!is_wanted(tile.row)) return;
    const int value = region_crossing(tile, a, b);
    if (value != 0) result += rows_[tile.row].image * value;
  });
  filling.boxes.in_box(low, high, [&](Index i) {
    const LoopTriangle& triangle = filling.triangles[i];
    if (!is_wanted(triangle.row)) return;
    const std::optional<int> value = detail::crossing_of(triangle.corner, a, b);
    if (!value)
      clear = false;
    else if (*value != 0)
      result += rows_[triangle.row].image * *value;
  });
  return result;
}

MSPSKEL_INLINE CocycleLabel CrossingLabels::along(const std::vector<Vector3>& points) const {
  CocycleLabel label;
  if (rows_.empty()) return label;
  for (std::size_t i = 1; i < points.size(); ++i) label += (*this)(points[i - 1], points[i]);
  return label;
}

MSPSKEL_INLINE std::vector<Index> CrossingLabels::rows_near(const Vector3& low, const Vector3& high) const {
  std::vector<Index> rows;
  border_boxes_.in_box(low, high, [&](Index i) {
    const auto& [row, a, b] = border_edges_[i];
    if (detail::segment_may_meet_box(a, b, low, high) && (rows.empty() || rows.back() != row))
      rows.push_back(row);
  });
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

MSPSKEL_INLINE bool CrossingLabels::goes_round(const std::vector<Vector3>& ring) const {
  if (rows_.empty() || ring.empty()) return false;
  Vector3 low = ring.front(), high = ring.front();
  for (const Vector3& p : ring) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const std::vector<Index> near = rows_near(low, high);
  if (near.empty()) return false;
  CocycleLabel sum;
  bool clear = true;
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++)
    sum += label(ring[last], ring[i], filling_[0], &near, clear);
  return !clear || !sum.is_zero();
}

}  // namespace mspskel
