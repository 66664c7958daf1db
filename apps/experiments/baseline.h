// The contraction baseline: mean curvature flow skeletons of CGAL, descendants of the method of Au et al.
// that the thesis compares with.
#pragma once

#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::experiments {

// Whether the program was built with CGAL (whose package for this is GPL).
bool has_baseline();

// CGAL's skeleton with its default options, radii and map left empty; without nodes where there is no
// baseline or the surface has more than one component, which CGAL does not take.
CurveSkeleton baseline_skeleton(const SurfaceSnapshot& surface);

}  // namespace mspskel::experiments
