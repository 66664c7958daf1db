// What a surface is: its size, topology, pieces and flaws.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// One connected piece of the surface.
struct ComponentReport {
  Index vertices = 0, edges = 0, faces = 0;
  Index genus = 0;    // number of handles
  double area = 0.0;  // model units squared
  double signed_volume =
      0.0;  // model units cubed; positive if the normals point away from what the piece encloses
  Index directly_inside = kNone;  // the innermost other component around this one
  Index depth = 0;                // number of components around this one; odd: it bounds a cavity
};

struct MeshReport {
  Index vertices = 0, edges = 0, faces = 0;
  Index isolated_vertices = 0;
  Index genus = 0;     // sum over the components
  Index cavities = 0;  // components of odd depth
  std::vector<ComponentReport> components;
  double diagonal = 0.0;  // of the axis-parallel bounding box, model units
  double area = 0.0, signed_volume = 0.0;
  double shortest_edge = 0.0, mean_edge = 0.0, longest_edge = 0.0;  // model units
  Index degenerate_faces = 0;                                       // height below 1e-12 of the longest edge
  Index self_intersections = 0;  // pairs of faces, at most the limit that was asked for
};

struct MeshReportOptions {
  // Stop counting self-intersections here; 1 tells yes from no; 0 leaves them out. Range [0, 2^31).
  Index self_intersection_limit = 1000;
};

// Throws UsageError naming the option that is out of range.
void validate(const MeshReportOptions& options);

// Diagonal of the axis-parallel bounding box, in normalised units. O(vertices).
double bounding_box_diagonal(const SurfaceSnapshot& snapshot);

// O(faces log faces) for most surfaces; a component inside another is found by its first vertex, so the
// nesting of pieces that cross each other means nothing.
MeshReport report_mesh(const SurfaceSnapshot& snapshot, const BoundingVolumeHierarchy& hierarchy,
                       const MeshReportOptions& options = {}, const Execution& execution = {});
MeshReport report_mesh(const SurfaceSnapshot& snapshot, const MeshReportOptions& options = {},
                       const Execution& execution = {});

namespace detail {
// The counts, areas and volumes of a report, in normalised units.
void measure_components(const SurfaceSnapshot& snapshot, MeshReport& report);
}  // namespace detail

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/mesh_report_impl.h"
#endif
