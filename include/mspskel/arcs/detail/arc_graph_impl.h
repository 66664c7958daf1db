#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE void ArcGraph::move_hub(Index hub, const Vector3& position) {
  hub_position[hub] = position;
  for (Arc& arc : arcs) {
    if (!arc.alive) continue;
    if (arc.hub[0] == hub) arc.points.front() = position;
    if (arc.hub[1] == hub) arc.points.back() = position;
  }
}

MSPSKEL_INLINE std::vector<std::vector<Index>> ArcGraph::incidence() const {
  std::vector<std::vector<Index>> at(hub_position.size());
  for (Index a = 0; a < arc_count(); ++a)
    if (arcs[a].alive)
      for (const Index hub : arcs[a].hub) at[hub].push_back(a);
  return at;
}

MSPSKEL_INLINE ArcGraphType homotopy_type(const ArcGraph& graph) {
  ArcGraphType type;
  std::vector<Index> parent(graph.hub_position.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index x) {
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
  };
  for (Index h = 0; h < graph.hub_count(); ++h) type.components += graph.hub_alive[h] ? 1 : 0;
  for (const Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const Index a = root(arc.hub[0]), b = root(arc.hub[1]);
    if (a == b) {
      ++type.cycles;
    } else {
      parent[a] = b;
      --type.components;
    }
  }
  return type;
}

MSPSKEL_INLINE double arc_length(const Arc& arc) {
  double length = 0;
  for (std::size_t i = 1; i < arc.points.size(); ++i) length += (arc.points[i] - arc.points[i - 1]).norm();
  return length;
}

MSPSKEL_INLINE std::vector<Vector3> points_from(const Arc& arc, int end) {
  std::vector<Vector3> points = arc.points;
  if (end == 1) std::reverse(points.begin(), points.end());
  return points;
}

MSPSKEL_INLINE std::vector<Vector3> resampled(const Arc& arc, double step, Index min_edges) {
  if (arc.hub[0] == arc.hub[1]) min_edges = std::max<Index>(min_edges, 3);
  const double length = arc_length(arc);
  const Index count = std::max(min_edges, static_cast<Index>(std::ceil(length / step - 1e-9)));
  std::vector<Vector3> points{arc.points.front()};
  double walked = 0;
  std::size_t i = 1;
  for (Index k = 1; k < count; ++k) {
    const double target = length * k / count;
    while (i + 1 < arc.points.size() && walked + (arc.points[i] - arc.points[i - 1]).norm() < target) {
      walked += (arc.points[i] - arc.points[i - 1]).norm();
      ++i;
    }
    const Vector3 edge = arc.points[i] - arc.points[i - 1];
    const double t = edge.norm() > 0 ? std::min(1.0, (target - walked) / edge.norm()) : 0.0;
    points.push_back(arc.points[i - 1] + t * edge);
  }
  points.push_back(arc.points.back());
  return points;
}

MSPSKEL_INLINE void subdivide(ArcGraph& graph, double longest) {
  std::vector<Vector3> points;
  for (Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    points.assign(1, arc.points.front());
    for (std::size_t i = 1; i < arc.points.size(); ++i) {
      const Vector3 from = arc.points[i - 1], edge = arc.points[i] - from;
      const int pieces = std::max(1, static_cast<int>(std::ceil(edge.norm() / longest)));
      for (int k = 1; k < pieces; ++k) points.push_back(from + edge * (static_cast<double>(k) / pieces));
      points.push_back(arc.points[i]);
    }
    arc.points = points;
  }
}

MSPSKEL_INLINE Index split_arc(ArcGraph& graph, Index arc, std::size_t point) {
  Arc& first = graph.arcs[arc];
  const Index hub = graph.add_hub(first.points[point]);
  Arc rest = first;
  rest.points.erase(rest.points.begin(), rest.points.begin() + static_cast<std::ptrdiff_t>(point));
  rest.hub[0] = hub;
  first.points.resize(point + 1);
  first.hub[1] = hub;
  graph.arcs.push_back(std::move(rest));
  return hub;
}

MSPSKEL_INLINE void join_at(ArcGraph& graph, Index hub, Index kept, Index gone) {
  Arc &first = graph.arcs[kept], &second = graph.arcs[gone];
  if (first.hub[0] == hub) {
    std::reverse(first.points.begin(), first.points.end());
    std::swap(first.hub[0], first.hub[1]);
  }
  if (second.hub[1] == hub) {
    std::reverse(second.points.begin(), second.points.end());
    std::swap(second.hub[0], second.hub[1]);
  }
  first.points.insert(first.points.end(), second.points.begin() + 1, second.points.end());
  first.hub[1] = second.hub[1];
  second.alive = false;
  second.points.clear();
  graph.hub_alive[hub] = false;
}

MSPSKEL_INLINE void dissolve_through_hubs(ArcGraph& graph) {
  auto at = graph.incidence();
  std::vector<Index> arc_now(graph.arcs.size());
  for (Index a = 0; a < graph.arc_count(); ++a) arc_now[a] = a;
  std::vector<Index> hub_gone_to(graph.hub_position.size(), kNone);
  for (Index h = 0; h < graph.hub_count(); ++h) {
    if (at[h].size() != 2 || at[h][0] == at[h][1]) continue;
    const Index a = at[h][0], b = at[h][1];
    join_at(graph, h, a, b);
    hub_gone_to[h] = a;
    arc_now[b] = a;
    for (Index& other : at[graph.arcs[a].hub[1]])
      if (other == b) other = a;
  }
  const auto current = [&](Index a) {
    while (arc_now[a] != a) a = arc_now[a];
    return a;
  };
  for (std::size_t v = 0; v < graph.arc_of_vertex.size(); ++v) {
    if (graph.hub_of_vertex[v] != kNone && hub_gone_to[graph.hub_of_vertex[v]] != kNone) {
      graph.arc_of_vertex[v] = hub_gone_to[graph.hub_of_vertex[v]];
      graph.hub_of_vertex[v] = kNone;
    }
    if (graph.arc_of_vertex[v] != kNone) graph.arc_of_vertex[v] = current(graph.arc_of_vertex[v]);
  }
}

MSPSKEL_INLINE void contract_arc(ArcGraph& graph, Index arc, const Vector3& position) {
  const Index keep = graph.arcs[arc].hub[0], gone = graph.arcs[arc].hub[1];
  graph.arcs[arc].alive = false;
  graph.hub_alive[gone] = false;
  for (Arc& other : graph.arcs)
    for (Index& hub : other.hub)
      if (hub == gone) hub = keep;
  for (std::size_t v = 0; v < graph.arc_of_vertex.size(); ++v)
    if (graph.arc_of_vertex[v] == arc || graph.hub_of_vertex[v] == gone) {
      graph.arc_of_vertex[v] = kNone;
      graph.hub_of_vertex[v] = keep;
    }
  graph.move_hub(keep, position);
}

}  // namespace mspskel
