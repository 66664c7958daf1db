#pragma once

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>

#include "mspskel/arcs/detail/tube_search.h"
#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

class TubeRouter {
 public:
  TubeRouter(ArcGraph& graph, const CollapseTubes& tubes, const SurfaceSnapshot& surface,
             const BoundingVolumeHierarchy& solid, const CrossingLabels& crossings,
             const Execution& execution)
      : graph_(graph),
        tubes_(tubes),
        surface_(surface),
        solid_(solid),
        crossings_(crossings),
        points_(surface, solid, crossings),
        execution_(execution),
        classes_(tubes, surface, crossings, points_, execution),
        hubs_{graph.hub_position, std::vector<SettledHubs::Hub>(graph.hub_position.size())} {}

  ClassRouting run() {
    const std::vector<bool> in_cycle = arcs_of_cycles(graph_);
    const auto count = std::min(graph_.arcs.size(), tubes_.arcs.tube.size());
    std::vector<Index> arcs;
    for (std::size_t a = 0; a < count; ++a)
      if (in_cycle[a]) arcs.push_back(static_cast<Index>(a));
    for (const Index a : arcs)
      for (const Index hub : graph_.arcs[a].hub) {
        report_progress(execution_.progress, "arcs", 0.0);
        settle(hub);
      }
    std::atomic<std::size_t> next{0};
    std::atomic<Index> routed{0}, abandoned{0};
    const auto lead_arcs = [&](const Execution& own) {
      std::optional<TubeSearch> search;
      for (std::size_t i = next++; i < arcs.size(); i = next++) {
        report_progress(own.progress, "arcs", static_cast<double>(i) / static_cast<double>(arcs.size()));
        Arc& arc = graph_.arcs[arcs[i]];
        const bool in_class = crossings_.along(arc.points) == wanted(arcs[i]);
        if (in_class && stays_inside(arcs[i])) continue;
        if (!search) search.emplace(tubes_, surface_, solid_, crossings_, classes_, hubs_, points_, own);
        const ArcTube& tube = tubes_.arcs.tube[arcs[i]];
        const bool led = search->lead(arc, tube, false) || (!in_class && search->lead(arc, tube, true));
        ++(led ? routed : abandoned);
      }
    };
    run_beside(
        execution_, [&] { lead_arcs(execution_); }, lead_arcs);
    return {static_cast<Index>(arcs.size()), routed, abandoned};
  }

 private:
  static constexpr std::size_t kNear = 64;

  // Finds a way from the origin of the hub's node to the hub: over the surface to the nearest vertex of its
  // part that sees the hub. Where none does the hub moves to a chord of its part. Where there is no chord,
  // the straight way to the hub is as good as any.
  void settle(Index h) {
    SettledHubs::Hub& hub = hubs_.hub[h];
    if (hub.settled) return;
    hub.settled = true;
    const Index node = tubes_.arcs.node_of_hub[h];
    const Vector3& x = graph_.hub_position[h];
    std::vector<std::pair<double, Index>> all;
    classes_.for_each_vertex(node, [&](Index v) {
      all.push_back({(surface_.position[v] - x).squaredNorm(), v});
    });
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), kNear));
    std::partial_sort(all.begin(), end, all.end());
    for (auto it = all.begin(); it != end; ++it) hub.near.push_back(it->second);
    if (solid_.inside(x))
      for (const Index v : hub.near) {
        const Vector3 start = surface_.position[v] - 1e-7 * surface_.normal[v];
        if (!solid_.inside(start) || solid_.segment_crosses(start, x)) continue;
        hub.from_origin = classes_.to_vertex(v) + points_.from_vertex(v, x);
        return;
      }
    for (const Index v : hub.near)
      for (const auto layer : {ChordPoints::kMiddle, ChordPoints::kShallow}) {
        const ChordPoints::Point& point = points_(v, layer);
        if (point.clearance == 0) continue;
        graph_.move_hub(h, point.x);
        hub.from_origin = classes_.to_vertex(v) + point.from_vertex;
        return;
      }
    if (!hub.near.empty())
      hub.from_origin = classes_.to_vertex(hub.near.front()) + points_.from_vertex(hub.near.front(), x);
  }

  CocycleLabel wanted(Index a) const {
    const Arc& arc = graph_.arcs[a];
    CocycleLabel label = hubs_.hub[arc.hub[1]].from_origin - hubs_.hub[arc.hub[0]].from_origin;
    for (const CocycleLabel& step : tubes_.arcs.tube[a].step) label += step;
    return label;
  }

  bool stays_inside(Index a) const {
    const std::vector<Vector3>& points = graph_.arcs[a].points;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (solid_.segment_crosses(points[i - 1], points[i])) return false;
    return true;
  }

  ArcGraph& graph_;
  const CollapseTubes& tubes_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const CrossingLabels& crossings_;
  ChordPoints points_;
  const Execution& execution_;
  TubeClasses classes_;
  SettledHubs hubs_;
};

}  // namespace detail

MSPSKEL_INLINE std::vector<bool> arcs_of_cycles(const ArcGraph& graph) {
  std::vector<bool> in(graph.arcs.size());
  for (std::size_t a = 0; a < in.size(); ++a) in[a] = graph.arcs[a].alive;
  const auto at = graph.incidence();
  std::vector<std::size_t> degree(at.size());
  std::vector<Index> leaves;
  for (std::size_t h = 0; h < at.size(); ++h) {
    degree[h] = at[h].size();
    if (degree[h] == 1) leaves.push_back(static_cast<Index>(h));
  }
  while (!leaves.empty()) {
    const Index leaf = leaves.back();
    leaves.pop_back();
    for (const Index a : at[leaf]) {
      if (!in[a]) continue;
      in[a] = false;
      const Index other = graph.arcs[a].hub[0] == leaf ? graph.arcs[a].hub[1] : graph.arcs[a].hub[0];
      if (--degree[other] == 1) leaves.push_back(other);
    }
  }
  return in;
}

MSPSKEL_INLINE ClassRouting route_by_class(ArcGraph& graph, const CollapseTubes& tubes,
                                           const SurfaceSnapshot& input, const BoundingVolumeHierarchy& solid,
                                           const CrossingLabels& crossings, const Execution& execution) {
  if (crossings.rank() == 0) return {};
  return detail::TubeRouter(graph, tubes, input, solid, crossings, execution).run();
}

}  // namespace mspskel
