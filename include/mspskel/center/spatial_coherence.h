// Spatial coherence (thesis 6.2, Fig. 6.1): skeletal points of low confidence move to their neighbours of
// high confidence.
#pragma once

#include "mspskel/center/skeleton_mesh.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct CoherenceOptions {
  bool enabled = true;
  // α: weight of the neighbours against a point's own confidence of at most 1; 0 to 10. Much more draws all
  // points of a ring to its middle, which is outside.
  double strength = 2.0;
};

inline void validate(const CoherenceOptions& o) {
  if (!(o.strength >= 0 && o.strength <= 10)) throw UsageError("coherence strength must be from 0 to 10");
}

// Replaces the skeletal points s by the solution x of (C + αL) x = C s, with C the diagonal of confidences
// and L the graph Laplacian of the mesh with rows divided by the valence: one sparse solve. More of it, or
// repeated, turns medial sheets into membranes and pulls arcs off centre. Cost: a sparse Cholesky
// factorisation, about O(vertices^1.5); of more than 20,000 vertices or 128 handles steps of O(vertices).
void apply_spatial_coherence(const SurfaceSnapshot& surface, const CoherenceOptions& options,
                             SkeletonMesh& mesh);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/center/detail/spatial_coherence_impl.h"
#endif
