// Makes the nodes of a tree of boxes.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "mspskel/base/clones.h"
#include "mspskel/base/progress.h"
#include "mspskel/base/types.h"
#include "mspskel/mesh/detail/box_node.h"

namespace mspskel {
namespace detail {

struct Bounds {
  Lanes low = all(std::numeric_limits<float>::max());
  Lanes high = all(std::numeric_limits<float>::lowest());

  void add(const Lanes& lo, const Lanes& hi) {
    low = smaller(low, lo);
    high = larger(high, hi);
  }
  float half_area() const {
    const Lanes size = high - low;
    return size[0] < 0 ? 0.0f : size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
};

inline Lanes low_of(const PrimitiveBox& b) { return load(b.low); }
inline Lanes high_of(const PrimitiveBox& b) { return load(b.high); }

// Where to cut [begin, end) in two, after reordering it: 16 bins along the longest axis of the centres.
MSPSKEL_AVX_CLONES inline Index split(PrimitiveBox* boxes, Index begin, Index end, bool halve) {
  constexpr int kBins = 16;
  Bounds centres;
  for (Index i = begin; i < end; ++i) {
    const Lanes twice = low_of(boxes[i]) + high_of(boxes[i]);
    centres.add(twice, twice);
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (centres.high[k] - centres.low[k] > centres.high[axis] - centres.low[axis]) axis = k;
  const float extent = centres.high[axis] - centres.low[axis];
  const Index middle = begin + (end - begin) / 2;
  if (!(extent > 0)) return middle;
  if (halve) {
    std::nth_element(boxes + begin, boxes + middle, boxes + end,
                     [&](const PrimitiveBox& a, const PrimitiveBox& b) {
                       return a.low[axis] + a.high[axis] < b.low[axis] + b.high[axis];
                     });
    return middle;
  }
  const float scale = kBins * 0.9999f / extent;
  const auto bin_of = [&](const PrimitiveBox& b) {
    return static_cast<int>((b.low[axis] + b.high[axis] - centres.low[axis]) * scale);
  };
  std::array<Bounds, kBins> bin;
  std::array<Index, kBins> count{};
  for (Index i = begin; i < end; ++i) {
    const int k = bin_of(boxes[i]);
    bin[k].add(low_of(boxes[i]), high_of(boxes[i]));
    ++count[k];
  }
  // cost[k]: of everything to the right of the cut after bin k; then swept from the left.
  std::array<float, kBins> cost{};
  Bounds sweep;
  Index swept = 0;
  for (int k = kBins - 1; k > 0; --k) {
    sweep.add(bin[k].low, bin[k].high);
    swept += count[k];
    cost[k - 1] = sweep.half_area() * static_cast<float>(swept);
  }
  int best = -1;
  sweep = Bounds();
  swept = 0;
  float best_cost = std::numeric_limits<float>::infinity();
  for (int k = 0; k + 1 < kBins; ++k) {
    sweep.add(bin[k].low, bin[k].high);
    swept += count[k];
    const float c = sweep.half_area() * static_cast<float>(swept) + cost[k];
    if (swept > 0 && swept < end - begin && c < best_cost) {
      best_cost = c;
      best = k;
    }
  }
  if (best < 0) return middle;
  PrimitiveBox* const cut =
      std::partition(boxes + begin, boxes + end, [&](const PrimitiveBox& b) { return bin_of(b) <= best; });
  return static_cast<Index>(cut - boxes);
}

// Makes nodes out of boxes, which it pads and reorders.
class BoxTreeBuilder {
 public:
  // `reach` bounds every coordinate's magnitude. Throws Cancelled.
  BoxTreeBuilder(std::vector<PrimitiveBox>& boxes, double reach, const ProgressCallback& progress)
      : boxes_(boxes), progress_(progress) {
    // Queries round their point to float as well: four units in the last place of the largest coordinate
    // cover both.
    const float pad = static_cast<float>(reach) * 0x1p-21f;
    for (PrimitiveBox& b : boxes)
      for (int k = 0; k < 3; ++k) {
        b.low[k] -= pad;
        b.high[k] += pad;
      }
    nodes_.reserve(boxes.size() / 4 + 1);
    slots_.reserve(boxes.size() + boxes.size() / 2);
    add_node(0, static_cast<Index>(boxes.size()), 0);
  }

  std::vector<BoxNode> take_nodes() { return std::move(nodes_); }  // the root first
  std::vector<Index> take_slots() { return std::move(slots_); }    // the primitive in each, or kNone

 private:
  static constexpr Index kPolled = 1024;  // fewer primitives take well below a millisecond

  // Of the boxes in [begin, end), with all nodes below it: its number.
  Index add_node(Index begin, Index end, int depth);

  std::vector<PrimitiveBox>& boxes_;
  const ProgressCallback& progress_;
  std::vector<BoxNode> nodes_;
  std::vector<Index> slots_;
};

inline Index BoxTreeBuilder::add_node(Index begin, Index end, int depth) {
  PrimitiveBox* const boxes = boxes_.data();
  if (end - begin > kPolled)
    report_progress(progress_, "hierarchy", static_cast<double>(begin) / static_cast<double>(boxes_.size()));
  struct Range {
    Index begin, end;
    Bounds bounds;
  };
  const auto make_range = [&](Index b, Index e) {
    Range r{b, e, {}};
    for (Index i = b; i < e; ++i) r.bounds.add(low_of(boxes[i]), high_of(boxes[i]));
    return r;
  };
  std::array<Range, 4> range;
  int ranges = 1;
  range[0] = make_range(begin, end);
  while (ranges < 4) {
    int widest = -1;
    for (int r = 0; r < ranges; ++r)
      if (range[r].end - range[r].begin > kBoxLeafSize &&
          (widest < 0 || range[r].bounds.half_area() > range[widest].bounds.half_area()))
        widest = r;
    if (widest < 0) break;
    // Halving below a depth that no sensible surface needs bounds the traversals' stacks.
    const Index b = range[widest].begin, e = range[widest].end, cut = split(boxes, b, e, depth > 32);
    range[widest] = make_range(b, cut);
    range[ranges++] = make_range(cut, e);
  }
  const Index node = static_cast<Index>(nodes_.size());
  nodes_.emplace_back();
  for (int r = 0; r < 4; ++r) {
    const Bounds bounds = r < ranges ? range[r].bounds : Bounds();
    for (int k = 0; k < 3; ++k) {
      nodes_[node].low[k][r] = bounds.low[k];
      nodes_[node].high[k][r] = bounds.high[k];
    }
    nodes_[node].child[r] = nodes_[node].count[r] = 0;
  }
  for (int r = 0; r < ranges; ++r) {
    const Index size = range[r].end - range[r].begin;
    Index child = static_cast<Index>(slots_.size());
    if (size > kBoxLeafSize) {
      child = add_node(range[r].begin, range[r].end, depth + 1);
    } else {
      for (Index i = 0; i < kBoxLeafSize; ++i)
        slots_.push_back(i < size ? boxes[range[r].begin + i].primitive : kNone);
      nodes_[node].count[r] = size;
    }
    nodes_[node].child[r] = child;
  }
  return node;
}

}  // namespace detail
}  // namespace mspskel
