#pragma once

#include <algorithm>
#include <cmath>

#include "mspskel/base/linkage.h"
#include "mspskel/graph/detail/near_vertices.h"

namespace mspskel {
namespace detail {

// An arc seen from one of its ends.
struct ArcEnd {
  Index arc;
  int end;
};

struct CommonWay {
  double length = 0.0;    // along the first arc
  std::size_t first = 0;  // number of points of each arc on the way
  std::size_t second = 0;
  std::vector<Vector3> stem;  // middles of the two arcs' points, from the joint
};

// Distances to the surface of the arcs' points, each computed when it is first asked for.
class ArcRadii {
 public:
  ArcRadii(const ArcGraph& graph, const BoundingVolumeHierarchy& solid) : graph_(graph), solid_(solid) {
    for (const Arc& arc : graph.arcs) radius_.emplace_back(arc.alive ? arc.points.size() : 0, kUnknown);
  }
  // Of the point at `place` from one end of the arc.
  double at(const ArcEnd& from, std::size_t place) {
    const std::vector<Vector3>& points = graph_.arcs[from.arc].points;
    const std::size_t i = from.end == 0 ? place : points.size() - 1 - place;
    double& radius = radius_[from.arc][i];
    if (radius == kUnknown) radius = solid_.distance(points[i]);
    return radius;
  }

 private:
  static constexpr double kUnknown = -1.0;
  const ArcGraph& graph_;
  const BoundingVolumeHierarchy& solid_;
  std::vector<std::vector<double>> radius_;
};

// Walks both polylines from their common first point for as long as they are close; both are evenly sampled.
inline CommonWay common_way(const ArcGraph& graph, const ArcEnd& from_a, const ArcEnd& from_b,
                            ArcRadii& radii, const BoundingVolumeHierarchy& solid, double closeness) {
  const std::vector<Vector3> a = points_from(graph.arcs[from_a.arc], from_a.end),
                             b = points_from(graph.arcs[from_b.arc], from_b.end);
  CommonWay way;
  way.stem.push_back(a.front());
  std::size_t j = 0;
  for (std::size_t i = 1; i < a.size(); ++i) {
    // The nearest point of b ahead of the last one.
    std::size_t k = j;
    while (k + 1 < b.size() && (b[k + 1] - a[i]).squaredNorm() < (b[k] - a[i]).squaredNorm()) ++k;
    const double distance = (b[k] - a[i]).norm();
    if (distance > 0) {
      const double radius = std::min(radii.at(from_a, i), radii.at(from_b, k));
      if (distance >= closeness * radius) break;
    }
    const Vector3 middle = 0.5 * (a[i] + b[k]);
    if (solid.segment_crosses(way.stem.back(), middle)) break;
    j = k;
    way.length += (a[i] - a[i - 1]).norm();
    way.first = i;
    way.second = j;
    way.stem.push_back(middle);
  }
  return way;
}

// The points of an arc behind the common way, led in from the new joint: straight, or, if that meets the
// surface, by way of the arc's last point on the common way, which lies in the same ball as the joint.
inline void cut_front(Arc& arc, int end, std::size_t count, Index joint, const Vector3& position,
                      const BoundingVolumeHierarchy& solid) {
  std::vector<Vector3> rest{position};
  const std::vector<Vector3> points = points_from(arc, end);
  if (solid.segment_crosses(position, points[count + 1])) rest.push_back(points[count]);
  rest.insert(rest.end(), points.begin() + static_cast<std::ptrdiff_t>(count) + 1, points.end());
  if (end == 1) std::reverse(rest.begin(), rest.end());
  arc.points = std::move(rest);
  arc.hub[end] = joint;
}

struct Zip {
  ArcEnd a{kNone, 0}, b{kNone, 0};
  CommonWay way;
};

inline void apply_zip(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                      const Zip& zip) {
  const Index joint = graph.arcs[zip.a.arc].hub[zip.a.end];
  const Vector3 position = zip.way.stem.back();
  const Index parting = graph.add_hub(position);
  cut_front(graph.arcs[zip.a.arc], zip.a.end, zip.way.first, parting, position, solid);
  cut_front(graph.arcs[zip.b.arc], zip.b.end, zip.way.second, parting, position, solid);
  Arc stem;
  stem.hub = {joint, parting};
  stem.points = zip.way.stem;
  graph.arcs.push_back(std::move(stem));
  const Index added = graph.arc_count() - 1;
  give_near_vertices(graph, surface, zip.a.arc, added);
  give_near_vertices(graph, surface, zip.b.arc, added);
}

}  // namespace detail

MSPSKEL_INLINE Index zip_arcs(ArcGraph& graph, const SurfaceSnapshot& surface,
                              const BoundingVolumeHierarchy& solid, const ZipOptions& options) {
  validate(options);
  if (options.closeness == 0) return 0;
  Index zips = 0;
  for (Index budget = 4 * graph.arc_count(); budget > 0; --budget) {
    const auto at = graph.incidence();
    detail::ArcRadii radii(graph, solid);
    detail::Zip best;
    Index leaf_gone = kNone, leaf_joint = kNone;
    for (Index h = 0; h < graph.hub_count() && leaf_gone == kNone; ++h) {
      if (at[h].size() < 3) continue;
      for (const Index a : at[h])
        for (const Index b : at[h]) {
          if (a == b || graph.arcs[a].hub[0] == graph.arcs[a].hub[1] ||
              graph.arcs[b].hub[0] == graph.arcs[b].hub[1])
            continue;
          const detail::ArcEnd ea{a, graph.arcs[a].hub[0] == h ? 0 : 1},
              eb{b, graph.arcs[b].hub[0] == h ? 0 : 1};
          detail::CommonWay way = detail::common_way(graph, ea, eb, radii, solid, options.closeness);
          const std::size_t size_a = graph.arcs[a].points.size(), size_b = graph.arcs[b].points.size();
          const Index tip = graph.arcs[a].hub[1 - ea.end];
          if (way.first + 1 == size_a && at[tip].size() == 1) {
            leaf_gone = a;
            leaf_joint = h;
            break;
          }
          // Both must go on behind the parting point, and the way must be worth a joint of its own.
          if (way.first + 1 >= size_a || way.second + 1 >= size_b || way.first < 2 || way.second < 2)
            continue;
          if (way.length > best.way.length) best = {ea, eb, std::move(way)};
        }
    }
    if (leaf_gone != kNone) {
      remove_leaf_arc(graph, leaf_gone, leaf_joint);
    } else if (best.a.arc != kNone) {
      detail::apply_zip(graph, surface, solid, best);
    } else {
      break;
    }
    ++zips;
    dissolve_through_hubs(graph);
  }
  return zips;
}

}  // namespace mspskel
