#pragma once

#include <algorithm>
#include <limits>

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/detail/components_around.h"
#include "mspskel/mesh/self_intersection.h"

namespace mspskel {
namespace detail {

MSPSKEL_INLINE void measure_components(const SurfaceSnapshot& s, MeshReport& r) {
  r.components.resize(s.component_count);
  for (Index v = 0; v < s.vertex_count(); ++v) {
    if (s.component[v] == kNone)
      ++r.isolated_vertices;
    else
      ++r.components[s.component[v]].vertices;
  }
  for (Index f = 0; f < s.face_count(); ++f) {
    ComponentReport& c = r.components[s.component[s.origin[3 * f]]];
    const Vector3 normal = s.face_normal_times_twice_area(f);
    ++c.faces;
    c.area += normal.norm() / 2;
    c.signed_volume += normal.dot(s.position[s.origin[3 * f]]) / 6;
  }
  for (ComponentReport& c : r.components) {
    c.edges = c.faces / 2 * 3;
    c.genus = (2 - (c.vertices - c.edges + c.faces)) / 2;
    r.edges += c.edges;
    r.genus += c.genus;
    r.area += c.area;
    r.signed_volume += c.signed_volume;
  }
}

inline void measure_edges(const SurfaceSnapshot& s, MeshReport& r) {
  r.shortest_edge = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (Index f = 0; f < s.face_count(); ++f) {
    double longest = 0.0;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const double length = s.edge_length(h);
      longest = std::max(longest, length);
      r.shortest_edge = std::min(r.shortest_edge, length);
      sum += length;
    }
    r.longest_edge = std::max(r.longest_edge, longest);
    if (!(s.face_normal_times_twice_area(f).norm() > 1e-12 * longest * longest)) ++r.degenerate_faces;
  }
  r.mean_edge = sum / s.halfedge_count();
}

// Which component lies inside which: a vertex of the one against a hierarchy of the other.
inline void find_nesting(const SurfaceSnapshot& s, const ProgressCallback& progress, MeshReport& r) {
  const Index n = s.component_count;
  if (n < 2) return;
  const std::vector<std::vector<Index>> around =
      components_around(s, faces_of_components(s), component_boxes(s), progress);
  for (Index c = 0; c < n; ++c) r.components[c].depth = static_cast<Index>(around[c].size());
  for (Index c = 0; c < n; ++c) {
    for (const Index outer : around[c]) {
      Index& direct = r.components[c].directly_inside;
      if (direct == kNone || r.components[outer].depth > r.components[direct].depth) direct = outer;
    }
    if (r.components[c].depth % 2 == 1) ++r.cavities;
  }
}

inline void to_model_units(double scale, MeshReport& r) {
  for (double* length : {&r.diagonal, &r.shortest_edge, &r.mean_edge, &r.longest_edge}) *length *= scale;
  r.area *= scale * scale;
  r.signed_volume *= scale * scale * scale;
  for (ComponentReport& c : r.components) {
    c.area *= scale * scale;
    c.signed_volume *= scale * scale * scale;
  }
}

}  // namespace detail

MSPSKEL_INLINE void validate(const MeshReportOptions& options) {
  if (options.self_intersection_limit < 0) throw UsageError("self_intersection_limit must not be negative");
}

MSPSKEL_INLINE double bounding_box_diagonal(const SurfaceSnapshot& snapshot) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : snapshot.position) box.extend(p);
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

MSPSKEL_INLINE MeshReport report_mesh(const SurfaceSnapshot& snapshot,
                                      const BoundingVolumeHierarchy& hierarchy,
                                      const MeshReportOptions& options, const Execution& execution) {
  validate(options);
  MeshReport report;
  report.vertices = snapshot.vertex_count();
  report.faces = snapshot.face_count();
  report.diagonal = bounding_box_diagonal(snapshot);
  detail::measure_components(snapshot, report);
  detail::measure_edges(snapshot, report);
  detail::find_nesting(snapshot, execution.progress, report);
  if (options.self_intersection_limit > 0)
    report.self_intersections =
        count_self_intersections(snapshot, hierarchy, options.self_intersection_limit, execution);
  detail::to_model_units(snapshot.frame.scale, report);
  return report;
}

MSPSKEL_INLINE MeshReport report_mesh(const SurfaceSnapshot& snapshot, const MeshReportOptions& options,
                                      const Execution& execution) {
  return report_mesh(snapshot, BoundingVolumeHierarchy(snapshot), options, execution);
}

}  // namespace mspskel
