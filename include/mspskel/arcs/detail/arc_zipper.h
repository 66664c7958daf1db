// Arcs that run side by side, and what makes one of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mspskel/arcs/detail/arc_editor.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// An arc seen from one of its ends.
struct ArcEnd {
  Index arc;
  int end;
};

// Its points in order from that end.
class ArcWay {
 public:
  ArcWay(const ArcGraph& graph, const ArcEnd& from)
      : points_(graph.arcs[from.arc].points), reversed_(from.end == 1) {}
  std::size_t size() const { return points_.size(); }
  const Vector3& operator[](std::size_t i) const { return points_[reversed_ ? size() - 1 - i : i]; }

 private:
  const std::vector<Vector3>& points_;
  const bool reversed_;
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
  const ArcWay a(graph, from_a), b(graph, from_b);
  CommonWay way;
  way.stem.push_back(a[0]);
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
    for (std::size_t m = j; m <= k; ++m) ring.push_back(b[m]);
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
inline std::vector<Vector3> without_front(const Arc& arc, int end, std::size_t count, const Vector3& position,
                                          const BoundingVolumeHierarchy& solid,
                                          const CrossingLabels& crossings) {
  std::vector<Vector3> rest{position};
  const std::vector<Vector3> points = points_from(arc, end);
  if (solid.segment_crosses(position, points[count + 1]) ||
      crossings.goes_round({position, points[count], points[count + 1]}))
    rest.push_back(points[count]);
  rest.insert(rest.end(), points.begin() + static_cast<std::ptrdiff_t>(count) + 1, points.end());
  if (end == 1) std::reverse(rest.begin(), rest.end());
  return rest;
}

// Zips one pair after the other. What two arcs have in common changes only where one of them does, so it is
// found anew only then.
class ArcZipper {
 public:
  ArcZipper(ArcGraph& graph, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
            double closeness, const CrossingLabels& crossings, std::vector<bool> kept = {})
      : graph_(graph),
        surface_(surface),
        solid_(solid),
        closeness_(closeness),
        crossings_(crossings),
        kept_(std::move(kept)),
        radii_(graph, solid),
        editor_(graph),
        version_(graph.arcs.size(), 0) {}

  Index run(const Execution& execution) {
    Index zips = 0;
    make_joints();
    for (Index budget = 4 * graph_.arc_count(); budget > 0; --budget) {
      refresh(execution);
      const Index hub = next_hub();
      if (hub == kNone) break;
      if (joints_[hub].leaf != kNone)
        drop(joints_[hub].leaf, hub);
      else
        zip(hub, Pair(joints_[hub].pairs[joints_[hub].best]));
      ++zips;
      dissolve(hub);
      // A graph without a zip stays as it is.
      for (Index h = 0; zips == 1 && h < graph_.hub_count(); ++h) dissolve(h);
    }
    return zips;
  }

  // How many pairs of arcs were compared so far.
  Index compared() const { return compared_; }

 private:
  // Two arcs of a joint as they were when they were compared.
  struct Pair {
    Index a = kNone, b = kNone;
    Index version_a = 0, version_b = 0;
    CommonWay way;
  };
  struct Joint {
    static constexpr std::size_t kNoPair = static_cast<std::size_t>(-1);
    bool stale = false;
    Index leaf = kNone;          // a leaf arc that never parts from another
    std::vector<Pair> pairs;     // by ascending a, then b
    std::size_t best = kNoPair;  // the pair with the longest common way
    double longest = 0.0;        // that way's length
  };

  // Hubs get joints, which are to be searched.
  void make_joints() {
    for (auto h = static_cast<Index>(joints_.size()); h < graph_.hub_count(); ++h) {
      joints_.emplace_back();
      mark(h);
    }
  }
  void mark(Index hub) {
    if (joints_[hub].stale) return;
    joints_[hub].stale = true;
    stale_.push_back(hub);
  }
  // An arc goes another way, or ends elsewhere.
  void changed(Index arc) {
    radii_.forget(arc);
    ++version_[arc];
    for (const Index hub : graph_.arcs[arc].hub) mark(hub);
  }

  void dissolve(Index hub) {
    if (const Index arc = editor_.dissolve(hub); arc != kNone) {
      mark(hub);
      changed(arc);
    }
  }

  void drop(Index leaf, Index hub) {
    changed(leaf);
    editor_.remove_leaf_arc(leaf, hub);
  }

