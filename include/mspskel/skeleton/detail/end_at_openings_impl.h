#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/skeleton/surface_map.h"

namespace mspskel {
namespace detail {

// The faces of the surface that are no caps.
inline std::vector<Index> faces_of_wall(const SurfaceSnapshot& surface,
                                        const std::vector<Opening>& openings) {
  std::vector<char> cap(surface.face_count(), 0);
  for (const Opening& opening : openings) {
    if (opening.vertex == kNone) continue;
    const Index first = surface.vertex_halfedge[opening.vertex];
    Index h = first;
    do {
      cap[SurfaceSnapshot::face(h)] = 1;
      h = surface.next_outgoing(h);
    } while (h != first);
  }
  std::vector<Index> wall;
  for (Index f = 0; f < surface.face_count(); ++f)
    if (!cap[f]) wall.push_back(f);
  return wall;
}

class EndAtOpening {
 public:
  EndAtOpening(CurveSkeleton& skeleton, const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
               const BoundingVolumeHierarchy& wall, double step)
      : skeleton_(skeleton),
        surface_(surface),
        solid_(solid),
        wall_(wall),
        step_(step * surface.frame.scale),
        neighbours_(adjacency(skeleton)),
        taken_(skeleton.nodes.size(), 0) {}

  // Led by a leaf, by an arc of its own, or not at all.
  void run(const Opening& opening, OpeningEnds& ends) {
    constexpr double kBefore = 0.02;  // radii
    opening_ = &opening;
    end_ = opening.centre - kBefore * opening.radius * opening.normal;
    const Index leaf = nearest_leaf();
    if (leaf != kNone && lead(leaf))
      ++ends.led;
    else if (add_arc())
      ++ends.added;
    else
      ++ends.missing;
    done_.push_back(opening_);
  }

  bool changed() const { return changed_; }

 private:
  const Vector3& place(Index node) const { return skeleton_.nodes[node].position; }
  double distance(Index node) const { return (place(node) - opening_->centre).norm(); }
  bool is_leaf(Index node) const { return neighbours_[node].size() == 1; }

  Index nearest_leaf() const {
    Index best = kNone;
    for (Index i = 0; i < static_cast<Index>(neighbours_.size()); ++i)
      if (is_leaf(i) && !taken_[i] && distance(i) <= 2 * opening_->radius &&
          (best == kNone || distance(i) < distance(best)))
        best = i;
    return best;
  }

  bool sees_end(Index node) const {
    return !solid_.segment_crosses(surface_.frame.to_normalised(place(node)),
                                   surface_.frame.to_normalised(end_));
  }

  // The nodes from the leaf on that are nearer than a radius are laid anew, in a line, and so are those from
  // which the end lies aside of where the arc goes or behind it. A leaf outside the opening whose arc never
  // goes there stands for something else.
  bool lead(Index leaf) {
    std::vector<Index> tail{leaf};
    Index before = kNone, from = leaf;
    const auto next = [&] {
      return neighbours_[from][0] == before && neighbours_[from].size() > 1 ? neighbours_[from][1]
                                                                            : neighbours_[from][0];
    };
    const auto advance = [&] {
      const Index to = next();
      before = from;
      from = to;
    };
    advance();
    while (neighbours_[from].size() == 2 && !taken_[from] &&
           (distance(from) < opening_->radius || turns_aside(next(), from))) {
      tail.push_back(from);
      advance();
    }
    if (neighbours_[from].size() != 2 && distance(leaf) > opening_->radius) return false;
    for (; !sees_end(from); tail.pop_back()) {
      if (tail.empty()) return false;
      from = tail.back();
    }
    std::reverse(tail.begin(), tail.end());
    lay(from, tail);
    return true;
  }

  // Whether an arc that comes from one node to the next turns by more than 60 degrees where it goes on to the
  // end.
  bool turns_aside(Index from, Index to) const {
    constexpr double kLeastCosine = 0.5;
    const Vector3 along = place(to) - place(from), way = end_ - place(to);
    return along.dot(way) < kLeastCosine * along.norm() * way.norm();
  }

