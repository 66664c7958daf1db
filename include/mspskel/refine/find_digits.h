// Fingers, toes and the like: limbs too small for the surfaces on which other limbs are told, but plain from
// the palm that carries them.
#pragma once

#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/progress.h"
#include "mspskel/limbs/limb_measures.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct Digit {
  Vector3 tip = Vector3::Zero();  // the vertex farthest from the palm
  double length = 0.0;
  double radius = 0.0;  // of a tube of this length and the digit's area
  // From its base to its end: points in the middle of it.
  std::vector<Vector3> way;
  std::vector<Index> vertices;  // the tip first
};

// The digits at the ends of a graph's leaf arcs, those that an arc reaches as well. A palm is the widest
// place of a leaf arc 4 to 12 smallest features before its end. On the surface beyond it digits are the
// maxima of the inner distance from its middle, told by their persistence as limbs are (find_limb_tips); each
// goes as far down as it is most slender, before it meets another or the region's end, and is_digit. Two of
// them are no hand but a cleft (a hoof, a lip, a fish's tail): palms with fewer than three have none. `solid`
// names the surface's faces by the surface's numbers; what it has beyond these bounds cavities, where no
// digit ends. Cost: O(vertices) once a thread, and a segment query for each vertex beyond a palm where
// straight ways show digits.
std::vector<Digit> find_digits(const ArcGraph& graph, const SurfaceSnapshot& surface,
                               const BoundingVolumeHierarchy& solid, const LimbOptions& options,
                               const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/refine/detail/find_digits_impl.h"
#endif
