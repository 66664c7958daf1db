// Results of components, each extracted in a frame of its own, as the result for the whole surface.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mspskel/extract_skeleton.h"

namespace mspskel {
namespace detail {

// From the frame of a component to that of the whole: x ↦ scale · x + shift.
struct FrameChange {
  double scale = 1.0;
  Vector3 shift = Vector3::Zero();

  FrameChange(const NormalisedFrame& from, const NormalisedFrame& to)
      : scale(from.scale / to.scale), shift((from.origin - to.origin) / to.scale) {}
  Vector3 operator()(const Vector3& x) const { return scale * x + shift; }
  void apply(std::vector<Vector3>& points) const {
    for (Vector3& x : points) x = (*this)(x);
  }
};

// The component's place in the whole: where its numbers go.
struct ComponentPlace {
  Index component = kNone;
  const std::vector<Index>& vertex;  // of the whole, per vertex of the component
  const std::vector<Index>& face;    // of the whole, per face of the component
  FrameChange change;

  Index halfedge(Index h) const { return h == kNone ? kNone : 3 * face[h / 3] + h % 3; }
};

template <class Value>
void scatter(const std::vector<Value>& part, const std::vector<Index>& place, std::vector<Value>& whole) {
  for (std::size_t v = 0; v < part.size(); ++v) whole[place[v]] = part[v];
}
inline void scatter_scaled(const std::vector<double>& part, double scale, const std::vector<Index>& place,
                           std::vector<double>& whole) {
  for (std::size_t v = 0; v < part.size(); ++v) whole[place[v]] = scale * part[v];
}

inline void join_slices(const VertexSlices& part, const ComponentPlace& place, VertexSlices& whole) {
  const double scale = place.change.scale;
  scatter_scaled(part.perimeter, scale, place.vertex, whole.perimeter);
  scatter_scaled(part.half_width, scale, place.vertex, whole.half_width);
  scatter_scaled(part.area, scale * scale, place.vertex, whole.area);
  for (std::size_t v = 0; v < part.start.size(); ++v) {
    whole.start[place.vertex[v]] = place.halfedge(part.start[v]);
    if (part.valid[v]) whole.centre[place.vertex[v]] = place.change(part.centre[v]);
  }
  scatter(part.normal, place.vertex, whole.normal);
  scatter(part.error, place.vertex, whole.error);
  scatter(part.contour_points, place.vertex, whole.contour_points);
  scatter(part.valid, place.vertex, whole.valid);
  scatter(part.refined, place.vertex, whole.refined);
  whole.slices += part.slices;
  whole.steps += part.steps;
}

inline void join_points(const SkeletonMesh& part, const ComponentPlace& place, SkeletonMesh& whole) {
  const double scale = place.change.scale;
  for (std::size_t v = 0; v < part.position.size(); ++v)
    whole.position[place.vertex[v]] = place.change(part.position[v]);
  scatter_scaled(part.perimeter, scale, place.vertex, whole.perimeter);
  scatter_scaled(part.area, scale * scale, place.vertex, whole.area);
  scatter(part.normal, place.vertex, whole.normal);
  scatter(part.error, place.vertex, whole.error);
  scatter(part.valid, place.vertex, whole.valid);
  for (std::size_t k = 0; k < part.stops.size(); ++k) whole.stops[k] += part.stops[k];
  whole.without_slice += part.without_slice;
  whole.with_holes += part.with_holes;
  whole.iterations += part.iterations;
}

// Component i of the part's labels is component i + `first` of the whole's.
inline CocycleLabel shifted(const CocycleLabel& label, Index first) {
  CocycleLabel result;
  for (const auto& [index, value] : label.entries()) result += CocycleLabel::unit(index + first, value);
  return result;
}

inline void join_cocycles(VolumeCocycles part, const ComponentPlace& place, VolumeCocycles& whole) {
  for (std::size_t h = 0; h < part.label.size(); ++h)
    if (!part.label[h].is_zero())
      whole.label[place.halfedge(static_cast<Index>(h))] = shifted(part.label[h], whole.rank);
  if (!part.image.empty() || !whole.image.empty()) {
    for (auto i = static_cast<Index>(whole.image.size()); i < static_cast<Index>(whole.cocycle.size()); ++i)
      whole.image.push_back(CocycleLabel::unit(i));
    for (Index i = 0; i < static_cast<Index>(part.cocycle.size()); ++i)
      whole.image.push_back(shifted(part.image_of(i), whole.rank));
  }
  for (SmallHandle handle : part.small_handles)
    whole.small_handles.push_back({place.change.scale * handle.length, place.change(handle.at)});
  for (VolumeCocycle& cocycle : part.cocycle) {
    cocycle.component = place.component;
    for (auto& [h, value] : cocycle.values) h = place.halfedge(h);
    cocycle.plane.offset =
        place.change.scale * cocycle.plane.offset + cocycle.plane.normal.dot(place.change.shift);
    for (Contour& contour : cocycle.contours) {
      place.change.apply(contour.point);
      contour.perimeter *= place.change.scale;
      contour.area *= place.change.scale * place.change.scale;
      for (Index& h : contour.halfedge) h = place.halfedge(h);
    }
    place.change.apply(cocycle.loop);
    whole.cocycle.push_back(std::move(cocycle));
  }
  whole.rank += part.rank;
  whole.genus[place.component] = part.genus.empty() ? 0 : part.genus.front();
  whole.discs += part.discs;
  whole.holed_regions += part.holed_regions;
  whole.linking += part.linking;
  whole.completions += part.completions;
  whole.contours_traced += part.contours_traced;
  whole.sections += part.sections;
}

inline void add_counts(const CollapseCounts& part, CollapseCounts& whole) {
  whole.collapses += part.collapses;
  whole.one_dimensional_collapses += part.one_dimensional_collapses;
  whole.refused_labels += part.refused_labels;
  whole.refused_loop += part.refused_loop;
  whole.listed += part.listed;
  whole.parked += part.parked;
  whole.reopened += part.reopened;
  whole.parallel_collapses += part.parallel_collapses;
  whole.thinned_faces += part.thinned_faces;
  whole.deleted_faces += part.deleted_faces;
  whole.deleted_edges += part.deleted_edges;
  whole.queue_operations += part.queue_operations;
}

inline void add_counts(const RefinementCounts& part, RefinementCounts& whole) {
  whole.axes += part.axes;
  whole.paths += part.paths;
  whole.pruned += part.pruned;
  whole.joints_merged += part.joints_merged;
  whole.completed += part.completed;
  whole.zips += part.zips;
  whole.corners += part.corners;
  whole.routing.hubs_moved += part.routing.hubs_moved;
  whole.routing.routed += part.routing.routed;
  whole.routing.unroutable += part.routing.unroutable;
  whole.classes.checked += part.classes.checked;
  whole.classes.routed += part.classes.routed;
  whole.classes.abandoned += part.classes.abandoned;
}

inline void add_counts(const CycleRank& part, CycleRank& whole) {
  whole.cycles += part.cycles;
  whole.rank += part.rank;
}

// Before the component's cocycles are joined: `first_cocycle` is the number of those before.
inline void join_collapsed(const CollapsedSkeleton& part, const ComponentPlace& place, Index first_cocycle,
                           CollapsedSkeleton& whole) {
  const auto first = static_cast<Index>(whole.nodes.size());
  const double scale = place.change.scale;
  for (CollapsedNode node : part.nodes) {
    node.position = place.change(node.position);
    node.area *= scale * scale;
    node.perimeter *= scale;
    node.set.move(scale, place.change.shift);
    whole.nodes.push_back(std::move(node));
  }
  for (const CollapsedEdge& edge : part.edges)
    whole.edges.push_back({edge.first + first, edge.second + first, shifted(edge.label, first_cocycle)});
  for (std::size_t v = 0; v < part.node_of_vertex.size(); ++v)
    if (part.node_of_vertex[v] != kNone)
      whole.node_of_vertex[place.vertex[v]] = part.node_of_vertex[v] + first;
  for (std::size_t v = 0; v < part.label_of_vertex.size(); ++v)
    whole.label_of_vertex[place.vertex[v]] = shifted(part.label_of_vertex[v], first_cocycle);
  add_counts(part.counts, whole.counts);
}

inline void join_skeleton(const CurveSkeleton& part, const ComponentPlace& place, CurveSkeleton& whole) {
  const auto first = static_cast<Index>(whole.nodes.size());
  whole.nodes.insert(whole.nodes.end(), part.nodes.begin(), part.nodes.end());
  for (const auto& [a, b] : part.edges) whole.edges.push_back({a + first, b + first});
  for (std::size_t v = 0; v < part.node_of_vertex.size(); ++v)
    if (part.node_of_vertex[v] != kNone)
      whole.node_of_vertex[place.vertex[v]] = part.node_of_vertex[v] + first;
}

inline void join_seconds(const std::vector<std::pair<std::string, double>>& part,
                         std::vector<std::pair<std::string, double>>& whole) {
  for (const auto& [stage, time] : part) {
    std::size_t k = 0;
    while (k < whole.size() && whole[k].first != stage) ++k;
    if (k == whole.size()) whole.emplace_back(stage, 0.0);
    whole[k].second += time;
  }
}

inline void join_work(const ExtractResult& part, ExtractResult& whole) {
  whole.filter.dropped_branches += part.filter.dropped_branches;
  whole.filter.dropped_nodes += part.filter.dropped_nodes;
  whole.filter.combined_joints += part.filter.combined_joints;
  whole.filter.refused_joints += part.filter.refused_joints;
  add_counts(part.refinement, whole.refinement);
  add_counts(part.cycles, whole.cycles);
  whole.digits += part.digits;
  join_seconds(part.seconds, whole.seconds);
  whole.warnings.insert(whole.warnings.end(), part.warnings.begin(), part.warnings.end());
}

// Room for every vertex, half-edge and component.
inline void make_room(ExtractResult& whole) {
  const Index n = whole.surface.vertex_count();
  whole.slices.resize(n);
  whole.initial_slices.resize(n);
  SkeletonMesh& mesh = whole.skeleton_mesh;
  mesh.position = whole.surface.position;  // what has no component stays where it is
  mesh.perimeter.assign(n, 0.0);
  mesh.normal.assign(n, Vector3::Zero());
  mesh.error.assign(n, 1.0);
  mesh.area.assign(n, 0.0);
  mesh.valid.assign(n, 0);
  whole.cocycles.label.resize(whole.surface.halfedge_count());
  whole.cocycles.genus.assign(whole.surface.component_count, 0);
  whole.collapsed.node_of_vertex.assign(n, kNone);
  whole.collapsed.label_of_vertex.resize(n);
  whole.skeleton.node_of_vertex.assign(n, kNone);
}

// `part` is that of the component named in `place`.
inline void join_component(ExtractResult part, const ComponentPlace& place, ExtractResult& whole) {
  join_slices(part.initial_slices, place, whole.initial_slices);
  join_slices(part.slices, place, whole.slices);
  join_points(part.skeleton_mesh, place, whole.skeleton_mesh);
  join_collapsed(part.collapsed, place, whole.cocycles.rank, whole.collapsed);
  join_cocycles(std::move(part.cocycles), place, whole.cocycles);
  join_skeleton(part.skeleton, place, whole.skeleton);
  join_work(part, whole);
}

}  // namespace detail
}  // namespace mspskel
