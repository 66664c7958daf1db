// Which limbs a shape has, told from its surface alone: the tips that a skeleton's leaves have to reach.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/graph/limb_measures.h"
#include "mspskel/graph/shells.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

struct LimbTip {
  Index vertex = kNone;                // the one farthest from the middle of the shape
  Vector3 position = Vector3::Zero();  // of that vertex on the surface on which the tip was found
  // The mean of the surface at the very end, or `position` where that is not well inside the solid.
  Vector3 target = Vector3::Zero();
  // Its depth: how far the vertex is beyond where the limb meets what is farther still.
  LimbMeasures measures;
  std::vector<Index> cap;  // the end: the outer half of that depth, and at most 1.5 half widths
};

// The maxima of the inner distance from the middle of each component, as far as they are limbs: where the
// parts of the surface beyond a distance grow together as the distance falls, the limbs that they stand for
// meet, so a limb is as deep as its maximum is persistent (Edelsbrunner, Letscher and Zomorodian 2002,
// "Topological persistence and simplification"). Noise moves no depth by more than twice its size, and the
// surface's triangles do not matter. A limb is deeper than 2.5 smallest features, a thin one than 3.4, and
// is_limb; in a component that has limbs, is_ear will do. What reaches farthest counts where something else
// does, and its end is measured where it meets the first other limb. A limb across the way to another one is
// measured less than its length; what goes round a handle has a maximum too, though no limb. None lies in the
// wall of a shell. In a component of genus 0 without limbs the ends of its longest way are tips of depth 0.
// Cost: a segment query a vertex, O(vertices log vertices).
std::vector<LimbTip> find_limb_tips(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                    const VertexSlices& slices, const LimbOptions& options,
                                    const Execution& execution = {});

// Drops the tips that lie in a wall of a shell, where what reaches farthest is any place of the rim: those
// whose ends are less than 0.45 half widths thick on either side of the middle.
void drop_tips_in_walls(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                        const std::vector<bool>& shells, std::vector<LimbTip>& tips);

// Per component of the surface, whether one of the tips is a limb's: those of depth 0 are not.
std::vector<bool> components_with_limbs(const SurfaceSnapshot& surface, const std::vector<LimbTip>& tips);

// The tips as vertices of a coarser surface, whose vertex each vertex merged into.
std::vector<LimbTip> on_coarser_surface(std::vector<LimbTip> tips, const std::vector<Index>& coarse_vertex);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/graph/detail/limb_tips_impl.h"
#endif
