#pragma once

#include <algorithm>
#include <limits>

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/detail/moment_frame.h"

namespace mspskel {
namespace detail {

// The nodes in an order that does not depend on how the surface lies or is stored.
inline std::vector<Index> order_by_place(const std::vector<CollapsedNode>& nodes) {
  std::vector<Vector3> points;
  for (const CollapsedNode& node : nodes) points.push_back(node.position);
  return spatial_order(points, moment_frame(points, [&](std::size_t i) { return nodes[i].area; }));
}

// Walks the chains of a multigraph and writes them as arcs; remembers which arc each inner node is on. Later
// stages take hubs and arcs by their numbers where nothing else tells them apart, so these follow the place.
class ArcTracer {
 public:
  explicit ArcTracer(const CollapsedSkeleton& collapsed)
      : collapsed_(collapsed),
        order_(order_by_place(collapsed.nodes)),
        at_(collapsed.nodes.size()),
        hub_(collapsed.nodes.size(), kNone),
        arc_(collapsed.nodes.size(), kNone),
        used_(collapsed.edges.size(), false) {
    for (Index e = 0; e < static_cast<Index>(collapsed.edges.size()); ++e) {
      at_[collapsed.edges[e].first].push_back(e);
      at_[collapsed.edges[e].second].push_back(e);
    }
    std::vector<Index> rank(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) rank[order_[k]] = static_cast<Index>(k);
    for (Index i = 0; i < static_cast<Index>(at_.size()); ++i)
      std::stable_sort(at_[i].begin(), at_[i].end(),
                       [&](Index a, Index b) { return rank[other_end(a, i)] < rank[other_end(b, i)]; });
  }

  ArcGraph trace() {
    for (const Index i : order_)
      if (at_[i].size() != 2) add_hub(i);
    for (const Index i : order_)
      if (hub_[i] != kNone) walk_from(i);
    for (const Index i : order_)
      if (hub_[i] == kNone && arc_[i] == kNone) {
        add_hub(i);
        walk_from(i);
      }
    graph_.arc_of_vertex.assign(collapsed_.node_of_vertex.size(), kNone);
    graph_.hub_of_vertex = graph_.arc_of_vertex;
    for (std::size_t v = 0; v < collapsed_.node_of_vertex.size(); ++v) {
      const Index node = collapsed_.node_of_vertex[v];
      if (node == kNone) continue;
      graph_.hub_of_vertex[v] = hub_[node];
      if (hub_[node] == kNone) graph_.arc_of_vertex[v] = arc_[node];
    }
    return std::move(graph_);
  }
  ArcTubes& tubes() { return tubes_; }

 private:
  void add_hub(Index node) {
    hub_[node] = graph_.add_hub(collapsed_.nodes[node].position);
    tubes_.node_of_hub.push_back(node);
  }

  Index other_end(Index e, Index node) const {
    return collapsed_.edges[e].first == node ? collapsed_.edges[e].second : collapsed_.edges[e].first;
  }

  void walk_from(Index start) {
    for (const Index first : at_[start]) {
      if (used_[first]) continue;
      Arc arc;
      arc.hub[0] = hub_[start];
      arc.points.push_back(collapsed_.nodes[start].position);
      ArcTube tube;
      tube.nodes.push_back(start);
      Index e = first, node = start;
      while (true) {
        used_[e] = true;
        const CollapsedEdge& edge = collapsed_.edges[e];
        tube.step.push_back(edge.first == node ? edge.label : -edge.label);
        node = other_end(e, node);
        tube.nodes.push_back(node);
        arc.points.push_back(collapsed_.nodes[node].position);
        if (hub_[node] != kNone) break;
        arc_[node] = graph_.arc_count();
        e = at_[node][0] == e ? at_[node][1] : at_[node][0];
      }
      arc.hub[1] = hub_[node];
      graph_.arcs.push_back(std::move(arc));
      tubes_.tube.push_back(std::move(tube));
    }
  }

