// A rig from a skeleton and its surface map.
#pragma once

#include "mspskel/base/progress.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/rig/rig.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

struct RigOptions {
  // So many joints, as far as the skeleton has nodes for them and something follows them; a limb has two at
  // least, so 2 leaves the root alone. 0: what the shape asks for, at most 40 and at least three a limb's end
  // up to 13.
  Index joints = 0;
  // How far a vertex on either side of a joint follows both bones, in half widths of the cross-section
  // there; [0, 10].
  double blend = 1.0;
};

// Throws UsageError naming the option.
void validate(const RigOptions& options);

// Joints where arcs meet, where they leave the ball of such a place, where they bend and where they end; the
// root is the one nearest the middle of the surface along the skeleton. Cycles are cut farthest from the
// root; pieces of the skeleton hang on the root of the largest. Each limb has a joint that bends it as a
// whole and that its tip follows more than the body; arcs that no vertex follows so have no joints. A vertex
// follows the bone beside it and, near a joint, the next one; what follows a joint changes along an edge of
// the surface by at most 0.9 of the edge's length over its distance from the joint, and about so over faces,
// so that no face turns over when the joint turns by 45 degrees. Names: "root"; "body3_1" is the first joint
// of the third stretch between junctions, "limb2_1" that of the second limb; where limbs mirror each other
// they end in _L and _R. docs/rigging.md has pictures. Throws UsageError for options out of range, a skeleton
// without nodes or one whose map does not fit the surface. O(nodes log nodes + joints * nodes + vertices log
// vertices). Throws Cancelled.
Rig make_rig(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton, const RigOptions& options = {},
             const ProgressCallback& progress = {});

}  // namespace mspskel
