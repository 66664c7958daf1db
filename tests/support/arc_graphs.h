// Arc graphs made by hand or at random, and the laws that every stage keeps.
#pragma once

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "support/meshes.h"

namespace mspskel::test {

struct GraphType {
  Index components = 0, cycles = 0;
  bool operator==(const GraphType& o) const { return components == o.components && cycles == o.cycles; }
};
inline std::ostream& operator<<(std::ostream& out, const GraphType& t) {
  return out << t.components << " components, " << t.cycles << " cycles";
}

inline GraphType type_of(const ArcGraph& graph) {
  std::vector<Index> root(graph.hub_position.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index h) {
    while (root[h] != h) h = root[h] = root[root[h]];
    return h;
  };
  GraphType type;
  for (Index h = 0; h < graph.hub_count(); ++h) type.components += graph.hub_alive[h];
  for (const Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    const Index a = find(arc.hub[0]), b = find(arc.hub[1]);
    if (a == b) {
      ++type.cycles;
    } else {
      root[a] = b;
      --type.components;
    }
  }
  return type;
}

// Living arcs join living hubs and start and end at their places.
inline bool arcs_meet_hubs(const ArcGraph& graph) {
  for (const Arc& arc : graph.arcs) {
    if (!arc.alive) continue;
    if (arc.points.size() < 2) return false;
    for (const int end : {0, 1}) {
      if (!graph.hub_alive[arc.hub[end]]) return false;
      const Vector3& tip = end == 0 ? arc.points.front() : arc.points.back();
      if (tip != graph.hub_position[arc.hub[end]]) return false;
    }
    for (const Vector3& p : arc.points)
      if (!p.allFinite()) return false;
  }
  return true;
}

// Every vertex belongs to one living arc or hub.
inline bool map_is_partition(const ArcGraph& graph) {
  for (std::size_t v = 0; v < graph.arc_of_vertex.size(); ++v) {
    const Index arc = graph.arc_of_vertex[v], hub = graph.hub_of_vertex[v];
    if ((arc == kNone) == (hub == kNone)) return false;
    if (arc != kNone ? !graph.arcs[arc].alive : !graph.hub_alive[hub]) return false;
  }
  return true;
}

inline Index leaf_count(const ArcGraph& graph) {
  Index leaves = 0;
  for (const auto& arcs : graph.incidence()) leaves += arcs.size() == 1;
  return leaves;
}

inline Index living_arcs(const ArcGraph& graph) {
  return static_cast<Index>(
      std::count_if(graph.arcs.begin(), graph.arcs.end(), [](const Arc& arc) { return arc.alive; }));
}

// Edges of living arcs that meet the surface, and hubs outside.
inline Index crossings(const ArcGraph& graph, const BoundingVolumeHierarchy& solid) {
  Index count = 0;
  for (Index h = 0; h < graph.hub_count(); ++h)
    count += graph.hub_alive[h] && !solid.inside(graph.hub_position[h]);
  for (const Arc& arc : graph.arcs)
    for (std::size_t i = 1; arc.alive && i < arc.points.size(); ++i)
      count += solid.segment_crosses(arc.points[i - 1], arc.points[i]);
  return count;
}

// Hubs, arcs through the given points, every vertex of a surface mapped to the first hub.
inline Index add_arc(ArcGraph& graph, Index from, Index to, const std::vector<Vector3>& between = {}) {
  Arc arc;
  arc.hub = {from, to};
  arc.points.push_back(graph.hub_position[from]);
  arc.points.insert(arc.points.end(), between.begin(), between.end());
  arc.points.push_back(graph.hub_position[to]);
  graph.arcs.push_back(std::move(arc));
  return graph.arc_count() - 1;
}

// Points strictly between a and b at `count` equal steps.
inline std::vector<Vector3> straight(const Vector3& a, const Vector3& b, Index count) {
  std::vector<Vector3> points;
  for (Index i = 1; i < count; ++i) points.push_back(a + (b - a) * i / count);
  return points;
}

// Gives every vertex to the arc or hub whose point is nearest.
inline void map_to_nearest(ArcGraph& graph, const std::vector<Vector3>& vertices) {
  graph.arc_of_vertex.assign(vertices.size(), kNone);
  graph.hub_of_vertex.assign(vertices.size(), kNone);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    double best = std::numeric_limits<double>::infinity();
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h] && (graph.hub_position[h] - vertices[v]).norm() < best) {
        best = (graph.hub_position[h] - vertices[v]).norm();
        graph.hub_of_vertex[v] = h;
      }
    for (Index a = 0; a < graph.arc_count(); ++a)
      for (std::size_t i = 1; graph.arcs[a].alive && i + 1 < graph.arcs[a].points.size(); ++i)
        if ((graph.arcs[a].points[i] - vertices[v]).norm() < best) {
          best = (graph.arcs[a].points[i] - vertices[v]).norm();
          graph.arc_of_vertex[v] = a;
          graph.hub_of_vertex[v] = kNone;
        }
  }
}

// A random multigraph with loops, parallel arcs, leaves, lone hubs and hubs that an arc passes through, in
// the ball of the given radius round a centre; a hundred vertices mapped to it at random.
inline ArcGraph random_arc_graph(Random& random, double radius = 1.0,
                                 const Vector3& centre = Vector3::Zero()) {
  ArcGraph graph;
  const auto place = [&] { return Vector3(centre + radius * random.in_ball()); };
  const Index hubs = 1 + random.below(8), arcs = random.below(12);
  for (Index h = 0; h < hubs; ++h) graph.add_hub(place());
  for (Index a = 0; a < arcs; ++a) {
    std::vector<Vector3> between;
    for (Index i = random.below(6); i > 0; --i) between.push_back(place());
    const Index from = random.below(hubs), to = random.below(hubs);
    add_arc(graph, from, to, between);
  }
  for (Index v = 0; v < 100; ++v) {
    const bool on_arc = arcs > 0 && random.below(3) > 0;
    graph.arc_of_vertex.push_back(on_arc ? random.below(arcs) : kNone);
    graph.hub_of_vertex.push_back(on_arc ? kNone : random.below(hubs));
  }
  return graph;
}

// An arc between two hubs with even points on a straight line.
inline Index line(ArcGraph& graph, Index from, Index to, Index count = 40) {
  return add_arc(graph, from, to, straight(graph.hub_position[from], graph.hub_position[to], count));
}

inline Index joint_count(const ArcGraph& graph) {
  Index joints = 0;
  for (const auto& arcs : graph.incidence()) joints += arcs.size() >= 3;
  return joints;
}

// Leaf arcs that end in the ball of their joint.
inline Index spur_count(const ArcGraph& graph, const BoundingVolumeHierarchy& solid) {
  const auto at = graph.incidence();
  Index spurs = 0;
  for (const Arc& arc : graph.arcs)
    for (const int end : {0, 1}) {
      if (!arc.alive || at[arc.hub[end]].size() != 1 || at[arc.hub[1 - end]].size() < 3) continue;
      const Vector3& joint = graph.hub_position[arc.hub[1 - end]];
      spurs += (graph.hub_position[arc.hub[end]] - joint).norm() < solid.distance(joint);
    }
  return spurs;
}

}  // namespace mspskel::test
