// Solids without limbs: a straight arc along the axis in place of what the collapse made of them.
#pragma once

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/arcs/route_inside.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// A block or a bust has no part that protrudes, so nothing in its slices tells one arc from another, and what
// the collapse leaves there depends on the triangulation. Its moments do not: every component of genus 0
// without a limb gets one arc through the centroid of its solid, along the principal axis that differs most
// from the other two. Where all three are about equal, as in a cube, or that one is the thickness of a plate,
// less than kLeastPieceLength of its extent, it gets one along the direction in which it is most like a box,
// across its sides. A prism that is longer than wide gets its axis though a corner of either end was told as
// a limb; of an open profile, whose centroid lies in air, it is the line in the middle of the nearest wall.
// Where else the centroid lies in a hollow, as in a glass or a goblet, the arc is what the line from the
// middle of the opening through the centroid has of the solid, in one piece: the stem, or the thickness of the
// floor. The arc ends half the middle ball's radius before the surface. Components where no such line is
// found, or one shorter than a millionth of the extent, stay as they are. `graph` and `tips` are of the
// vertices of `surface`; tips of depth 0 are no limbs. Returns the number of arcs laid.
// Cost: O(faces), a few queries a component, some thousand where it is hollow.
Index lay_axes(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
               const std::vector<LimbTip>& tips);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/lay_axes_impl.h"
#endif