  void zip(Index joint, const Pair& pair) {
    const Vector3 position = pair.way.stem.back();
    const Index parting = editor_.add_hub(position);
    make_joints();
    for (const auto& [from, count] : {std::make_pair(end_at(pair.a, joint), pair.way.first),
                                      std::make_pair(end_at(pair.b, joint), pair.way.second)}) {
      changed(from.arc);
      editor_.lead_to(from.arc, from.end, parting,
                      without_front(graph_.arcs[from.arc], from.end, count, position, solid_, crossings_));
    }
    Arc stem;
    stem.hub = {joint, parting};
    stem.points = pair.way.stem;
    const Index added = editor_.add_arc(std::move(stem));
    version_.push_back(0);
    for (const Index arc : {pair.a, pair.b}) editor_.give_near_vertices(surface_, arc, added);
  }

  void refresh(const Execution& execution) {
    report_progress(execution.progress, "arcs", 0.5);
    Index searched = 0;
    for (const Index h : stale_) {
      leaves_.erase(h);
      ways_.erase({-joints_[h].longest, h});
      std::vector<Pair> known = std::move(joints_[h].pairs);
      joints_[h] = {};
      if (editor_.at(h).size() < 3) continue;
      search(h, joints_[h], known);
      if (joints_[h].leaf != kNone) leaves_.insert(h);
      if (joints_[h].longest > 0) ways_.insert({-joints_[h].longest, h});
      if (++searched % 64 == 0) report_progress(execution.progress, "arcs", 0.5);
    }
    stale_.clear();
  }

  // The first joint with a leaf arc that goes; else that of the longest common way; kNone if there is none.
  Index next_hub() const {
    if (!leaves_.empty()) return *leaves_.begin();
    return ways_.empty() ? kNone : ways_.begin()->second;
  }

  ArcEnd end_at(Index arc, Index hub) const { return {arc, graph_.arcs[arc].hub[0] == hub ? 0 : 1}; }
  bool is_kept(Index hub) const { return hub < static_cast<Index>(kept_.size()) && kept_[hub]; }
  bool is_loop(Index arc) const { return graph_.arcs[arc].hub[0] == graph_.arcs[arc].hub[1]; }

  // `known`: the pairs that were compared when the joint was last searched, which are given away.
  void search(Index h, Joint& joint, std::vector<Pair>& known) {
    auto next_known = known.begin();
    for (const Index a : editor_.at(h))
      for (const Index b : editor_.at(h)) {
        if (a == b || is_loop(a) || is_loop(b)) continue;
        while (next_known != known.end() &&
               std::make_pair(next_known->a, next_known->b) < std::make_pair(a, b))
          ++next_known;
        joint.pairs.push_back({a, b, version_[a], version_[b], {}});
        Pair& pair = joint.pairs.back();
        CommonWay& way = pair.way;
        const bool is_known = next_known != known.end() && next_known->a == a && next_known->b == b &&
                              next_known->version_a == pair.version_a &&
                              next_known->version_b == pair.version_b;
        if (is_known) {
          way = std::move(next_known->way);
        } else {
          ++compared_;
          way = common_way(graph_, end_at(a, h), end_at(b, h), radii_, solid_, closeness_, crossings_);
        }
        const std::size_t size_a = graph_.arcs[a].points.size(), size_b = graph_.arcs[b].points.size();
        const Index tip = graph_.arcs[a].hub[1 - end_at(a, h).end];
        if (way.first + 1 == size_a && editor_.at(tip).size() == 1 && !is_kept(tip)) {
          joint.leaf = a;
          break;
        }
        // Both must go on behind the parting point, and the way must be worth a joint of its own.
        if (way.first + 1 >= size_a || way.second + 1 >= size_b || way.first < 2 || way.second < 2) continue;
        if (way.length <= joint.longest) continue;
        joint.longest = way.length;
        joint.best = joint.pairs.size() - 1;
      }
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const double closeness_;
  const CrossingLabels& crossings_;
  const std::vector<bool> kept_;  // hubs whose leaf arcs stay
  ArcRadii radii_;
  ArcEditor editor_;
  Index compared_ = 0;
  std::vector<Index> version_;               // per arc how often it has changed
  std::vector<Joint> joints_;                // per hub
  std::vector<Index> stale_;                 // joints to search
  std::set<Index> leaves_;                   // joints that have one to drop
  std::set<std::pair<double, Index>> ways_;  // joints by their longest common way, negated
};

}  // namespace detail
}  // namespace mspskel
