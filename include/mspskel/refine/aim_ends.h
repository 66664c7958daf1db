// Leaf ends are aimed at the surface that they stand for, before anyone judges or grows them.
#pragma once

#include "mspskel/refine/prune_branches.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {

// Where slices lie along a limb instead of across it, as round tips and flat ends (terminal deviation,
// thesis 3.1), a leaf arc ends far from its part of the surface. From its end, or from its joint if it never
// leaves the joint's ball, each leaf arc is led straight towards the vertex that is farthest outside the
// balls of the skeleton, among those of its part that lie ahead of the tip, until the ball there touches it.
// Arcs whose part is covered, or whose target is out of sight, stay. Returns the number of arcs that changed.
// Cost: O(vertices on leaf arcs · points near them) and a few queries an arc.
Index aim_ends(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
               double step, const Execution& execution = {});

// Leaf arcs that stand for a limb's tip (leaves_of_tips) are led straight to its target from their last point
// that sees it, up to the one nearest to it, and along the middle of the solid from their joint where none
// does, as in a bent twig; those that end within `slack` half widths of the limb from it stay, or a quarter
// of its radius from the middle of a flat cap. With a slack the ends of arcs without joints are led there
// too, from a quarter of it on. The steps are shorter in limbs that are thin. Returns the hubs of the ends
// that moved. The graph's map and the tips are of the vertices of `inner`. Cost: O(vertices on leaf arcs), a
// few queries a tip, and a search along the limb for each that is out of sight.
std::vector<Index> aim_at_tips(ArcGraph& graph, detail::InnerGraph& inner, const std::vector<LimbTip>& tips,
                               double step, double slack = 0);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/aim_ends_impl.h"
#endif
