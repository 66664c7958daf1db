#pragma once

#include <algorithm>
#include <string>

#include "mspskel/arcs/detail/arc_editor.h"
#include "mspskel/arcs/detail/hub_components.h"
#include "mspskel/base/linkage.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

inline void route_arc(Arc& arc, const BoundingVolumeHierarchy& solid, InnerPaths& inner,
                      RoutingResult& result) {
  std::vector<Vector3> kept{arc.points.front()};
  for (std::size_t i = 1; i + 1 < arc.points.size(); ++i)
    if (solid.inside(arc.points[i])) kept.push_back(arc.points[i]);
  kept.push_back(arc.points.back());
  std::vector<Vector3> points{kept.front()}, between;
  for (std::size_t i = 1; i < kept.size(); ++i) {
    if (solid.segment_crosses(points.back(), kept[i])) {
      if (inner.path(points.back(), kept[i], between)) {
        points.insert(points.end(), between.begin(), between.end());
        ++result.routed;
      } else {
        ++result.unroutable;
      }
    }
    points.push_back(kept[i]);
  }
  arc.points = std::move(points);
}

// Hubs that lie outside, each to the nearest chord middle of its own part: another limb's chords may lie
// nearer. The graph's map is of the vertices of `inner`'s surface. Returns how many it moved.
inline Index move_hubs_inside(ArcGraph& graph, InnerGraph& inner) {
  const BoundingVolumeHierarchy& solid = inner.solid();
  std::vector<Index> hubs;
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h] && !solid.inside(graph.hub_position[h])) hubs.push_back(h);
  if (hubs.empty()) return 0;
  const SurfaceSnapshot& surface = inner.surface();
  const std::vector<Index> component = hub_components(graph, surface);
  inner.prepare();
  Index moved = 0;
  for (const Index h : hubs) {
    const auto own = [&](Index w) {
      const Index a = graph.arc_of_vertex[w];
      return graph.hub_of_vertex[w] == h ||
             (a != kNone && (graph.arcs[a].hub[0] == h || graph.arcs[a].hub[1] == h));
    };
    Index v = inner.nearest(graph.hub_position[h], own);
    if (v == kNone)
      v = inner.nearest(graph.hub_position[h], [&](Index w) {
        return component[h] == kNone || surface.component[w] == component[h];
      });
    if (v == kNone) continue;
    graph.move_hub(h, inner.point(v));
    ++moved;
  }
  return moved;
}

}  // namespace detail

MSPSKEL_INLINE RoutingResult route_inside(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                          const SurfaceSnapshot& surface) {
  detail::InnerGraph inner(surface, solid);
  return route_inside(graph, inner);
}

MSPSKEL_INLINE RoutingResult route_inside(ArcGraph& graph, detail::InnerGraph& inner) {
  RoutingResult result;
  result.hubs_moved = detail::move_hubs_inside(graph, inner);
  const RoutingResult arcs = route_arcs_inside(graph, inner.solid(), inner);
  result.routed = arcs.routed;
  result.unroutable = arcs.unroutable;
  return result;
}

MSPSKEL_INLINE RoutingResult route_arcs_inside(ArcGraph& graph, const BoundingVolumeHierarchy& solid,
                                               detail::InnerPaths& inner, const std::vector<bool>& held) {
  RoutingResult result;
  for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
    if (!held.empty() && held[a]) continue;
    Arc& arc = graph.arcs[a];
    bool crosses = false;
    for (std::size_t i = 1; i < arc.points.size() && arc.alive && !crosses; ++i)
      crosses = solid.segment_crosses(arc.points[i - 1], arc.points[i]);
    if (!crosses) continue;
    inner.prepare();
    detail::route_arc(arc, solid, inner, result);
  }
  return result;
}

MSPSKEL_INLINE Index count_crossing_edges(const ArcGraph& graph, const BoundingVolumeHierarchy& solid) {
  Index crossing = 0;
  for (const Arc& arc : graph.arcs)
    for (std::size_t i = 1; arc.alive && i < arc.points.size(); ++i)
      if (solid.segment_crosses(arc.points[i - 1], arc.points[i])) ++crossing;
  return crossing;
}

MSPSKEL_INLINE Index remove_crossing_leaves(ArcGraph& graph, const BoundingVolumeHierarchy& solid) {
  Index removed = 0;
  detail::ArcEditor editor(graph);
  for (Index a = 0; a < graph.arc_count(); ++a) {
    const Arc& arc = graph.arcs[a];
    if (!arc.alive || arc.hub[0] == arc.hub[1]) continue;
    bool crosses = false;
    for (std::size_t i = 1; i < arc.points.size() && !crosses; ++i)
      crosses = solid.segment_crosses(arc.points[i - 1], arc.points[i]);
    if (!crosses) continue;
    const auto [first, last] = arc.hub;
    // Of an arc between two leaves the hub that lies deeper stays.
    const bool first_is_leaf = editor.at(first).size() == 1, last_is_leaf = editor.at(last).size() == 1;
    if (!first_is_leaf && !last_is_leaf) continue;
    const bool keep_first = !first_is_leaf || (last_is_leaf && solid.distance(graph.hub_position[first]) >=
                                                                   solid.distance(graph.hub_position[last]));
    editor.remove_leaf_arc(a, keep_first ? first : last);
    ++removed;
  }
  return removed;
}

}  // namespace mspskel
