#pragma once

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "mspskel/arcs/detail/near_vertices.h"
#include "mspskel/base/linkage.h"

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
  ArcRadii(const ArcGraph& graph, const BoundingVolumeHierarchy& solid) : graph_(graph), solid_(solid) {}
  // Of the point at `place` from one end of the arc.
  double at(const ArcEnd& from, std::size_t place) {
    const std::vector<Vector3>& points = graph_.arcs[from.arc].points;
    std::vector<double>& radii = radii_[from.arc];
    if (radii.empty()) radii.assign(points.size(), kUnknown);
    const std::size_t i = from.end == 0 ? place : points.size() - 1 - place;
    if (radii[i] == kUnknown) radii[i] = solid_.distance(points[i]);
    return radii[i];
  }
  // An arc got other points.
  void forget(Index arc) { radii_.erase(arc); }
  void forget_all() { radii_.clear(); }

 private:
  static constexpr double kUnknown = -1.0;
  const ArcGraph& graph_;
  const BoundingVolumeHierarchy& solid_;
  std::unordered_map<Index, std::vector<double>> radii_;
};

// Walks both polylines from their common first point for as long as they are close; both are evenly sampled.
inline CommonWay common_way(const ArcGraph& graph, const ArcEnd& from_a, const ArcEnd& from_b,
                            ArcRadii& radii, const BoundingVolumeHierarchy& solid, double closeness,
                            const CrossingLabels& crossings) {
  const std::vector<Vector3> a = points_from(graph.arcs[from_a.arc], from_a.end),
                             b = points_from(graph.arcs[from_b.arc], from_b.end);
  CommonWay way;
  way.stem.push_back(a.front());
  std::vector<Vector3> ring;
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
    if (crossings.goes_round({way.stem.back(), middle, a[i], a[i - 1]})) break;
    ring.assign({middle, way.stem.back()});
    ring.insert(ring.end(), b.begin() + static_cast<std::ptrdiff_t>(j),
                b.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    if (crossings.goes_round(ring)) break;
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
                      const BoundingVolumeHierarchy& solid, const CrossingLabels& crossings) {
  std::vector<Vector3> rest{position};
  const std::vector<Vector3> points = points_from(arc, end);
  if (solid.segment_crosses(position, points[count + 1]) ||
      crossings.goes_round({position, points[count], points[count + 1]}))
    rest.push_back(points[count]);
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
                      const Zip& zip, const CrossingLabels& crossings) {
  const Index joint = graph.arcs[zip.a.arc].hub[zip.a.end];
  const Vector3 position = zip.way.stem.back();
  const Index parting = graph.add_hub(position);
  cut_front(graph.arcs[zip.a.arc], zip.a.end, zip.way.first, parting, position, solid, crossings);
  cut_front(graph.arcs[zip.b.arc], zip.b.end, zip.way.second, parting, position, solid, crossings);
  Arc stem;
  stem.hub = {joint, parting};
  stem.points = zip.way.stem;
  graph.arcs.push_back(std::move(stem));
  const Index added = graph.arc_count() - 1;
  give_near_vertices(graph, surface, zip.a.arc, added);
  give_near_vertices(graph, surface, zip.b.arc, added);
}

// Zips one pair after the other. What a joint's arcs have in common changes only where one of them does, so
// it is found anew only there.
class ArcZipper {
 public:
  ArcZipper(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
            double closeness, const CrossingLabels& crossings)
      : graph_(graph),
        surface_(surface),
        solid_(solid),
        closeness_(closeness),
        crossings_(crossings),
        radii_(graph, solid) {}

  Index run(const Execution& execution) {
    Index zips = 0;
    all_stale();
    for (Index budget = 4 * graph_.arc_count(); budget > 0; --budget) {
      at_ = graph_.incidence();
      refresh(execution);
      const Index hub = next_hub();
      if (hub == kNone) break;
      const std::vector<Index> touched = at_[hub];
      mark(touched);
      const Index arcs_before = graph_.arc_count();
      if (joints_[hub].leaf != kNone)
        remove_leaf_arc(graph_, joints_[hub].leaf, hub);
      else
        apply_zip(graph_, surface_, solid_, joints_[hub].best, crossings_);
      ++zips;
      dissolve_through_hubs(graph_);
      joints_.resize(graph_.hub_position.size());
      mark(touched);
      for (Index a = arcs_before; a < graph_.arc_count(); ++a) mark({a});
      if (zips == 1) all_stale();  // hubs that joined two arcs before are gone
    }
    return zips;
  }

 private:
  struct Joint {
    bool stale = true;
    Index leaf = kNone;  // a leaf arc that never parts from another
    Zip best;            // the pair with the longest common way
  };

  void all_stale() {
    joints_.assign(graph_.hub_position.size(), {});
    radii_.forget_all();
  }
  void mark(const std::vector<Index>& arcs) {
    for (const Index a : arcs) {
      radii_.forget(a);
      for (const Index hub : graph_.arcs[a].hub) joints_[hub].stale = true;
    }
  }

  void refresh(const Execution& execution) {
    report_progress(execution.progress, "arcs", 0.5);
    Index searched = 0;
    for (Index h = 0; h < graph_.hub_count(); ++h) {
      if (!joints_[h].stale) continue;
      joints_[h] = {};
      joints_[h].stale = false;
      if (at_[h].size() < 3) continue;
      search(h, joints_[h]);
      if (++searched % 64 == 0) report_progress(execution.progress, "arcs", 0.5);
    }
  }

  // The first joint with a leaf arc that goes; else that of the longest common way; kNone if there is none.
  Index next_hub() const {
    Index longest = kNone;
    for (Index h = 0; h < graph_.hub_count(); ++h) {
      if (joints_[h].leaf != kNone) return h;
      if (joints_[h].best.way.length > (longest == kNone ? 0.0 : joints_[longest].best.way.length))
        longest = h;
    }
    return longest;
  }

  ArcEnd end_at(Index arc, Index hub) const { return {arc, graph_.arcs[arc].hub[0] == hub ? 0 : 1}; }
  bool is_loop(Index arc) const { return graph_.arcs[arc].hub[0] == graph_.arcs[arc].hub[1]; }

  void search(Index h, Joint& joint) {
    for (const Index a : at_[h])
      for (const Index b : at_[h]) {
        if (a == b || is_loop(a) || is_loop(b)) continue;
        const ArcEnd ea = end_at(a, h), eb = end_at(b, h);
        CommonWay way = common_way(graph_, ea, eb, radii_, solid_, closeness_, crossings_);
        const std::size_t size_a = graph_.arcs[a].points.size(), size_b = graph_.arcs[b].points.size();
        const Index tip = graph_.arcs[a].hub[1 - ea.end];
        if (way.first + 1 == size_a && at_[tip].size() == 1) {
          joint.leaf = a;
          break;
        }
        // Both must go on behind the parting point, and the way must be worth a joint of its own.
        if (way.first + 1 >= size_a || way.second + 1 >= size_b || way.first < 2 || way.second < 2) continue;
        if (way.length > joint.best.way.length) joint.best = {ea, eb, std::move(way)};
      }
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const double closeness_;
  const CrossingLabels& crossings_;
  ArcRadii radii_;
  std::vector<std::vector<Index>> at_;
  std::vector<Joint> joints_;  // per hub
};

}  // namespace detail

MSPSKEL_INLINE Index zip_arcs(ArcGraph& graph, const SurfaceSnapshot& surface,
                              const BoundingVolumeHierarchy& solid, const ZipOptions& options,
                              const CrossingLabels& crossings, const Execution& execution) {
  validate(options);
  if (options.closeness == 0) return 0;
  return detail::ArcZipper(graph, surface, solid, options.closeness, crossings).run(execution);
}

}  // namespace mspskel
