// Distances through the solid from a point in it to the vertices of its surface.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// Shortest ways along a surface, along edges and straight across pairs of faces. Keeps the surface by
// reference.
class SurfaceWays {
 public:
  // O(faces).
  explicit SurfaceWays(const SurfaceSnapshot& surface);

  // From the vertices that have a finite value in `distance` to the others of their component; those of other
  // components stay infinite. A value that is marked in `fixed` stays as it is. Cost: O(vertices log
  // vertices).
  void extend(const std::vector<std::uint8_t>& fixed, std::vector<double>& distance) const;

 private:
  const SurfaceSnapshot& surface_;
  std::vector<double> edge_;    // per half-edge: its length
  std::vector<double> across_;  // per half-edge: from its origin to the vertex across the edge opposite to it
};

// From one point a component of the surface: the length of the straight way to each of the component's
// vertices where the solid leaves it free, and of the shortest way on along the surface to the others. That
// is an upper bound of the inner distance (Ling and Jacobs 2007, "Shape classification using the
// inner-distance"). Infinity in components without a point. Cost: a segment query a vertex, then as above.
std::vector<double> inner_distances(const SurfaceSnapshot& surface, const SurfaceWays& ways,
                                    const BoundingVolumeHierarchy& solid,
                                    const std::vector<std::optional<Vector3>>& from,
                                    const Execution& execution = {});

// The same from one point to the given vertices only, by ways among them. `distance` has a place for every
// vertex of the surface; those of the others have to be minus infinity, and stay so. Cost: a segment query a
// vertex, O(vertices log vertices).
void inner_distances(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                     const Vector3& from, const std::vector<Index>& vertices, std::vector<double>& distance);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/inner_distance_impl.h"
#endif