  // From the nearest node that sees the end; how far it lies in another opening counts twice.
  bool add_arc() {
    std::vector<std::pair<double, Index>> order;
    for (Index i = 0; i < static_cast<Index>(neighbours_.size()); ++i)
      if (!(taken_[i] && is_leaf(i))) order.emplace_back(distance(i) + 2 * depth_in_other_opening(i), i);
    std::sort(order.begin(), order.end());
    const auto seen =
        std::find_if(order.begin(), order.end(), [&](const auto& entry) { return sees_end(entry.second); });
    if (seen == order.end()) return false;
    lay(seen->second, {});
    return true;
  }

  double depth_in_other_opening(Index node) const {
    double depth = 0;
    for (const Opening* other : done_)
      depth = std::max(depth, other->radius - (place(node) - other->centre).norm());
    return depth;
  }

  // Places the nodes of the chain, which begins beside `from`, and as many more as the step asks for.
  void lay(Index from, std::vector<Index> chain) {
    const Vector3 start = place(from), way = end_ - start;
    const auto wanted = static_cast<std::size_t>(std::ceil(way.norm() / step_));
    Index last = chain.empty() ? from : chain.back();
    while (chain.size() < std::max<std::size_t>(1, wanted)) {
      const auto added = static_cast<Index>(skeleton_.nodes.size());
      skeleton_.nodes.push_back(skeleton_.nodes[last]);
      skeleton_.nodes.back().area = 0;
      skeleton_.edges.push_back({last, added});
      neighbours_.emplace_back(1, last);
      neighbours_[last].push_back(added);
      taken_.push_back(1);
      chain.push_back(added);
      last = added;
    }
    for (std::size_t i = 0; i < chain.size(); ++i)
      skeleton_.nodes[chain[i]].position =
          start + static_cast<double>(i + 1) / static_cast<double>(chain.size()) * way;
    for (const Index i : chain) taken_[i] = 1;
    chain.push_back(from);
    share_vertices(chain);
    set_wall_radii();
    changed_ = true;
  }

  // The vertices of the chain go to its nearest nodes.
  void share_vertices(const std::vector<Index>& chain) {
    std::vector<char> in_chain(skeleton_.nodes.size(), 0);
    for (const Index i : chain) in_chain[i] = 1;
    for (std::size_t v = 0; v < skeleton_.node_of_vertex.size(); ++v) {
      Index& node = skeleton_.node_of_vertex[v];
      if (node == kNone || !in_chain[node]) continue;
      const Vector3 p = surface_.frame.to_model(surface_.position[v]);
      for (const Index i : chain)
        if ((place(i) - p).squaredNorm() < (place(node) - p).squaredNorm()) node = i;
    }
  }

  // Nodes whose balls the cap cut short.
  void set_wall_radii() {
    for (std::size_t i = 0; i < skeleton_.nodes.size(); ++i)
      if (distance(static_cast<Index>(i)) < 2 * opening_->radius)
        skeleton_.nodes[i].radius = surface_distance(surface_, wall_, skeleton_.nodes[i].position);
  }

  CurveSkeleton& skeleton_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const BoundingVolumeHierarchy& wall_;
  const double step_;  // model units
  std::vector<std::vector<Index>> neighbours_;
  std::vector<char> taken_;  // nodes that were laid to openings
  const Opening* opening_ = nullptr;
  std::vector<const Opening*> done_;
  Vector3 end_;
  bool changed_ = false;
};

}  // namespace detail

MSPSKEL_INLINE OpeningEnds end_at_openings(CurveSkeleton& skeleton, const SurfaceSnapshot& surface,
                                           const BoundingVolumeHierarchy& solid,
                                           const std::vector<Opening>& openings, double step) {
  OpeningEnds ends;
  if (std::all_of(openings.begin(), openings.end(), [](const Opening& o) { return o.vertex == kNone; }))
    return ends;
  const BoundingVolumeHierarchy wall(surface, detail::faces_of_wall(surface, openings));
  detail::EndAtOpening stage(skeleton, surface, solid, wall, step);
  for (const Opening& opening : openings)
    if (opening.vertex != kNone) stage.run(opening, ends);
  if (!stage.changed()) return ends;
  std::sort(skeleton.edges.begin(), skeleton.edges.end());
  make_patches_connected(surface, skeleton);
  set_areas(surface, skeleton);
  return ends;
}

}  // namespace mspskel
