#pragma once

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/collapse/label_rank.h"
#include "mspskel/mesh/detail/extent.h"

namespace mspskel {
namespace detail {

struct ShortLoop {
  double length;
  Index vertex;  // on it
  CocycleLabel label;
};

// Loops that the solid cannot fill, shorter than a length given for each component. Each has a label, so it
// runs along an edge with one, and it is a sum of loops as short through an end of that edge that consist of
// two shortest paths from there and the edge between.
class ShortLoopSearch {
 public:
  ShortLoopSearch(const SurfaceSnapshot& surface, const std::vector<CocycleLabel>& label)
      : surface_(surface), label_(label), distance_(surface.position.size(), kFar), way_(distance_.size()) {}

  // A shortest basis of their classes, by length. `longest` is per component.
  std::vector<ShortLoop> run(const std::vector<double>& longest, const ProgressCallback& progress) {
    const std::vector<Index> roots = ends_of_labelled_edges();
    std::vector<ShortLoop> loops;
    for (std::size_t i = 0; i < roots.size(); ++i) {
      if (i % 64 == 0) report_progress(progress, "cocycles", 0.9);
      find(roots[i], longest[surface_.component[roots[i]]], loops);
    }
    return independent(std::move(loops));
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  std::vector<Index> ends_of_labelled_edges() const {
    std::vector<Index> ends;
    for (Index h = 0; h < surface_.halfedge_count(); ++h)
      if (h < surface_.twin[h] && !label_[h].is_zero()) ends.push_back(surface_.origin[h]);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  static std::vector<ShortLoop> independent(std::vector<ShortLoop> loops) {
    std::stable_sort(loops.begin(), loops.end(),
                     [](const ShortLoop& a, const ShortLoop& b) { return a.length < b.length; });
    LabelRank rank;
    loops.erase(std::remove_if(loops.begin(), loops.end(),
                               [&](const ShortLoop& loop) { return !rank.insert(loop.label); }),
                loops.end());
    return loops;
  }

  template <class Visit>
  void for_each_outgoing(Index v, Visit visit) const {
    const Index first = surface_.vertex_halfedge[v];
    Index h = first;
    do {
      visit(h, surface_.target(h), (surface_.position[surface_.target(h)] - surface_.position[v]).norm());
      h = surface_.next_outgoing(h);
    } while (h != first);
  }

  // Shortest paths from the root to what lies within half of `longest`.
  std::vector<Index> grow(Index root, double longest) {
    std::vector<Index> reached{root};
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>, std::greater<>>
        queue;
    distance_[root] = 0;
    way_[root] = {};
    queue.push({0.0, root});
    while (!queue.empty()) {
      const auto [distance, v] = queue.top();
      queue.pop();
      if (distance > distance_[v]) continue;
      for_each_outgoing(v, [&](Index h, Index w, double length) {
        const double there = distance_[v] + length;
        if (2 * there > longest || there >= distance_[w]) return;
        if (distance_[w] == kFar) reached.push_back(w);
        distance_[w] = there;
        way_[w] = way_[v] + label_[h];
        queue.push({there, w});
      });
    }
    return reached;
  }

  void find(Index root, double longest, std::vector<ShortLoop>& loops) {
    const std::vector<Index> reached = grow(root, longest);
    std::vector<ShortLoop> through;
    for (const Index v : reached)
      for_each_outgoing(v, [&](Index h, Index w, double length) {
        if (h > surface_.twin[h] || distance_[v] + length + distance_[w] >= longest) return;
        CocycleLabel label = way_[v] + label_[h] - way_[w];
        if (!label.is_zero())
          through.push_back({distance_[v] + length + distance_[w], root, std::move(label)});
      });
    for (const Index v : reached) distance_[v] = kFar;
    through = independent(std::move(through));
    loops.insert(loops.end(), through.begin(), through.end());
  }

  const SurfaceSnapshot& surface_;
  const std::vector<CocycleLabel>& label_;
  std::vector<double> distance_;   // per vertex: from the root
  std::vector<CocycleLabel> way_;  // per vertex: label of the shortest path
};

// Z^g with some classes filled: what each of the g coordinates counts as in what is left.
class FilledLabels {
 public:
  explicit FilledLabels(const VolumeCocycles& cocycles) : filled_(cocycles.cocycle.size(), false) {
    for (std::size_t i = 0; i < filled_.size(); ++i) {
      image_.push_back(CocycleLabel::unit(static_cast<Index>(i)));
      is_loop_.push_back(cocycles.cocycle[i].contours.empty());
    }
  }

  // Fills the class of a loop with this label, independent of those before. One coordinate goes, and those
  // beside it in the label make up for it. False if they are not of one kind.
  bool fill(const CocycleLabel& label) {
    const CocycleLabel loop = mapped(label, image_);
    CocycleLabel::Entry pivot = loop.entries().front();
    for (const auto& entry : loop.entries()) {
      if (is_loop_[entry.index] != is_loop_[pivot.index]) return false;
      if (std::abs(entry.value) < std::abs(pivot.value)) pivot = entry;
    }
    filled_[pivot.index] = true;
    for (CocycleLabel& image : image_) {
      const std::int32_t share = image[pivot.index];
      CocycleLabel left;
      for (const auto& [index, value] : image.entries())
        left += CocycleLabel::unit(index, value) * (loop[index] != 0 ? pivot.value : 1);
      image = left - loop * share;
    }
    return true;
  }

  // Numbers the coordinates that are left from 0.
  std::vector<CocycleLabel> images() const {
    std::vector<Index> number(filled_.size());
    Index left = 0;
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = filled_[i] ? kNone : left++;
    std::vector<CocycleLabel> result(image_.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      for (const auto& [index, value] : image_[i].entries())
        result[i] += CocycleLabel::unit(number[index], value);
    return result;
  }

 private:
  std::vector<CocycleLabel> image_;
  std::vector<bool> filled_, is_loop_;
};

// Of each component, normalised units: what the frame of the component alone would have as 1.
inline std::vector<double> frame_extents(const SurfaceSnapshot& surface) {
  if (surface.component_count == 1) return {1.0};
  std::vector<double> result;
  for (const ComponentElements& component : component_elements(surface)) {
    std::vector<Vector3> points;
    Vector3 centroid = Vector3::Zero();
    double area = 0;
    for (const Index v : component.vertices) {
      points.push_back(surface.position[v]);
      centroid += surface.vertex_area[v] * points.back();
      area += surface.vertex_area[v];
    }
    result.push_back(extent(points, area > 0 ? Vector3(centroid / area) : points.front()));
  }
  return result;
}

}  // namespace detail

MSPSKEL_INLINE bool leave_out_small_handles(const SurfaceSnapshot& surface, double share,
                                            VolumeCocycles& cocycles, const ProgressCallback& progress) {
  if (!(share > 0) || cocycles.rank == 0) return true;
  std::vector<double> longest = detail::frame_extents(surface);
  for (double& length : longest) length *= share;
  const auto loops = detail::ShortLoopSearch(surface, cocycles.label).run(longest, progress);
  if (loops.empty()) return true;
  detail::FilledLabels filled(cocycles);
  for (const detail::ShortLoop& loop : loops)
    if (!filled.fill(loop.label)) return false;
  for (const detail::ShortLoop& loop : loops)
    cocycles.small_handles.push_back({loop.length, surface.position[loop.vertex]});
  cocycles.image = filled.images();
  cocycles.rank -= static_cast<Index>(loops.size());
  for (CocycleLabel& label : cocycles.label)
    if (!label.is_zero()) label = mapped(label, cocycles.image);
  return true;
}

}  // namespace mspskel
