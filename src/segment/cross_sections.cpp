#include "cross_sections.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace mspskel::detail {
namespace {

bool is_joint(const std::vector<std::vector<Index>>& neighbours, Index n) { return neighbours[n].size() > 2; }

// Few vertices map to a joint, and their slices run across whichever arc is near.
void take_from_arcs(const std::vector<std::vector<Index>>& neighbours, std::vector<double>& section) {
  for (Index n = 0; n < static_cast<Index>(section.size()); ++n) {
    if (!is_joint(neighbours, n)) continue;
    double thickest = 0;
    for (const Index k : neighbours[n])
      if (!is_joint(neighbours, k)) thickest = std::max(thickest, section[k]);
    if (thickest > 0) section[n] = thickest;
  }
}

}  // namespace

std::vector<double> cross_sections(const CurveSkeleton& skeleton,
                                   const std::vector<std::vector<Index>>& neighbours) {
  const Index count = static_cast<Index>(skeleton.nodes.size());
  std::vector<double> raw(count), weight(count), smooth(count);
  for (Index n = 0; n < count; ++n) {
    const SkeletonNode& node = skeleton.nodes[n];
    raw[n] = node.perimeter > 0 ? node.perimeter / (2 * kPi) : node.radius;
    weight[n] = node.perimeter > 0 ? node.area : 0.0;
  }
  std::vector<char> done(count, 0);
  std::vector<Index> visited;
  using Item = std::pair<double, Index>;
  for (Index from = 0; from < count; ++from) {
    const double width = skeleton.nodes[from].radius;
    double sum = 0, total = 0;
    bool meets_joint = false;
    std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
    queue.push({0.0, from});
    visited.clear();
    while (!queue.empty()) {
      const auto [distance, n] = queue.top();
      queue.pop();
      if (done[n]) continue;
      done[n] = 1;
      visited.push_back(n);
      const double share = weight[n] * (width > 0 ? 1 - distance / width : 1.0);
      sum += share * raw[n];
      total += share;
      meets_joint = meets_joint || is_joint(neighbours, n);
      // What lies beyond a joint is another arc.
      if (n != from && is_joint(neighbours, n)) continue;
      for (const Index k : neighbours[n]) {
        const double there = distance + (skeleton.nodes[n].position - skeleton.nodes[k].position).norm();
        if (!done[k] && there < width) queue.push({there, k});
      }
    }
    for (const Index n : visited) done[n] = 0;
    smooth[from] = total > 0 ? sum / total : raw[from];
    // A section through the middle of a ball is no shorter than the ball's circle. The slices at a flat end
    // may be: they go round its rim. Near a joint the ball may be that of a thicker arc.
    if (!meets_joint) smooth[from] = std::max(smooth[from], width);
  }
  take_from_arcs(neighbours, smooth);
  return smooth;
}

}  // namespace mspskel::detail
