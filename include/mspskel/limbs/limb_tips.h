// Which limbs a shape has, told from its surface alone: the tips that a skeleton's leaves have to reach.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/limbs/limb_measures.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/vertex_slices.h"
#include "mspskel/solid/shells.h"

namespace mspskel {

enum class TipKind {
  kLimb,
  kEar,      // a bump much smaller than what carries it
  kBodyEnd,  // where the axis of what is left without the limbs ends, and no limb does
  kFlatEnd,  // where a tube was cut off
  kWayEnd,   // of the longest way in a component without limbs
};

struct LimbTip {
  TipKind kind = TipKind::kLimb;
  Index vertex = kNone;                // the one farthest from the middle of the shape
  Vector3 position = Vector3::Zero();  // of that vertex on the surface on which the tip was found
  // The mean of the surface at the very end, or `position` where that is not well inside the solid.
  Vector3 target = Vector3::Zero();
  // Its depth: how far the vertex is beyond where the limb is most slender; of a body's end, from the middle;
  // of a flat end its radius.
  LimbMeasures measures;
  std::vector<Index> cap;    // the end: the outer half of that depth, and at most 1.2 half widths
  std::vector<Index> plate;  // all of the limb where it is a plate: its corners are no limbs
  std::vector<Index> head;   // in whose middle it ends, as a pole does in a disc: its bumps are no limbs
  // A wing or a leaf, thin as it may be: it is as slender as a finger and does not widen to its end, and the
  // middle of its surface lies in the solid, other than that of a wall which bends round a hollow.
  bool is_lobe = false;
  // The radius of the flat cap in which it ends, as of a tube that was cut off, or that of the neck behind
  // the squat head in whose middle it ends; or 0.
  double flat_end = 0.0;
};

// The limbs of each component. A limb is what lies beyond a maximum of the inner distance from the middle, as
// far down as it is most slender: on a tube that is its root, where the area jumps. Maxima are followed until
// one that is farther takes them over (the persistence of Edelsbrunner, Letscher and Zomorodian 2002,
// "Topological persistence and simplification") or the part is half of the component, so no limb is measured
// by another one. Areas and mouths are those of the surface beyond the level, with the triangles cut. It has
// to be deeper than 1.5 smallest features (as much smaller as what carries it is thin) and 1.5 edges of the
// surface (a twig of few triangles: as slender as a finger, and two radii of its mouth deep, where it meets
// another part), be open at one place only (what goes round a handle is open at two; what of it ends before
// may be a limb), and satisfy is_limb; in a component that has limbs or whose body ends in tips, is_ear will
// do. None lies in the wall of a shell.
// A plate that reaches beyond its root to one side, as the back or an arm of a chair does, is one limb or
// none by its height on that root, and its corners are none. A body that is longer than wide has tips where
// it ends and no limb does, and so has one with handles and without limbs along the axis that stands apart.
// Where a tube was cut off, its flat cap is an end, however near the next joint. In a component of genus 0
// without limbs the ends of its longest way are tips. Cost: a segment query a vertex, a few rays a face of
// plates, O(vertices log vertices).
std::vector<LimbTip> find_limb_tips(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                    const VertexSlices& slices, const LimbOptions& options,
                                    const Execution& execution = {});

// Drops the tips that lie in a wall of a shell, where what reaches farthest is any place of the rim: those
// that are less than 0.45 half widths thick on either side of the middle, at their ends and in the median.
void drop_tips_in_walls(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                        const std::vector<bool>& shells, std::vector<LimbTip>& tips);

// Per component of the surface, whether one of the tips is a limb's, an ear's or a flat end.
std::vector<bool> components_with_limbs(const SurfaceSnapshot& surface, const std::vector<LimbTip>& tips);

// The tips as vertices of a coarser surface, whose vertex each vertex merged into.
std::vector<LimbTip> on_coarser_surface(std::vector<LimbTip> tips, const std::vector<Index>& coarse_vertex);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/limbs/detail/limb_tips_impl.h"
#endif
