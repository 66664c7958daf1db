// What a border between parts costs at each edge of a surface.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct CreaseOptions {
  // An edge in a crease of angle x (concave, radians) costs 1 / (1 + crease * x) of its length; [0, 100].
  double crease = 16.0;
  // How far a rounded crease may spread and count as one, as a share of the square root of the surface's
  // area; [0, 1].
  double width = 0.006;
};

// Throws UsageError naming the option.
void validate(const CreaseOptions& options);

// Per half-edge, the same for both of an edge. The angle is that between the smoothed normals of both sides:
// the faces' normals after a step of diffusion over `width`, so that finer faces give the same angles.
// O(faces^1.5) for the sparse factors.
std::vector<double> border_costs(const SurfaceSnapshot& surface, const CreaseOptions& options = {});

}  // namespace mspskel
