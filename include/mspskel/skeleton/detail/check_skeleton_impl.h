#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "mspskel/base/even_directions.h"
#include "mspskel/base/linkage.h"
#include "mspskel/mesh/mesh_report.h"
#include "mspskel/skeleton/detail/placed_skeleton.h"

namespace mspskel {
namespace detail {

inline double mean(const std::vector<double>& values) {
  return values.empty()
             ? 0.0
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const std::size_t rank =
      std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

struct SkeletonSample {
  Index component = kNone;
  bool inside = false;
  Vector3 position = Vector3::Zero();
  double radius = 0.0;
  double off_centre = -1.0;  // negative: not measured
};

// |Σ r d| / Σ r over 24 rays across the tangent, or -1 where a ray escapes.
inline double off_centre(const BoundingVolumeHierarchy& hierarchy, const Vector3& p, const Vector3& tangent) {
  constexpr int kRays = 24;
  // Where the fan starts is a convention, by the axes of the file; it matters little, but decides whether
  // figures from several tools compare.
  const Vector3 axis = std::abs(tangent.x()) < 0.7 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 u = tangent.cross(axis).normalized(), w = tangent.cross(u);
  std::array<double, kRays> r;
  hierarchy.ray_fan(p, u, w, kRays, r.data());
  const std::vector<Vector2>& direction = even_directions(kRays);
  double sum = 0.0;
  Vector3 moment = Vector3::Zero();
  for (int k = 0; k < kRays; ++k) {
    sum += r[k];
    moment += r[k] * (direction[k].x() * u + direction[k].y() * w);
  }
  return std::isfinite(sum) && sum > 0 ? moment.norm() / sum : -1.0;
}

// Samples in the middle of equal steps of at most `spacing` along each edge; the nodes if there is no edge.
// Every second sample of an edge gets its off-centre measure.
inline std::vector<SkeletonSample> sample_skeleton(const PlacedSkeleton& placed, double spacing,
                                                   const Execution& execution) {
  struct Place {
    Index node;  // at which its edge begins
    Vector3 position, tangent;
    bool measured;
  };
  const std::vector<Vector3>& node = placed.graph.position;
  std::vector<Place> places;
  for (const auto& [a, b] : placed.graph.edges) {
    const Vector3 d = node[b] - node[a];
    const double length = d.norm();
    const Vector3 tangent = length > 0 ? Vector3(d / length) : Vector3::UnitX();
    // An edge far beyond the model may not fill the memory: 100 diagonals are sampled as densely as asked.
    const Index steps = static_cast<Index>(std::min(40000.0, std::max(1.0, std::ceil(length / spacing))));
    for (Index i = 0; i < steps; ++i)
      places.push_back({a, node[a] + (i + 0.5) / steps * d, tangent, i % 2 == 0});
  }
  if (placed.graph.edges.empty())
    for (std::size_t i = 0; i < node.size(); ++i)
      places.push_back({static_cast<Index>(i), node[i], Vector3::UnitX(), false});
  std::vector<SkeletonSample> samples(places.size());
  parallel_for(
      static_cast<Index>(places.size()), "check", execution, [] { return 0; },
      [&](Index i, int&) {
        const Place& place = places[i];
        const BoundingVolumeHierarchy& hierarchy = placed.solid_of(place.node);
        SkeletonSample& s = samples[i];
        s.component = placed.graph.component[place.node];
        s.position = place.position;
        s.inside = hierarchy.inside(place.position);
        if (!s.inside) return;
        s.radius = hierarchy.distance(place.position);
        if (place.measured) s.off_centre = off_centre(hierarchy, place.position, place.tangent);
      });
  return samples;
}

// Distances from every stride-th vertex to the union of the balls of its component's samples.
inline std::vector<double> cover_distances(const SurfaceSnapshot& snapshot,
                                           const std::vector<SkeletonSample>& samples, double diagonal,
                                           const Execution& execution) {
  const Index stride = std::max<Index>(1, snapshot.vertex_count() / 2000);
  std::vector<double> cover((snapshot.vertex_count() + stride - 1) / stride);
  parallel_for(
      static_cast<Index>(cover.size()), "check", execution, [] { return 0; },
      [&](Index i, int&) {
        const Index component = snapshot.component[i * stride];
        double best = diagonal;
        for (const SkeletonSample& s : samples)
          if (s.inside && (component == kNone || s.component == component))
            best = std::min(best, (snapshot.position[i * stride] - s.position).norm() - s.radius);
        cover[i] = std::max(0.0, best);
      });
  return cover;
}

// Leaf branches that end at a joint inside the solid and whose tip lies in that joint's maximal ball.
inline Index count_spurs(const PlacedSkeleton& placed, const std::vector<std::vector<Index>>& next,
                         const std::vector<Branch>& all) {
  const std::vector<Vector3>& node = placed.graph.position;
  Index spurs = 0;
  for (const Branch& branch : all) {
    Index tip = branch.nodes.front(), joint = branch.nodes.back();
    if (next[tip].size() != 1) std::swap(tip, joint);
    const BoundingVolumeHierarchy& hierarchy = placed.solid_of(joint);
    if (next[tip].size() != 1 || next[joint].size() < 3 || !hierarchy.inside(node[joint])) continue;
    spurs += (node[tip] - node[joint]).norm() < hierarchy.distance(node[joint]);
  }
  return spurs;
}

inline double mean_turning(const std::vector<Vector3>& node, const std::vector<Branch>& all, double spacing) {
  std::vector<double> turning;
  for (const Branch& branch : all) {
    std::vector<Vector3> path{node[branch.nodes[0]]};
    for (const Index k : branch.nodes)
      if ((node[k] - path.back()).norm() >= spacing) path.push_back(node[k]);
    for (std::size_t k = 1; k + 1 < path.size(); ++k) {
      const Vector3 in = path[k] - path[k - 1], out = path[k + 1] - path[k];
      turning.push_back(std::atan2(in.cross(out).norm(), in.dot(out)) * 180 / kPi);
    }
  }
  return mean(turning);
}

inline void check_topology(const SurfaceSnapshot& snapshot, const CurveSkeleton& skeleton,
                           SkeletonChecks& checks) {
  MeshReport surface;
  measure_components(snapshot, surface);
  checks.components = snapshot.component_count;
  checks.genus = surface.genus;
  const GraphCounts counts = count_graph(skeleton);
  checks.b0 = counts.components;
  checks.b1 = counts.cycles;
  checks.topology = checks.b0 == checks.components && checks.b1 == checks.genus;
  checks.nodes = counts.nodes;
  checks.edges = counts.edges;
  checks.leaves = counts.leaves;
  checks.joints = counts.joints;
  checks.length = counts.length / checks.diagonal;
}

inline void check_containment(const PlacedSkeleton& placed, const CurveSkeleton& skeleton, double scale,
                              SkeletonChecks& checks) {
  const double diagonal = checks.diagonal / scale;
  const std::vector<Vector3>& node = placed.graph.position;
  for (Index i = 0; i < static_cast<Index>(node.size()); ++i) {
    const BoundingVolumeHierarchy& hierarchy = placed.solid_of(i);
    if (!hierarchy.inside(node[i])) ++checks.outside_nodes;
    checks.radius_error =
        std::max(checks.radius_error,
                 std::abs(skeleton.nodes[i].radius / scale - hierarchy.distance(node[i])) / diagonal);
  }
  for (const auto& [a, b] : skeleton.edges) {
    checks.longest_edge = std::max(checks.longest_edge, (node[a] - node[b]).norm() / diagonal);
    if (placed.solid_of(a).segment_crosses(node[a], node[b])) ++checks.crossing_edges;
  }
  checks.contained = checks.outside_nodes == 0 && checks.crossing_edges == 0;
}

}  // namespace detail

MSPSKEL_INLINE void validate(const CurveSkeleton& skeleton) {
  const Index n = static_cast<Index>(skeleton.nodes.size());
  for (Index i = 0; i < n; ++i)
    if (!skeleton.nodes[i].position.allFinite() || !std::isfinite(skeleton.nodes[i].radius))
      throw UsageError("skeleton node " + std::to_string(i) + " is not finite");
  for (std::size_t e = 0; e < skeleton.edges.size(); ++e) {
    const auto& [a, b] = skeleton.edges[e];
    if (a < 0 || b < 0 || a >= n || b >= n || a == b)
      throw UsageError("skeleton edge " + std::to_string(e) + " joins " + std::to_string(a) + " and " +
                       std::to_string(b) + ", of " + std::to_string(n) + " nodes");
  }
  for (std::size_t v = 0; v < skeleton.node_of_vertex.size(); ++v)
    if (skeleton.node_of_vertex[v] < kNone || skeleton.node_of_vertex[v] >= n)
      throw UsageError("vertex " + std::to_string(v) + " maps to node " +
                       std::to_string(skeleton.node_of_vertex[v]) + ", of " + std::to_string(n) + " nodes");
}

MSPSKEL_INLINE SkeletonChecks check_skeleton(const SurfaceSnapshot& snapshot,
                                             const BoundingVolumeHierarchy& hierarchy,
                                             const CurveSkeleton& skeleton, const Execution& execution) {
  return check_skeleton(snapshot, SolidHierarchies(snapshot, hierarchy, execution.progress), skeleton,
                        execution);
}

MSPSKEL_INLINE SkeletonChecks check_skeleton(const SurfaceSnapshot& snapshot, const SolidHierarchies& solids,
                                             const CurveSkeleton& skeleton, const Execution& execution) {
  validate(skeleton);
  if (skeleton.nodes.empty()) throw NoSkeletonError("the skeleton has no nodes");
  SkeletonChecks checks;
  const double diagonal = bounding_box_diagonal(snapshot);  // normalised, like all that follows
  checks.diagonal = diagonal * snapshot.frame.scale;
  detail::check_topology(snapshot, skeleton, checks);

  const detail::PlacedSkeleton placed(snapshot, solids, skeleton);
  detail::check_containment(placed, skeleton, snapshot.frame.scale, checks);

  const auto samples = detail::sample_skeleton(placed, 0.0025 * diagonal, execution);
  std::vector<double> off_centre;
  Index inside = 0;
  for (const detail::SkeletonSample& s : samples) {
    inside += s.inside;
    if (s.off_centre >= 0) off_centre.push_back(s.off_centre);
  }
  checks.inside = static_cast<double>(inside) / static_cast<double>(samples.size());
  checks.centredness_samples = static_cast<Index>(off_centre.size());
  checks.off_centre_mean = detail::mean(off_centre);
  checks.off_centre_p90 = detail::quantile(off_centre, 0.9);

  const auto cover = detail::cover_distances(snapshot, samples, diagonal, execution);
  checks.cover_mean = detail::mean(cover) / diagonal;
  checks.cover_p95 = detail::quantile(cover, 0.95) / diagonal;

  const auto all = branches(skeleton);
  checks.spurs = detail::count_spurs(placed, adjacency(skeleton), all);
  checks.bend = detail::mean_turning(placed.graph.position, all, 0.01 * diagonal);
  return checks;
}

}  // namespace mspskel
