// The maximal balls round the points of a graph's arcs.
#pragma once

#include <utility>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/solid/detail/ball_chain.h"

namespace mspskel {
namespace detail {

// The balls of every arc's inner points, and of every hub.
struct ArcBalls {
  std::vector<BallChain> arc;
  std::vector<Ball> hub;

  ArcBalls(const ArcGraph& graph, const BoundingVolumeHierarchy& solid, const Execution& execution) {
    std::vector<std::vector<Ball>> of_arc(graph.arcs.size());
    for (const Vector3& x : graph.hub_position) hub.push_back({x, 0.0});
    for (std::size_t a = 0; a < of_arc.size(); ++a)
      if (graph.arcs[a].alive)
        for (std::size_t i = 1; i + 1 < graph.arcs[a].points.size(); ++i)
          of_arc[a].push_back({graph.arcs[a].points[i], 0.0});
    std::vector<Ball*> all;
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h]) all.push_back(&hub[h]);
    for (auto& balls : of_arc)
      for (Ball& ball : balls) all.push_back(&ball);
    parallel_for(
        static_cast<Index>(all.size()), "arcs", execution, [] { return 0; },
        [&](Index i, int) { all[i]->radius = solid.distance(all[i]->centre); });
    for (auto& balls : of_arc) arc.emplace_back(std::move(balls));
  }
};

// Those of all arcs and of the hubs that are alive, in one list.
inline std::vector<Ball> all_balls(const ArcGraph& graph, const ArcBalls& balls) {
  std::vector<Ball> all;
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (graph.hub_alive[h]) all.push_back(balls.hub[h]);
  for (const BallChain& chain : balls.arc) all.insert(all.end(), chain.balls().begin(), chain.balls().end());
  return all;
}

}  // namespace detail
}  // namespace mspskel
