// Boxes with four children each over numbered primitives, and the traversals: by distance from a point, along
// a ray, through a box.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "mspskel/base/clones.h"
#include "mspskel/base/progress.h"
#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

using Float3 = std::array<float, 3>;

// Four numbers at once, for local use: stored as plain arrays, so that no public type has an alignment that
// depends on compiler flags.
using Lanes = float __attribute__((vector_size(16), may_alias));
inline Lanes load(const float* four) { return *reinterpret_cast<const Lanes*>(four); }
inline void store(const Lanes& lanes, float* four) { *reinterpret_cast<Lanes*>(four) = lanes; }
inline Lanes all(float x) { return Lanes{x, x, x, x}; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
inline Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

// Bit k is set where lane k of a is at most that of b.
inline unsigned at_most(const Lanes& a, const Lanes& b) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a, b)));
#else
  unsigned mask = 0;
  for (int k = 0; k < 4; ++k) mask |= static_cast<unsigned>(a[k] <= b[k]) << k;
  return mask;
#endif
}

// Both corners are read as four numbers, the last of which means nothing.
struct alignas(16) PrimitiveBox {
  float low[4], high[3];
  Index primitive;
};

// Children side by side, so that one query tests four boxes at once. A lane without a child has an inverted
// box.
struct alignas(64) BoxNode {
  float low[3][4], high[3][4];
  Index child[4];  // a node, or the first slot of a leaf
  Index count[4];  // 0: child is a node; else the number of slots in the leaf
};

class BoxTree {
 public:
  static constexpr Index kLeafSize = 4;

  // Reorders `boxes` and returns the primitive in each slot: leaf i has the slots 4i .. 4i + 3, the last ones
  // perhaps empty (kNone). `reach` bounds every coordinate's magnitude. Throws Cancelled.
  std::vector<Index> build(std::vector<PrimitiveBox>& boxes, double reach,
                           const ProgressCallback& progress = {});

  // Calls leaf(first, count) by growing distance from p as long as a box is nearer than `bound` (a squared
  // distance that the callback lowers).
  template <class Leaf>
  void by_distance(const Vector3& p, const double& bound, Leaf leaf) const;

  // Calls leaf(first, count) for the leaves along origin + t·direction, 0 <= t <= bound (a distance that the
  // callback may lower), roughly front to back; stops when the callback returns false. The direction has
  // length 1.
  template <class Leaf>
  void along_ray(const Vector3& origin, const Vector3& direction, const double& bound, Leaf leaf) const;

  // Calls leaf(first, count) for the leaves whose box meets the box [low, high]; stops when the callback
  // returns false.
  template <class Leaf>
  void in_box(const Vector3& low, const Vector3& high, Leaf leaf) const;

  // Of these, only the leaves whose box meets the plane normal · x = offset too.
  template <class Leaf>
  void in_box_on_plane(const Vector3& low, const Vector3& high, const Vector3& normal, double offset,
                       Leaf leaf) const;

 private:
  // Calls leaf(first, count) for the leaves below lanes whose bit is set in meets(node).
  template <class Meets, class Leaf>
  void where(Meets meets, Leaf leaf) const;

  static constexpr Index kPolled = 1024;  // fewer primitives take well below a millisecond

  struct Building {
    std::vector<PrimitiveBox>& boxes;
    const ProgressCallback& progress;
    std::vector<Index> slots;
  };
  Index build_node(Building& building, Index begin, Index end, int depth);

  std::vector<BoxNode> nodes_;
  double reach_ = 0.0;
};

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

inline std::vector<Index> BoxTree::build(std::vector<PrimitiveBox>& boxes, double reach,
                                         const ProgressCallback& progress) {
  nodes_.clear();
  nodes_.reserve(boxes.size() / 4 + 1);
  reach_ = reach;
  // Queries round their point to float as well: four units in the last place of the largest coordinate cover
  // both.
  const float pad = static_cast<float>(reach) * 0x1p-21f;
  for (PrimitiveBox& b : boxes)
    for (int k = 0; k < 3; ++k) {
      b.low[k] -= pad;
      b.high[k] += pad;
    }
  Building building{boxes, progress, {}};
  building.slots.reserve(boxes.size() + boxes.size() / 2);
  build_node(building, 0, static_cast<Index>(boxes.size()), 0);
  return std::move(building.slots);
}

inline Index BoxTree::build_node(Building& building, Index begin, Index end, int depth) {
  PrimitiveBox* const boxes = building.boxes.data();
  std::vector<Index>& slots = building.slots;
  if (end - begin > kPolled)
    report_progress(building.progress, "hierarchy",
                    static_cast<double>(begin) / static_cast<double>(building.boxes.size()));
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
      if (range[r].end - range[r].begin > kLeafSize &&
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
    Index child = static_cast<Index>(slots.size());
    if (size > kLeafSize) {
      child = build_node(building, range[r].begin, range[r].end, depth + 1);
    } else {
      for (Index i = 0; i < kLeafSize; ++i)
        slots.push_back(i < size ? boxes[range[r].begin + i].primitive : kNone);
      nodes_[node].count[r] = size;
    }
    nodes_[node].child[r] = child;
  }
  return node;
}

// Children that wait to be visited, the nearest on top.
class BoxStack {
 public:
  struct Entry {
    float key;
    Index child, count;
  };
  bool empty() const { return size_ == 0; }
  Entry pop() { return entry_[--size_]; }
  // Pushes the lanes whose bit is set, farthest first.
  void push(const BoxNode& node, const Lanes& keys, unsigned lanes) {
    alignas(16) float key[4];
    store(keys, key);
    const int bottom = size_;
    for (; lanes != 0; lanes &= lanes - 1) {
      const int k = __builtin_ctz(lanes);
      int slot = size_++;
      for (; slot > bottom && entry_[slot - 1].key < key[k]; --slot) entry_[slot] = entry_[slot - 1];
      entry_[slot] = {key[k], node.child[k], node.count[k]};
    }
  }
  void push_root() { entry_[size_++] = {0.0f, 0, 0}; }

