// The skeleton mesh: every vertex of the surface moved to its skeletal point (thesis 4.2.2).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/center/hole_contours.h"
#include "mspskel/center/skeletal_point.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

enum class HoleSearch {
  kIgnore,  // the slice's own contour alone, as the thesis has it
  // Look for holes where rays from the skeletal point meet something else than the contour: two opposite rays
  // everywhere, eight at the neighbours of slices with holes. Slices of a sponge, which are wide beside the
  // area that the surface has for each of its handles, get the point of what is seen of their region from the
  // vertex's chord: they have as many holes as their size is squared.
  kProbe,
  kAll,  // look for holes everywhere; costs the faces in the box round each slice
};

struct SkeletonMeshOptions {
  SkeletalPointOptions point;
  HoleSearch holes = HoleSearch::kIgnore;
  // Where holes are found. A vote among the minima of a ring scatters the points of neighbouring vertices all
  // round it.
  SkeletalPointMethod method_with_holes = SkeletalPointMethod::kNearestValley;
  // For the hole search; built here if there is none.
  const BoundingVolumeHierarchy* solid = nullptr;
};

// Throws UsageError naming the first option that is out of its range.
inline void validate(const SkeletonMeshOptions& options) { validate(options.point); }

// One entry a vertex, connectivity is the surface's; lengths in its normalised frame. A vertex without a
// slice has valid 0, perimeter 0, error 1 (no confidence), normal zero and the mean of the neighbours nearer
// to a valid vertex as its point; all of a component without any slice stay where they are on the surface.
struct SkeletonMesh {
  std::vector<Vector3> position;    // skeletal point
  std::vector<double> perimeter;    // MSP
  std::vector<Vector3> normal;      // of the slice, unit, of either sign
  std::vector<double> error;        // slice error, 0 to 1
  std::vector<double> area;         // of the surface that the vertex stands for: a third of its faces
  std::vector<std::uint8_t> valid;  // has a slice

  std::array<Index, kSkeletalPointStops> stops{};  // vertices by SkeletalPointStop
  Index without_slice = 0;
  Index with_holes = 0;          // slices in which holes were found or seen
  std::int64_t hole_points = 0;  // on the contours of those holes that were found
  std::int64_t iterations = 0;   // steps of all samples

  Index vertex_count() const { return static_cast<Index>(position.size()); }
};

// Traces every vertex's slice again and finds its skeletal point; for kCentre the slices hold it already.
// Cost: one trace and one find_skeletal_point a vertex; parallel over vertices, the same on any number of
// threads. Throws UsageError, Cancelled.
SkeletonMesh make_skeleton_mesh(const SliceTracer& tracer, const VertexSlices& slices,
                                const SkeletonMeshOptions& options = {}, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/center/detail/skeleton_mesh_impl.h"
#endif
