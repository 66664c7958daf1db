#pragma once

#include <algorithm>
#include <queue>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/mesh/component_extents.h"

namespace mspskel {
namespace detail {

// Per component the longest edge that is left as it is.
inline std::vector<double> longest_edges(const SurfaceSnapshot& surface, const SubdivisionOptions& options) {
  std::vector<Index> count(static_cast<std::size_t>(surface.component_count), 0);
  for (const Index c : surface.component)
    if (c != kNone) ++count[c];
  std::vector<double> longest = component_extents(surface);
  for (std::size_t c = 0; c < longest.size(); ++c)
    longest[c] *= count[c] < options.enough ? options.longest : 1.0;
  return longest;
}

class EdgeBisection {
 public:
  EdgeBisection(const SurfaceSnapshot& input, const SubdivisionOptions& options)
      : s_(result_.surface), left_(static_cast<std::size_t>(input.component_count)) {
    s_.frame = input.frame;
    s_.origin = input.origin;
    s_.twin = input.twin;
    result_.vertex.assign(input.position.size(), kNone);
    const Index share = options.most_added_in_all / std::max<Index>(input.component_count, 1);
    std::fill(left_.begin(), left_.end(), std::min(options.most_added, share));
    for (Index v = 0; v < input.vertex_count(); ++v) {
      if (input.vertex_halfedge[v] == kNone) continue;
      result_.vertex[v] = s_.vertex_count();
      s_.position.push_back(input.position[v]);
      s_.component.push_back(input.component[v]);
    }
    for (Index& v : s_.origin) v = result_.vertex[v];
    longest_ = longest_edges(input, options);
  }

  SubdividedSurface run(const ProgressCallback& progress) {
    version_.assign(s_.origin.size(), 0);
    for (Index h = 0; h < s_.halfedge_count(); ++h)
      if (h < s_.twin[h]) offer(h);
    while (!queue_.empty()) {
      const Offer best = queue_.top();
      queue_.pop();
      const Index h = best.halfedge;
      if (version_[h] != best.version || left_[s_.component[s_.origin[h]]] <= 0) continue;
      if (result_.cuts % 256 == 0) report_progress(progress, "subdivision", 0.0);
      cut(h);
      ++result_.cuts;
    }
    complete_snapshot(s_);
    return std::move(result_);
  }

 private:
  // An edge as it was: later cuts of it or beside it change its version.
  struct Offer {
    double length;
    Index halfedge, version;
    bool operator<(const Offer& o) const {
      return length != o.length ? length < o.length : halfedge > o.halfedge;
    }
  };

  // Queues the edge of h if it is too long.
  void offer(Index h) {
    h = std::min(h, s_.twin[h]);
    const Index component = s_.component[s_.origin[h]];
    version_.resize(s_.origin.size(), 0);
    ++version_[h];
    const double length = (s_.position[s_.origin[h]] - s_.position[s_.target(h)]).norm();
    if (left_[component] > 0 && length > longest_[component]) queue_.push({length, h, version_[h]});
  }

  //        c                   c
  //      /   \               / | \            The faces on both sides of a-b are cut in two from a vertex m
  //      in
  //     a --- b    becomes  a--m--b           the middle.
  //      \   /               \ | /
  //        d                   d
  void cut(Index h) {
    const Index g = s_.twin[h];
    const auto m = static_cast<Index>(s_.position.size());
    const Index component = s_.component[s_.origin[h]];
    s_.position.push_back(0.5 * (s_.position[s_.origin[h]] + s_.position[s_.origin[g]]));
    s_.component.push_back(component);
    --left_[component];
    const Index after_h = cut_face(h, m), after_g = cut_face(g, m);
    pair(h, after_g);
    pair(g, after_h);
    for (const Index e : {h, g, after_h + 2, after_g + 2}) offer(e);
  }

  // The half-edge e, a-b of the face a-b-c, becomes a-m; returns the one that runs m-b.
  Index cut_face(Index e, Index m) {
    const Index across = SurfaceSnapshot::next(e), outer = s_.twin[across];
    const auto added = static_cast<Index>(s_.origin.size());
    const Index b = s_.origin[across], c = s_.apex(e);
    s_.origin.insert(s_.origin.end(), {m, b, c});
    s_.twin.insert(s_.twin.end(), {kNone, kNone, kNone});
    s_.origin[across] = m;
    pair(added + 1, outer);
    pair(added + 2, across);
    offer(added + 1);
    return added;
  }
  void pair(Index a, Index b) {
    s_.twin[a] = b;
    s_.twin[b] = a;
  }

  SubdividedSurface result_;
  SurfaceSnapshot& s_;           // the result's
  std::vector<Index> left_;      // per component: vertices that may be added
  std::vector<double> longest_;  // per component: edge that is not cut
  std::vector<Index> version_;   // per half-edge
  std::priority_queue<Offer> queue_;
};

}  // namespace detail

MSPSKEL_INLINE void validate(const SubdivisionOptions& o) {
  if (o.enough < 1) throw UsageError("vertices that are enough for a surface must be at least 1");
  if (o.most_added < 1) throw UsageError("a surface to be subdivided may be given 1 vertex at least");
  if (o.most_added_in_all < 1) throw UsageError("surfaces to be subdivided may be given 1 vertex at least");
  if (!(o.longest > 0 && o.longest <= 1))
    throw UsageError("the longest edge of a subdivided surface must be from 0 to 1 of the extent");
}

MSPSKEL_INLINE bool has_long_edge(const SurfaceSnapshot& surface, const SubdivisionOptions& options) {
  validate(options);
  const std::vector<double> longest = detail::longest_edges(surface, options);
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index v = surface.origin[h];
    const double length = longest[surface.component[v]];
    if ((surface.position[v] - surface.position[surface.target(h)]).squaredNorm() > length * length)
      return true;
  }
  return false;
}

MSPSKEL_INLINE SubdividedSurface subdivide_surface(const SurfaceSnapshot& input,
                                                   const SubdivisionOptions& options,
                                                   const Execution& execution) {
  validate(options);
  return detail::EdgeBisection(input, options).run(execution.progress);
}

}  // namespace mspskel
