// Parts that were found on a coarser surface, on the input.
#pragma once

#include <vector>

#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::detail {

// The skeleton with the map of the coarser surface: each of its vertices has the node of the input vertex
// nearest to it, of those that merged into it. O(vertices).
CurveSkeleton on_coarse_surface(const SurfaceSnapshot& surface, const CoarseSurface& coarse,
                                const CurveSkeleton& skeleton);

struct CarriedParts {
  std::vector<Index> part_of_face;  // of the input
  std::vector<char> near_border;    // per input face: whether coarse faces of several parts are round it
};

// Of each input face the part of the coarse face nearest to its middle, among those round the vertices that
// its corners merged into. O(faces).
CarriedParts carried_to_input(const SurfaceSnapshot& surface, const CoarseSurface& coarse,
                              const std::vector<Index>& part_of_coarse_face);

}  // namespace mspskel::detail
