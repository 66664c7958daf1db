// The surfaces between the input and the one that the stages walk on, and the limbs told there.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "mspskel/extract_skeleton.h"

namespace mspskel {
namespace detail {

// Limbs are told on a surface between the input and the one that the other stages walk on: it shows smaller
// ones, and finding their tips costs little.
struct LimbSurface {
  std::optional<CoarseSurface> between;  // none: the input itself
  Index vertices = 0;                    // that `between` was to have
  std::vector<Index> coarse_vertex;      // per vertex of it; empty if nothing is coarsened
};

// From the input to the surface that the stages walk on, by way of the limb surface where that is coarser. A
// limb surface of an earlier call for the same input is taken up if it has as many vertices as the options
// ask for.
inline CoarseSurface coarsen_in_steps(const SurfaceSnapshot& input, const ExtractOptions& options,
                                      LimbSurface& limbs) {
  const bool steps =
      input.vertex_count() > options.limb_vertices && options.limb_vertices > options.coarsening.vertices;
  if (!steps || limbs.vertices != options.limb_vertices) limbs = {};
  if (steps && !limbs.between) {
    CoarseningOptions first = options.coarsening;
    first.vertices = limbs.vertices = options.limb_vertices;
    limbs.between = coarsen_surface(input, first, options.execution);
  }
  CoarseSurface coarse =
      coarsen_surface(limbs.between ? limbs.between->surface : input, options.coarsening, options.execution);
  limbs.coarse_vertex = coarse.coarse_vertex;
  if (!limbs.between) return coarse;
  coarse.coarse_vertex = carried_over(limbs.coarse_vertex, limbs.between->coarse_vertex, kNone);
  coarse.collapses += limbs.between->collapses;
  coarse.refused_topology += limbs.between->refused_topology;
  coarse.refused_shape += limbs.between->refused_shape;
  coarse.passes += limbs.between->passes;
  return coarse;
}

// `slices` are of the surface that the stages walk on, and so are the vertices of the tips.
inline std::vector<LimbTip> limb_tips(const SurfaceSnapshot& input, const LimbSurface& limbs,
                                      const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                      const LimbOptions& options, const Execution& execution) {
  if (limbs.coarse_vertex.empty()) return find_limb_tips(input, solid, slices, options, execution);
  const SurfaceSnapshot& surface = limbs.between ? limbs.between->surface : input;
  return on_coarser_surface(
      find_limb_tips(surface, solid, carried_over(slices, limbs.coarse_vertex), options, execution),
      limbs.coarse_vertex);
}

}  // namespace detail
}  // namespace mspskel
