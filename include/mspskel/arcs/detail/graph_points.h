// Where an arc can begin that a skeleton lacks: the points that the skeleton has.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "mspskel/arcs/center_arcs.h"
#include "mspskel/arcs/detail/hub_components.h"
#include "mspskel/arcs/detail/near_vertices.h"
#include "mspskel/arcs/route_inside.h"

namespace mspskel {
namespace detail {

// A point of the graph: a hub, or an inner point of an arc.
struct GraphPoint {
  Index hub = kNone, arc = kNone;
  std::size_t index = 0;
  Vector3 position = Vector3::Zero();
};

// Per hub the component of the surface that its piece of the graph stands for: that of the vertices on the
// piece; kNone where there are none.
inline std::vector<Index> components_of_pieces(const ArcGraph& graph, const SurfaceSnapshot& surface) {
  std::vector<Index> component = hub_components(graph, surface);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Arc& arc : graph.arcs)
      for (const int end : {0, 1}) {
        if (!arc.alive || component[arc.hub[end]] != kNone || component[arc.hub[1 - end]] == kNone) continue;
        component[arc.hub[end]] = component[arc.hub[1 - end]];
        changed = true;
      }
  }
  return component;
}

// The 64 points nearest to x of the accepted hubs and arcs, by their distance. O(points).
template <class AcceptHub, class AcceptArc>
std::vector<std::pair<double, GraphPoint>> nearest_points(const ArcGraph& graph, const Vector3& x,
                                                          AcceptHub accept_hub, AcceptArc accept_arc) {
  constexpr std::size_t kSeen = 64;
  std::vector<std::pair<double, GraphPoint>> near;
  double bound = std::numeric_limits<double>::infinity();  // what is no nearer is none of them
  const auto by_distance = [](const auto& a, const auto& b) { return a.first < b.first; };
  const auto offer = [&](const GraphPoint& point) {
    const double distance = (point.position - x).norm();
    if (distance >= bound) return;
    near.push_back({distance, point});
    if (near.size() < 4 * kSeen) return;
    std::nth_element(near.begin(), near.begin() + kSeen - 1, near.end(), by_distance);
    near.resize(kSeen);
    bound = near.back().first;
  };
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h] && accept_hub(h)) offer({h, kNone, 0, graph.hub_position[h]});
  for (Index a = 0; a < graph.arc_count(); ++a)
    if (graph.arcs[a].alive && accept_arc(a))
      for (std::size_t i = 1; i + 1 < graph.arcs[a].points.size(); ++i)
        offer({kNone, a, i, graph.arcs[a].points[i]});
  std::sort(near.begin(), near.end(), by_distance);
  if (near.size() > kSeen) near.resize(kSeen);
  return near;
}

// The hub at a point of the graph; an arc ends there if it did not, and what is nearer to the rest of it goes
// with that.
inline Index hub_at(ArcGraph& graph, const SurfaceSnapshot& surface, const GraphPoint& p) {
  if (p.hub != kNone) return p.hub;
  const Index hub = split_arc(graph, p.arc, p.index);
  give_near_vertices(graph, surface, p.arc, graph.arc_count() - 1);
  return hub;
}

// A few rounds of centring of a polyline by itself. Its ends move too, within their sections.
inline std::vector<Vector3> centred_alone(const std::vector<Vector3>& way,
                                          const BoundingVolumeHierarchy& solid, double step) {
  ArcGraph alone;
  alone.add_hub(way.front());
  alone.add_hub(way.back());
  alone.arcs.push_back({{0, 1}, way, true});
  CenteringOptions few;
  few.step = step;
  few.rounds = 2;
  few.rays = 16;
  Execution one_thread;
  one_thread.threads = 1;
  center_arcs(alone, solid, few, one_thread);
  return alone.arcs[0].points;
}

}  // namespace detail
}  // namespace mspskel
