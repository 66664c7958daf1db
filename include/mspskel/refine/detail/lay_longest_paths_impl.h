#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mspskel/arcs/detail/graph_points.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/arcs/detail/single_arc.h"
#include "mspskel/base/linkage.h"
#include "mspskel/mesh/component_extents.h"
#include "mspskel/mesh/detail/solid_moments.h"
#include "mspskel/mesh/inner_distance.h"
#include "mspskel/skeleton/useless_pieces.h"
#include "mspskel/solid/detail/axis_stretch.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

class LongestPaths {
 public:
  LongestPaths(ArcGraph& graph, InnerGraph& inner, const std::vector<bool>& shells, double step)
      : graph_(graph),
        surface_(inner.surface()),
        solid_(inner.solid()),
        inner_(inner),
        shells_(shells),
        step_(step) {}

  Index run() {
    const std::vector<Index> component = components_of_pieces(graph_, surface_);
    const std::vector<double> extent = component_extents(surface_);
    const std::vector<Index> handles = handles_of_components(surface_);
    std::vector<double> length(extent.size(), 0.0);
    for (const Arc& arc : graph_.arcs)
      if (arc.alive && component[arc.hub[0]] != kNone) length[component[arc.hub[0]]] += arc_length(arc);
    Index laid = 0;
    for (Index c = 0; c < surface_.component_count; ++c) {
      if (handles[c] > 0 || length[c] >= kLeastPieceLength * extent[c] || is_vessel(c)) continue;
      auto path = longest_path(c);
      if (!path || !(length_of(*path) > length[c])) continue;
      replace_by_arc(graph_, surface_, component, c, std::move(*path));
      ++laid;
    }
    return laid;
  }

 private:
  // In its wall any path is as good as another.
  bool is_vessel(Index c) {
    if (!shells_[c]) return false;
    if (moments_.empty()) moments_ = solid_moments(surface_);
    return detail::is_vessel(moments_[c], solid_);
  }

  // The usable vertex farthest from the given one along the surface; kNone if there is no other.
  Index farthest(Index from) {
    if (!ways_) ways_.emplace(surface_);
    std::vector<double> distance(surface_.position.size(), std::numeric_limits<double>::infinity());
    distance[from] = 0;
    ways_->extend(std::vector<std::uint8_t>(distance.size(), 0), distance);
    Index best = kNone;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (v != from && inner_.usable(v) && std::isfinite(distance[v]) &&
          (best == kNone || distance[v] > distance[best]))
        best = v;
    return best;
  }

  // From one end of the component to the other: nothing where its chords do not connect them.
  std::optional<std::vector<Vector3>> longest_path(Index c) {
    inner_.prepare();
    Index start = kNone;
    for (Index v = 0; v < surface_.vertex_count() && start == kNone; ++v)
      if (surface_.component[v] == c && inner_.usable(v)) start = v;
    if (start == kNone) return std::nullopt;
    const Index from = farthest(start);
    const Index to = from == kNone ? kNone : farthest(from);
    if (to == kNone) return std::nullopt;
    std::vector<Vector3> between;
    if (!inner_.path(inner_.point(from), inner_.point(to), between)) return std::nullopt;
    std::vector<Vector3> path{inner_.point(from)};
    for (const Vector3& x : between)
      if (x != path.back()) path.push_back(x);
    if (inner_.point(to) != path.back()) path.push_back(inner_.point(to));
    lead_towards(path, surface_.position[to], solid_, step_);
    std::reverse(path.begin(), path.end());
    lead_towards(path, surface_.position[from], solid_, step_);
    if (path.size() < 2) return std::nullopt;
    return centred_alone(path, solid_, step_);
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  InnerGraph& inner_;
  const std::vector<bool>& shells_;
  const double step_;
  std::optional<SurfaceWays> ways_;
  std::vector<SolidMoments> moments_;  // per component, once one of them is asked for
};

}  // namespace detail

MSPSKEL_INLINE Index lay_longest_paths(ArcGraph& graph, detail::InnerGraph& inner,
                                       const std::vector<bool>& shells, double step) {
  return detail::LongestPaths(graph, inner, shells, step).run();
}

}  // namespace mspskel
