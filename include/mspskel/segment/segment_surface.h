// The parts of a surface by its skeleton: the body, its limbs, their pieces.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/segment/border_costs.h"
#include "mspskel/segment/find_parts.h"
#include "mspskel/segment/split_at_creases.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

struct SegmentOptions {
  // parts.count is that of all parts; those of creases come after what the skeleton clearly shows and before
  // the rest of what it could be cut into.
  PartOptions parts;
  CreaseOptions creases;
  CreasePartOptions crease_parts;  // most and least follow from parts.count
  double border_width = 0.5;       // how far a border may move, in radii of a circle of its length; [0, 10]
  CoarseningOptions coarsening;    // of surfaces that come without a coarser one
};

struct Segmentation {
  std::vector<Index> part_of_face;  // 0 to count - 1, each on some face
  std::vector<Index> part_of_node;  // of the skeleton: the one with the most area of its faces; kNone: none
  Index count = 0;
};

// Where the vertices of different nodes meet: per triangle with two of them the line between the middles of
// its edges. Ascending by nodes. O(faces).
std::vector<NodeContact> node_contacts(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton);

// find_parts on the skeleton, its parts carried to the faces by the surface map, then smooth_borders,
// connect_parts and split_at_creases. All that runs on a coarser surface, where the input is finer than parts
// need: `coarse`, which extract_skeleton leaves in its result, or one that is made here. Its parts go to the
// nearest faces of the input, where borders settle within 0.6 of a coarse edge. Every part is connected
// across edges, and parts are numbered from the largest area to the smallest. Throws UsageError for options
// out of range or a skeleton whose map does not fit the surface, Cancelled. Cost: O(faces + parts * nodes^2)
// and a maximum flow about each border.
Segmentation segment_surface(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                             const SegmentOptions& options = {}, const CoarseSurface* coarse = nullptr,
                             const ProgressCallback& progress = {});

}  // namespace mspskel
