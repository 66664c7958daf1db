#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "mspskel/arcs/detail/hub_components.h"
#include "mspskel/arcs/detail/in_tubes.h"
#include "mspskel/arcs/detail/near_vertices.h"
#include "mspskel/arcs/detail/tight_line.h"
#include "mspskel/arcs/detail/vessel_trees.h"
#include "mspskel/base/linkage.h"
#include "mspskel/solid/detail/axis_stretch.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

// The arcs of shells, one after the other.
class WallArcs {
 public:
  WallArcs(ArcGraph& graph, InnerGraph& inner, const std::vector<bool>& shells, double step,
           const CrossingLabels& crossings)
      : graph_(graph),
        surface_(inner.surface()),
        solid_(inner.solid()),
        shells_(shells),
        inner_(inner),
        crossings_(crossings),
        line_(solid_, step, crossings),
        step_(step),
        component_(hub_components(graph, surface_)),
        ends_(shells.size()),
        has_leaf_(shells.size(), false) {}

  Index run() {
    const auto at = graph_.incidence();
    Index drawn = 0;
    for (Index a = 0; a < graph_.arc_count(); ++a) {
      Arc& arc = graph_.arcs[a];
      const Index c = arc.alive ? component_[arc.hub[0]] : kNone;
      if (c == kNone || !shells_[c]) continue;
      for (const Index hub : arc.hub) has_leaf_[c] = has_leaf_[c] || at[hub].size() == 1;
      arc.points = resampled_inside(arc, step_, solid_, crossings_);
      const bool ring = arc.hub[0] == arc.hub[1] && at[arc.hub[0]].size() == 2;
      if (ring && !begin_in_tube(graph_, a, solid_)) continue;
      tighten(a, c);
      ++drawn;
    }
    const std::vector<SolidMoments> moments = solid_moments(surface_);
    for (std::size_t c = 0; c < shells_.size(); ++c)
      if (shells_[c] && !has_leaf_[c] && !ends_[c].empty() && add_floor(moments[c], ends_[c])) ++drawn;
    dissolve_through_hubs(graph_);
    return drawn;
  }

 private:
  struct TubeEnd {
    Index arc;
    std::size_t point;
  };

  void tighten(Index arc, Index component) {
    std::vector<Vector3>& points = graph_.arcs[arc].points;
    const std::vector<std::uint8_t> tube = in_tubes(points, solid_);
    std::vector<Vector3> tight{points.front()};
    for (std::size_t i = 0; i + 1 < points.size();) {
      std::size_t end = i + 1;
      while (end + 1 < points.size() && !tube[end]) ++end;
      std::vector<Vector3> stretch(points.begin() + static_cast<std::ptrdiff_t>(i),
                                   points.begin() + static_cast<std::ptrdiff_t>(end + 1));
      if (end > i + 1) {
        stretch = shortest(std::move(stretch));
        if (tube[i] && i > 0) ends_[component].push_back({arc, tight.size() - 1});
        if (tube[end] && end + 1 < points.size())
          ends_[component].push_back({arc, tight.size() + stretch.size() - 2});
      }
      tight.insert(tight.end(), stretch.begin() + 1, stretch.end());
      i = end;
    }
    points = std::move(tight);
  }

  // Heat flow stops at the nearest of the ways that no small move makes shorter: round the wall, say, where
  // down is nearer. So the shortest way in the middle of the wall is tried as well.
  std::vector<Vector3> shortest(std::vector<Vector3> stretch) {
    const Vector3 from = stretch.front(), to = stretch.back();
    const CocycleLabel label = crossings_.along(stretch);
    std::vector<Vector3> tight = line_.tighten(std::move(stretch));
    std::optional<std::vector<Vector3>> way = way_of_class(inner_, crossings_, from, to, label);
    if (!way) return tight;
    way = line_.tighten(std::move(*way));
    return length_of(*way) + step_ < length_of(tight) ? *way : tight;
  }

  bool add_floor(const SolidMoments& moments, const std::vector<TubeEnd>& ends) {
    const auto stretch = axis_stretch(moments, solid_);
    if (!stretch) return false;
    const Vector3 floor = ((*stretch)[0] + (*stretch)[1]) / 2;
    inner_.prepare();
    Arc best;
    TubeEnd from{kNone, 0};
    for (const TubeEnd& end : ends) {
      Arc way;
      way.points.push_back(graph_.arcs[end.arc].points[end.point]);
      std::vector<Vector3> between;
      if (!inner_.path(way.points.front(), floor, between)) continue;
      way.points.insert(way.points.end(), between.begin(), between.end());
      way.points.push_back(floor);
      if (from.arc != kNone && arc_length(way) >= arc_length(best)) continue;
      best = std::move(way);
      from = end;
    }
    if (from.arc == kNone) return false;
    best.points = line_.tighten(std::move(best.points));
    if (arc_length(best) <= solid_.distance(best.points.front())) return false;
    const Index parts = graph_.arc_count();
    best.hub = {split_arc(graph_, from.arc, from.point), graph_.add_hub(floor)};
    give_near_vertices(graph_, surface_, from.arc, parts);
    graph_.arcs.push_back(std::move(best));
    for (const Index a : {from.arc, parts}) give_near_vertices(graph_, surface_, a, graph_.arc_count() - 1);
    return true;
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const std::vector<bool>& shells_;
  InnerGraph& inner_;
  const CrossingLabels& crossings_;
  const TightLine line_;
  const double step_;
  const std::vector<Index> component_;      // of each hub
  std::vector<std::vector<TubeEnd>> ends_;  // where tubes open into walls, per component
  std::vector<bool> has_leaf_;              // per component
};

}  // namespace detail

MSPSKEL_INLINE Index tighten_in_walls(ArcGraph& graph, detail::InnerGraph& inner,
                                      const std::vector<bool>& shells, double step,
                                      const CrossingLabels& crossings) {
  if (std::find(shells.begin(), shells.end(), true) == shells.end()) return 0;
  std::vector<bool> left(shells);
  if (auto hung = detail::VesselTrees(graph, inner, step, crossings).run(left)) graph = std::move(*hung);
  return detail::WallArcs(graph, inner, left, step, crossings).run();
}

}  // namespace mspskel
