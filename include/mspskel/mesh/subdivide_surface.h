// The same surface with its long edges cut: what the stages walk on where the input is sparse, as surfaces
// from CAD are.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct SubdivisionOptions {
  // A component of as many is left as it is: its small faces are where its details are. [1, 2^31)
  Index enough = 1600;
  // Another one is given so many vertices at most. An edge of a prism wants them all along it, and the
  // coarsening that follows takes back what is too many side by side. [1, 2^31)
  Index most_added = 16'000;
  // All components together. One of many is given its even share of it at most. [1, 2^31)
  Index most_added_in_all = 20'000;
  double longest = 0.03;  // edge that is left as it is, as a share of the extent of its component. (0, 1]
};

// Throws UsageError naming the option that is out of range.
void validate(const SubdivisionOptions& options);

struct SubdividedSurface {
  SurfaceSnapshot surface;  // in the frame of the input
  std::vector<Index>
      vertex;  // per input vertex its number there; kNone for isolated ones, which are left out
  Index cuts = 0;
};

// Whether there is an edge to cut. O(edges).
bool has_long_edge(const SurfaceSnapshot& surface, const SubdivisionOptions& options = {});

// Cuts edges in their middles, the longest first (bisection of edges: Rivara 1984, "Mesh refinement processes
// based on the generalized bisection of simplices"), until none of those in components to be cut is too long
// or the component has been given as many vertices as it may be. The surface as a set of points stays. The
// input's vertices come first, in their order. Edges of one length go by number. Lengths rather than lengths
// for the local thickness: with those thin limbs got vertices and blocks beside them none, and limbs were
// lost.
//
// O(edges of the result · log). Throws UsageError, Cancelled.
SubdividedSurface subdivide_surface(const SurfaceSnapshot& input, const SubdivisionOptions& options = {},
                                    const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/subdivide_surface_impl.h"
#endif
