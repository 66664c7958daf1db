// Arcs into the digits of hands and feet.
#pragma once

#include "mspskel/arcs/merge_joints.h"
#include "mspskel/base/progress.h"
#include "mspskel/refine/find_digits.h"
#include "mspskel/refine/prune_branches.h"

namespace mspskel {

// Leads an arc into every digit in which none ends: from the nearest point of the skeleton that lies behind
// the digit and sees its base, by the digit's way, centred on its own. A leaf that ends before the digit is
// led on into it instead. The digit's vertices, which are those of `surface` and the graph, go to its arc.
// The homotopy type stays: arcs are leaf arcs, and joints merge as in merge_joints. Digits within the ball of
// where their arcs begin get none. Returns the number of arcs added. Cost: O(points of the graph + vertices)
// and some dozen queries a digit. Throws Cancelled.
Index reach_digits(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                   const std::vector<Digit>& digits, double step, double joint_overlap,
                   const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/reach_digits_impl.h"
#endif
