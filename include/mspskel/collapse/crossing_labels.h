// Labels of segments inside the solid: the volume cocycles read off the geometry instead of the surface's
// edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mspskel/collapse/detail/flat_regions.h"
#include "mspskel/collapse/detail/loop_filling.h"
#include "mspskel/collapse/detail/region_tiles.h"
#include "mspskel/collapse/volume_cocycles.h"
#include "mspskel/mesh/detail/box_index.h"

namespace mspskel {

// Signed crossings of a segment with the region of each cocycle (disc, flat region with holes), or with a
// surface that fills the cocycle's loop: its share of the linking number. Along a closed polyline inside the
// solid the labels add up to the values of the cocycles on its homology class; on a single segment they mean
// nothing.
//
// Holds the regions in tiles and the loops' surfaces, in hierarchies of boxes; the cocycles may go. const and
// safe to share between threads.
class CrossingLabels {
 public:
  // Rank 0: every label is zero.
  CrossingLabels() : CrossingLabels(VolumeCocycles{}) {}
  // `attempt` picks the surfaces that fill the loops (linking numbers only). Cost: O(n log n) for n points of
  // regions and loops.
  explicit CrossingLabels(const VolumeCocycles& cocycles, int attempt = 0);

  Index rank() const { return static_cast<Index>(parts_.size()); }
  // The component of the surface that entry i of the labels belongs to.
  Index component(Index i) const { return parts_[i].component; }
  // Whether entry i of the labels is crossings with flat regions of the solid.
  bool is_region(Index i) const { return !parts_[i].is_loop; }
  // Whether some cocycle is a linking number.
  bool has_loops() const { return !filling_[0].triangles.empty(); }

  // Label of the way from a to b. `clear` is set to false where rounding leaves a doubt, else left alone.
  // Cost: O(log rank) where no region and no loop's surface is near, and what is near.
  CocycleLabel operator()(const Vector3& a, const Vector3& b, bool& clear) const {
    return label(a, b, filling_[0], nullptr, clear);
  }
  CocycleLabel operator()(const Vector3& a, const Vector3& b) const {
    bool clear = true;
    return (*this)(a, b, clear);
  }
  // Sum along a polyline; zero for less than two points.
  CocycleLabel along(const std::vector<Vector3>& points) const;

  // Whether the closed polyline through the points has a label other than zero, or rounding hides it: no
  // disc fills it. Cost: O(log rank) where neither a loop nor the border of a region is near, else that of
  // the labels along it.
  bool goes_round(const std::vector<Vector3>& ring) const;

  // Labels by other surfaces that fill the loops; equal round every closed polyline, which is the check on
  // rounding. The same for regions.
  CocycleLabel by_other_surfaces(const Vector3& a, const Vector3& b, bool& clear) const {
    return label(a, b, filling_[1], nullptr, clear);
  }

 private:
  struct Row {
    CocycleLabel image;  // what a crossing counts as
    bool is_loop;
    Plane plane;  // of a region
    detail::PlaneFrame frame;
  };
  struct Part {
    Index component = kNone;
    bool is_loop = false;
  };
  struct Tile {
    Index row;
    detail::RegionTile region;
  };
  struct LoopTriangle {
    Index row;
    detail::FillingTriangle corner;
  };
  struct BorderEdge {  // of a row's loop, or of a contour of its region
    Index row;
    Vector3 a, b;
  };
  struct Filling {
    std::vector<LoopTriangle> triangles;
    detail::BoxIndex boxes;  // of triangles
  };

  void index_regions(const VolumeCocycles& cocycles);
  void index_loops(const VolumeCocycles& cocycles, int attempt);
  void index_borders(const VolumeCocycles& cocycles);
  // The rows whose loop, or border of a region, may pass through a closed polyline in the box, in which a
  // disc fills it; ascending.
  std::vector<Index> rows_near(const Vector3& low, const Vector3& high) const;
  // `rows`, ascending: of these alone.
  CocycleLabel label(const Vector3& a, const Vector3& b, const Filling& filling,
                     const std::vector<Index>* rows, bool& clear) const;
  int region_crossing(const Tile& tile, const Vector3& a, const Vector3& b) const;

  std::vector<Row> rows_;     // per cocycle
  std::vector<Part> parts_;   // per entry of the labels
  std::vector<Tile> tiles_;   // of regions
  detail::BoxIndex regions_;  // of tiles
  std::array<Filling, 2> filling_;
  std::vector<BorderEdge> border_edges_;
  detail::BoxIndex border_boxes_;  // of border edges
};

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/crossing_labels_impl.h"
#endif
