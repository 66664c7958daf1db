// What a border between parts costs at each edge of a surface.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct CreaseOptions {
  // An edge in a crease of angle x (concave, radians) costs 1 / (1 + crease * x) of its length; [0, 100].
  double crease = 16.0;
  // Half of the stretch across an edge whose turn is its angle, as a share of the square root of the
  // surface's area: a rounded crease that is no wider counts like a sharp one; [0, 1]. Both sides together
  // span nearly two faces of a surface of 1,600 vertices: angles do not depend on how it was coarsened.
  double width = 0.014;
};

// Throws UsageError naming the option.
void validate(const CreaseOptions& options);

// Per half-edge, the same for both of an edge. The angle is by how much the surface turns across the edge
// within twice `width`, or about the distance between faces where that is more: the angle between the normals
// of both faces, after a step of diffusion over `width`, for the way between their middles, so that finer and
// coarser faces give the same angles. `where` marks the faces that creases are looked for among; other edges
// cost their length. Empty: all. Throws UsageError. O(faces), and as many rounds of conjugate gradients as
// `width` has faces.
std::vector<double> border_costs(const SurfaceSnapshot& surface, const CreaseOptions& options = {},
                                 const std::vector<char>& where = {});

}  // namespace mspskel
