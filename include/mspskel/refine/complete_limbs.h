// Limbs that the skeleton misses get an arc: the surface tells which parts no maximal ball comes near.
#pragma once

#include "mspskel/arcs/route_inside.h"
#include "mspskel/arcs/zip_arcs.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/refine/aim_ends.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {

// Leads an arc to every tip that no leaf arc represents. Then, with f the distance of the surface outside the
// balls round the arcs' points, takes the parts that protrude in f and are as slender as a digit, or no
// blunter than a right-angled cone and as slender as a limb, or are bumps: fins, noses and bosses, as deep as
// their mouth is wide, bulging from it, and no wider than the ball that carries them. Each gets an arc to its
// top from the nearest point of the skeleton (straight where that is free, else along the middle of the
// solid), the deepest first, and all is measured again, until no part is left that reaches 3.5 smallest
// features, or as far as a thin ball is wide, beyond all balls. It is the law of find_limb_tips with another
// distance, and that of find_uncovered_parts, so what the report would call uncovered has been tried. At last
// what is as deep and slender as a limb that has an arc, on something as thick, gets one as well. Where
// `inner` is of an input, parts of few vertices need no other evidence, and points just below the surface
// show a way where no path leads out. A new arc is a leaf, so the homotopy type stays. It takes the vertices
// that it covers better, and its end becomes a tip as well. Returns the number of arcs added. Cost:
// O(vertices · points) once, then O(vertices · points of the arc + vertices log vertices) and a few queries
// an arc tried.
Index complete_limbs(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                     std::vector<LimbTip>& tips, const LimbOptions& options, double step);
// On the surface and in the solid of `inner`, with its paths.
Index complete_limbs(ArcGraph& graph, detail::InnerGraph& inner, std::vector<LimbTip>& tips,
                     const LimbOptions& options, double step, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/complete_limbs_impl.h"
#endif
