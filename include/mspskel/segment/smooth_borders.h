// Short, smooth borders between the parts of a surface.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct BorderOptions {
  // How far a border may move, in radii of a circle of its length; [0, 10]. 0 leaves it as it is.
  double width = 0.5;
  // An edge in a crease of angle x (concave, radians) costs 1 / (1 + crease * x) of its length; [0, 100].
  double crease = 8.0;
};

// Throws UsageError naming the option.
void validate(const BorderOptions& options);

// For each two parts that touch, in the order of their numbers: the cheapest border within a band about the
// present one, a minimum cut of the faces' dual graph. Faces beyond the band stay, and so does a border whose
// band would swallow a part. Writes `part_of_face`. Cost: a maximum flow in each band.
void smooth_borders(const SurfaceSnapshot& surface, std::vector<Index>& part_of_face,
                    const BorderOptions& options = {});

// Makes the faces of each part hang together across edges: the piece of the largest area stays, and every
// other goes to the part with which it shares the longest border. A piece that touches no other part, since
// it is a component of the surface, stays. O(faces) a round; there are few rounds.
void connect_parts(const SurfaceSnapshot& surface, std::vector<Index>& part_of_face);

}  // namespace mspskel