  const CollapsedSkeleton& collapsed_;
  const std::vector<Index> order_;
  std::vector<std::vector<Index>> at_;
  std::vector<Index> hub_, arc_;
  std::vector<bool> used_;
  ArcGraph graph_;
  ArcTubes tubes_;
};

// Two arcs with the same ends and no inner point between them would be one edge: all of them get inner
// points.
inline std::vector<Vector3> points_for_output(const Arc& arc, const std::vector<std::vector<Index>>& at,
                                              Index self, const ArcGraph& graph) {
  std::size_t least = arc.hub[0] == arc.hub[1] ? 4 : 2;
  for (const Index other : at[arc.hub[0]])
    if (other != self && graph.arcs[other].hub[0] + graph.arcs[other].hub[1] == arc.hub[0] + arc.hub[1])
      least = std::max<std::size_t>(least, 3);
  if (arc.points.size() >= least) return arc.points;
  const double longest = arc_length(arc);
  return resampled(arc, longest > 0 ? 2 * longest : 1.0, static_cast<Index>(least) - 1);
}

// Several balls touch one vertex. Where they differ by less than this share of the extent it is by rounding,
// and otherwise on a turned model: of such the first has the vertex.
constexpr double kSameBall = 1e-9;

// Nodes that a vertex of a hub may go to: the hub's own and those of the arcs there.
inline void assign_hub_vertices(const ArcGraph& graph, const SurfaceSnapshot& surface,
                                const std::vector<Index>& hub_node, const std::vector<std::vector<Index>>& at,
                                const std::vector<Branch>& arc_nodes, CurveSkeleton& skeleton,
                                const Execution& execution) {
  const double same = kSameBall * surface.frame.scale;
  const auto assign = [&](Index v, int) {
    const Index hub = graph.hub_of_vertex[v];
    if (hub == kNone) return;
    const Vector3 x = surface.frame.to_model(surface.position[v]);
    Index best = hub_node[hub];
    // The least distance to a ball; no root for the many balls that are farther.
    double nearest = (skeleton.nodes[best].position - x).norm() - skeleton.nodes[best].radius;
    for (const Index a : at[hub])
      for (const Index i : arc_nodes[a].nodes) {
        const SkeletonNode& node = skeleton.nodes[i];
        const double reach = nearest - same + node.radius, square = (node.position - x).squaredNorm();
        if (reach <= 0 || square >= reach * reach) continue;
        nearest = std::sqrt(square) - node.radius;
        best = i;
      }
    skeleton.node_of_vertex[v] = best;
  };
  parallel_for(
      surface.vertex_count(), "surface map", execution, [] { return 0; }, assign, kMapGrain);
}

inline void average_over_map(const SurfaceSnapshot& surface, const std::vector<double>& perimeter,
                             const std::vector<double>& error, CurveSkeleton& skeleton) {
  std::vector<double> weight(skeleton.nodes.size(), 0.0), area(skeleton.nodes.size(), 0.0);
  for (SkeletonNode& node : skeleton.nodes) node.area = node.perimeter = node.slice_error = 0;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Index i = skeleton.node_of_vertex[v];
    if (i == kNone) continue;
    SkeletonNode& node = skeleton.nodes[i];
    const double a = surface.vertex_area[v], w = perimeter[v] > 0 ? a : 0.0;
    area[i] += a;
    weight[i] += w;
    node.perimeter += w * perimeter[v] * surface.frame.scale;
    node.slice_error += a * error[v];
  }
  for (std::size_t i = 0; i < skeleton.nodes.size(); ++i) {
    SkeletonNode& node = skeleton.nodes[i];
    node.area = area[i] * surface.frame.scale * surface.frame.scale;
    if (weight[i] > 0) node.perimeter /= weight[i];
    if (area[i] > 0) node.slice_error /= area[i];
  }
}

}  // namespace detail

MSPSKEL_INLINE ArcGraph make_arc_graph(const CollapsedSkeleton& collapsed) {
  return detail::ArcTracer(collapsed).trace();
}

MSPSKEL_INLINE ArcGraph make_arc_graph(const CollapsedSkeleton& collapsed, ArcTubes& tubes) {
  detail::ArcTracer tracer(collapsed);
  ArcGraph graph = tracer.trace();
  tubes = std::move(tracer.tubes());
  return graph;
}

MSPSKEL_INLINE CurveSkeleton make_curve_skeleton(const ArcGraph& graph, const SurfaceSnapshot& surface,
                                                 const BoundingVolumeHierarchy& solid,
                                                 const std::vector<double>& perimeter,
                                                 const std::vector<double>& error,
                                                 const Execution& execution) {
  CurveSkeleton skeleton;
  const auto at = graph.incidence();
  std::vector<Index> hub_node(graph.hub_position.size(), kNone);
  const auto add_node = [&](const Vector3& x) {
    skeleton.nodes.emplace_back();
    skeleton.nodes.back().position = surface.frame.to_model(x);
    return static_cast<Index>(skeleton.nodes.size()) - 1;
  };
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h]) hub_node[h] = add_node(graph.hub_position[h]);
  std::vector<Branch> chains(graph.arcs.size());
  for (Index a = 0; a < graph.arc_count(); ++a) {
    const Arc& arc = graph.arcs[a];
    if (!arc.alive) continue;
    const auto points = detail::points_for_output(arc, at, a, graph);
    chains[a].nodes.push_back(hub_node[arc.hub[0]]);
    for (std::size_t i = 1; i + 1 < points.size(); ++i) chains[a].nodes.push_back(add_node(points[i]));
    chains[a].nodes.push_back(hub_node[arc.hub[1]]);
    for (std::size_t i = 1; i < chains[a].nodes.size(); ++i)
      skeleton.edges.push_back({std::min(chains[a].nodes[i - 1], chains[a].nodes[i]),
                                std::max(chains[a].nodes[i - 1], chains[a].nodes[i])});
  }
  std::sort(skeleton.edges.begin(), skeleton.edges.end());
  set_radii(surface, solid, skeleton, execution);

  skeleton.node_of_vertex.assign(surface.position.size(), kNone);
  detail::assign_hub_vertices(graph, surface, hub_node, at, chains, skeleton, execution);
  std::vector<Branch> branch_list;
  std::vector<Index> branch_of_arc(graph.arcs.size(), kNone),
      branch_of_vertex(surface.position.size(), kNone);
  for (std::size_t a = 0; a < chains.size(); ++a)
    if (!chains[a].nodes.empty()) {
      branch_of_arc[a] = static_cast<Index>(branch_list.size());
      branch_list.push_back(chains[a]);
    }
  for (std::size_t v = 0; v < branch_of_vertex.size(); ++v)
    if (graph.arc_of_vertex[v] != kNone) branch_of_vertex[v] = branch_of_arc[graph.arc_of_vertex[v]];
  assign_vertices_to_branch_nodes(surface, skeleton, branch_of_vertex, branch_list, execution);
  detail::average_over_map(surface, perimeter, error, skeleton);
  return skeleton;
}

}  // namespace mspskel