 private:
  // Three waiting siblings a level; 33 levels by area, then at most 16 by halving.
  Entry entry_[3 * 64];
  int size_ = 0;
};

template <class Leaf>
void BoxTree::by_distance(const Vector3& p, const double& bound, Leaf leaf) const {
  const float q[3] = {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
  // Rounding in single precision may not make a box look farther than it is; lanes without a child always do.
  const auto limit_of = [](double square) { return static_cast<float>(std::min(square * (1 + 4e-6), 1e38)); };
  float limit = limit_of(bound);
  BoxStack stack;
  stack.push_root();
  while (!stack.empty()) {
    const BoxStack::Entry top = stack.pop();
    if (top.key > limit) continue;
    if (top.count > 0) {
      leaf(top.child, top.count);
      limit = limit_of(bound);
      continue;
    }
    const BoxNode& node = nodes_[top.child];
    Lanes square = {};
    for (int a = 0; a < 3; ++a) {
      const Lanes outside = larger(larger(load(node.low[a]) - q[a], q[a] - load(node.high[a])), Lanes{});
      square += outside * outside;
    }
    stack.push(node, square, at_most(square, all(limit)));
  }
}

template <class Leaf>
void BoxTree::along_ray(const Vector3& origin, const Vector3& direction, const double& bound,
                        Leaf leaf) const {
  // A far origin slides along the ray to just before the boxes, where single precision suffices.
  double slid = 0.0;
  if (origin.cwiseAbs().maxCoeff() > 2 * reach_) {
    slid = -origin.dot(direction);
    if (slid <= 0 || (origin + slid * direction).cwiseAbs().maxCoeff() > 2 * reach_) return;
    slid -= 2 * reach_;
  }
  const Vector3 start = origin + slid * direction;
  float o[3], inverse[3];
  for (int a = 0; a < 3; ++a) {
    o[a] = static_cast<float>(start[a]);
    const double d = direction[a];
    inverse[a] = static_cast<float>(std::abs(d) > 1e-30 ? 1.0 / d : std::copysign(1e30, d));
  }
  const auto limit_of = [&](double distance) {
    return static_cast<float>(std::min(distance - slid, 1e30)) * (1.0f + 1e-6f);
  };
  float limit = limit_of(bound);
  BoxStack stack;
  stack.push_root();
  while (!stack.empty()) {
    const BoxStack::Entry top = stack.pop();
    if (top.key > limit) continue;
    if (top.count > 0) {
      if (!leaf(top.child, top.count)) return;
      limit = limit_of(bound);
      continue;
    }
    const BoxNode& node = nodes_[top.child];
    Lanes in = {}, out = all(limit);
    for (int a = 0; a < 3; ++a) {
      in = larger(in, (load(inverse[a] < 0 ? node.high[a] : node.low[a]) - o[a]) * inverse[a]);
      out = smaller(out, (load(inverse[a] < 0 ? node.low[a] : node.high[a]) - o[a]) * inverse[a]);
    }
    stack.push(node, in, at_most(in, out * (1.0f + 1e-6f)));
  }
}

// Which lanes of a node meet a box.
class MeetsBox {
 public:
  MeetsBox(const Vector3& low, const Vector3& high) {
    for (int a = 0; a < 3; ++a) {  // rounding is covered by the padding of the boxes
      low_[a] = static_cast<float>(low[a]);
      high_[a] = static_cast<float>(high[a]);
    }
  }
  unsigned operator()(const BoxNode& node) const {
    unsigned meets = 15;
    for (int a = 0; a < 3; ++a)
      meets &= at_most(load(node.low[a]), all(high_[a])) & at_most(all(low_[a]), load(node.high[a]));
    return meets;
  }

 private:
  float low_[3], high_[3];
};

template <class Meets, class Leaf>
void BoxTree::where(Meets meets, Leaf leaf) const {
  BoxStack stack;
  stack.push_root();
  while (!stack.empty()) {
    const BoxStack::Entry top = stack.pop();
    if (top.count > 0) {
      if (!leaf(top.child, top.count)) return;
      continue;
    }
    const BoxNode& node = nodes_[top.child];
    stack.push(node, Lanes{}, meets(node));
  }
}

template <class Leaf>
void BoxTree::in_box(const Vector3& low, const Vector3& high, Leaf leaf) const {
  where(MeetsBox(low, high), leaf);
}

template <class Leaf>
void BoxTree::in_box_on_plane(const Vector3& low, const Vector3& high, const Vector3& normal, double offset,
                              Leaf leaf) const {
  const MeetsBox meets_box(low, high);
  float n[3];
  for (int a = 0; a < 3; ++a) n[a] = static_cast<float>(normal[a]);
  // The heights of a box's lowest and highest corner are sums of three products in single precision.
  const float margin = static_cast<float>(reach_) * 0x1p-19f, at = static_cast<float>(offset);
  where(
      [&](const BoxNode& node) {
        const unsigned lanes = meets_box(node);
        if (lanes == 0) return lanes;
        Lanes lowest = all(-margin), highest = all(margin);
        for (int a = 0; a < 3; ++a) {
          lowest += n[a] * load(n[a] < 0 ? node.high[a] : node.low[a]);
          highest += n[a] * load(n[a] < 0 ? node.low[a] : node.high[a]);
        }
        return lanes & at_most(lowest, all(at)) & at_most(all(at), highest);
      },
      leaf);
}

}  // namespace detail
}  // namespace mspskel
