// Numbered boxes, and which of them a box or a slab may meet.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "mspskel/mesh/detail/box_tree.h"

namespace mspskel {
namespace detail {

// Whether a segment whose own box meets the box [low, high] may meet that, by the axes across the segment and
// an edge of the box; no more than rounding is missed on the far side.
inline bool segment_may_meet_box(const Vector3& a, const Vector3& b, const Vector3& low,
                                 const Vector3& high) {
  constexpr double kRounding = 1e-9;
  const Vector3 half = (b - a) / 2, way = a + half - (low + high) / 2, size = (high - low) / 2;
  const double slack = kRounding * (half.squaredNorm() + size.squaredNorm());
  for (Index k = 0; k < 3; ++k) {
    const Index i = (k + 1) % 3, j = (k + 2) % 3;
    const double reach = size[i] * std::abs(half[j]) + size[j] * std::abs(half[i]);
    if (std::abs(way[i] * half[j] - way[j] * half[i]) > reach + slack) return false;
  }
  return true;
}

class BoxIndex {
 public:
  // Box i is from low to high. Cost: O(n log n).
  void add(Index i, const Vector3& low, const Vector3& high) {
    PrimitiveBox box;
    for (Index k = 0; k < 3; ++k) {
      // Rounded outward to single precision.
      box.low[k] = std::nextafter(static_cast<float>(low[k]), -std::numeric_limits<float>::infinity());
      box.high[k] = std::nextafter(static_cast<float>(high[k]), std::numeric_limits<float>::infinity());
    }
    box.low[3] = 0;
    box.primitive = i;
    reach_ = std::max({reach_, low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()});
    boxes_.push_back(box);
  }

  // Once, after all boxes are in.
  void build() {
    if (!boxes_.empty()) slots_ = tree_.build(boxes_, reach_);
    boxes_ = {};
  }

  // Calls visit(i) for the boxes that [low, high] may meet, in no order that means anything.
  template <class Visit>
  void in_box(const Vector3& low, const Vector3& high, Visit visit) const {
    if (slots_.empty()) return;
    tree_.in_box(low, high, [&](Index first, Index count) { return visit_leaf(first, count, visit); });
  }

  // The same for the boxes that low <= normal · x <= high may meet (unit normal).
  template <class Visit>
  void in_slab(const Vector3& normal, double low, double high, Visit visit) const {
    if (slots_.empty()) return;
    tree_.in_slab(normal, low, high,
                  [&](Index first, Index count) { return visit_leaf(first, count, visit); });
  }

 private:
  template <class Visit>
  bool visit_leaf(Index first, Index count, Visit& visit) const {
    for (Index slot = first; slot < first + count; ++slot)
      if (slots_[slot] != kNone) visit(slots_[slot]);
    return true;
  }

  std::vector<PrimitiveBox> boxes_;  // until they are built
  double reach_ = 1.0;
  BoxTree tree_;
  std::vector<Index> slots_;
};

}  // namespace detail
}  // namespace mspskel
