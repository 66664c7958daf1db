// Labels of a surface's edges, carried over to a coarser surface of it.
#pragma once

#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/cocycle_label.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct CoarseLabels {
  std::vector<CocycleLabel> halfedge;  // per half-edge of the coarser surface
  // Per vertex of the input: the label of a way to it from the first vertex of its class, within the class.
  // Empty where all labels are zero.
  std::vector<CocycleLabel> within;
};

// Each coarse vertex stands for a class of input vertices that is connected and, since a coarsening keeps the
// surface's homotopy type, simply so: any way within a class has the same label, and so have all edges
// between two classes. The label of a coarse edge is that of a way between the first vertices of its classes.
// `halfedge_label` is per half-edge of `input`; `coarse_vertex` per vertex of it, kNone for isolated ones.
// Cost: O(faces · degree).
CoarseLabels carry_labels_over(const SurfaceSnapshot& input, const std::vector<CocycleLabel>& halfedge_label,
                               const SurfaceSnapshot& coarse, const std::vector<Index>& coarse_vertex);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/coarse_labels_impl.h"
#endif
