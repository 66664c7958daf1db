// Handles too small for a cycle of their own: scans and voxel surfaces are full of them.
#pragma once

#include "mspskel/base/progress.h"
#include "mspskel/collapse/volume_cocycles.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// Leaves out the handles round which loops shorter than `share` (0 to 1) of their component's extent run
// along edges of the surface: the labels become those of the solid in which such loops are filled. What they
// tell apart is told apart in the solid too, and the rank falls by the number of independent classes of such
// loops, which are listed in `small_handles`. A thin handle that closes a long way round is not small: no
// short loop goes round it that the solid cannot fill.
//
// Returns false and changes nothing where crossings with regions would have to be added to linking numbers.
// Cost: a tree of shortest paths within half that length for each vertex at an edge with a label. Throws
// Cancelled.
bool leave_out_small_handles(const SurfaceSnapshot& surface, double share, VolumeCocycles& cocycles,
                             const ProgressCallback& progress = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/small_handles_impl.h"
#endif
