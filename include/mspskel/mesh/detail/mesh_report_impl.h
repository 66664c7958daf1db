#pragma once

#include <algorithm>
#include <limits>

#include "mspskel/base/linkage.h"
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
      const double length = (s.position[s.target(h)] - s.position[s.origin[h]]).norm();
      longest = std::max(longest, length);
      r.shortest_edge = std::min(r.shortest_edge, length);
      sum += length;
    }
    r.longest_edge = std::max(r.longest_edge, longest);
    if (!(s.face_normal_times_twice_area(f).norm() > 1e-12 * longest * longest)) ++r.degenerate_faces;
  }
  r.mean_edge = sum / s.halfedge_count();
}

struct Box3 {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = Vector3::Constant(-std::numeric_limits<double>::infinity());
  void add(const Vector3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  bool contains(const Vector3& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};

// Which component lies inside which: a vertex of the one against a hierarchy of the other.
inline void find_nesting(const SurfaceSnapshot& s, MeshReport& r) {
  const Index n = s.component_count;
  if (n < 2) return;
  std::vector<std::vector<Index>> faces(n);
  std::vector<Box3> box(n);
  std::vector<Index> first(n, kNone);
  for (Index f = 0; f < s.face_count(); ++f) faces[s.component[s.origin[3 * f]]].push_back(f);
  for (Index v = s.vertex_count() - 1; v >= 0; --v)
    if (s.component[v] != kNone) {
      box[s.component[v]].add(s.position[v]);
      first[s.component[v]] = v;
    }
  std::vector<std::vector<Index>> around(n);
  for (Index outer = 0; outer < n; ++outer) {
    std::vector<Index> candidates;
    for (Index inner = 0; inner < n; ++inner)
      if (inner != outer && box[outer].contains(s.position[first[inner]])) candidates.push_back(inner);
    if (candidates.empty()) continue;
    const BoundingVolumeHierarchy hierarchy(s, faces[outer]);
    for (const Index inner : candidates)
      if (hierarchy.inside(s.position[first[inner]])) around[inner].push_back(outer);
  }
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
  detail::Box3 box;
  for (const Vector3& p : snapshot.position) box.add(p);
  return (box.high - box.low).norm();
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
  detail::find_nesting(snapshot, report);
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
