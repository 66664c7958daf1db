#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/arcs/detail/hub_components.h"
#include "mspskel/arcs/detail/in_tubes.h"
#include "mspskel/arcs/detail/near_vertices.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/arcs/detail/tight_line.h"
#include "mspskel/arcs/detail/vessel_trees.h"
#include "mspskel/base/linkage.h"
#include "mspskel/base/progress.h"
#include "mspskel/solid/detail/axis_stretch.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

// Draws the arcs of shells tight, all at once: threads take the stretches of all arcs.
class WallArcs {
 public:
  WallArcs(ArcGraph& graph, InnerGraph& inner, const std::vector<bool>& shells, double step,
           const CrossingLabels& crossings, const Execution& execution)
      : graph_(graph),
        surface_(inner.surface()),
        solid_(inner.solid()),
        shells_(shells),
        inner_(inner),
        crossings_(crossings),
        line_(solid_, step, crossings),
        step_(step),
        execution_(execution),
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
      divide(a);
      ++drawn;
    }
    tighten();
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

  // A stretch of an arc between two tubes or ends of the arc, with the ways that it may take; or a step in a
  // tube, which stays as it is.
  struct Part {
    Index arc;
    std::size_t first, last;                 // points of the arc
    bool follows_tube, meets_tube;           // at the first point, at the last
    std::vector<std::vector<Vector3>> ways;  // none in a tube
  };

  // Divides an arc into its parts. Heat flow stops at the nearest of the ways that no small move makes
  // shorter: round the wall, say, where down is nearer. So the shortest way in the middle of the wall is
  // tried as well.
  void divide(Index arc) {
    const std::vector<Vector3>& points = graph_.arcs[arc].points;
    const std::vector<std::uint8_t> tube = in_tubes(points, solid_);
    for (std::size_t i = 0; i + 1 < points.size();) {
      std::size_t end = i + 1;
      while (end + 1 < points.size() && !tube[end]) ++end;
      Part part{arc, i, end, tube[i] && i > 0, tube[end] && end + 1 < points.size(), {}};
      if (end > i + 1) {
        part.ways.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(i),
                               points.begin() + static_cast<std::ptrdiff_t>(end + 1));
        if (auto way =
                way_of_class(inner_, crossings_, points[i], points[end], crossings_.along(part.ways.front())))
          part.ways.push_back(std::move(*way));
      }
      parts_.push_back(std::move(part));
      i = end;
    }
  }

  // Draws the ways of all parts tight, and gives each arc its parts' shorter ones.
  void tighten() {
    std::vector<std::vector<Vector3>*> ways;
    for (Part& part : parts_)
      for (std::vector<Vector3>& way : part.ways) ways.push_back(&way);
    parallel_for(
        static_cast<Index>(ways.size()), "arcs", execution_, [] { return 0; },
        [&](Index i, int) { *ways[i] = line_.tighten(std::move(*ways[i])); }, 1);
    for (std::size_t first = 0, last = 0; first < parts_.size(); first = last) {
      std::vector<Vector3>& points = graph_.arcs[parts_[first].arc].points;
      std::vector<Vector3> tight{points.front()};
      for (; last < parts_.size() && parts_[last].arc == parts_[first].arc; ++last)
        append(parts_[last], tight);
      points = std::move(tight);
    }
  }
  // Adds what comes of a part behind the points of those before it, and notes where tubes open into the wall.
  void append(const Part& part, std::vector<Vector3>& tight) {
    const Arc& arc = graph_.arcs[part.arc];
    if (part.ways.empty()) {
      append_points(tight, arc.points, part.first + 1, part.last + 1);
      return;
    }
    const bool other = part.ways.size() > 1 && length_of(part.ways[1]) + step_ < length_of(part.ways[0]);
    const std::vector<Vector3>& way = part.ways[other ? 1 : 0];
    std::vector<TubeEnd>& ends = ends_[component_[arc.hub[0]]];
    if (part.follows_tube) ends.push_back({part.arc, tight.size() - 1});
    if (part.meets_tube) ends.push_back({part.arc, tight.size() + way.size() - 2});
    tight.insert(tight.end(), way.begin() + 1, way.end());
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
  const Execution& execution_;
  const std::vector<Index> component_;      // of each hub
  std::vector<Part> parts_;                 // of the arcs that are drawn, one after the other
  std::vector<std::vector<TubeEnd>> ends_;  // where tubes open into walls, per component
  std::vector<bool> has_leaf_;              // per component
};

}  // namespace detail

MSPSKEL_INLINE Index tighten_in_walls(ArcGraph& graph, detail::InnerGraph& inner,
                                      const std::vector<bool>& shells, double step,
                                      const CrossingLabels& crossings, const Execution& execution) {
  if (std::find(shells.begin(), shells.end(), true) == shells.end()) return 0;
  std::vector<bool> left(shells);
  if (auto hung = detail::VesselTrees(graph, inner, step, crossings).run(left)) graph = std::move(*hung);
  return detail::WallArcs(graph, inner, left, step, crossings, execution).run();
}

}  // namespace mspskel
