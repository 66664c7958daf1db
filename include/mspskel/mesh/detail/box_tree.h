// A tree of boxes over numbered primitives, and the traversals: by distance from a point, along a ray or a
// fan of rays, through a box, between two planes.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/base/types.h"
#include "mspskel/mesh/detail/box_node.h"
#include "mspskel/mesh/detail/box_tree_builder.h"

namespace mspskel {
namespace detail {

class BoxFan;

class BoxTree {
 public:
  static constexpr Index kLeafSize = kBoxLeafSize;

  // Reorders `boxes` and returns the primitive in each slot: leaf i has the slots 4i .. 4i + 3, the last ones
  // perhaps empty (kNone). `reach` bounds every coordinate's magnitude. Throws Cancelled.
  std::vector<Index> build(std::vector<PrimitiveBox>& boxes, double reach,
                           const ProgressCallback& progress = {}) {
    BoxTreeBuilder builder(boxes, reach, progress);
    nodes_ = builder.take_nodes();
    reach_ = reach;
    return builder.take_slots();
  }

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

  // The same leaves with their boxes, if there is room for them.
  bool collect_on_plane(const Vector3& low, const Vector3& high, const Vector3& normal, double offset,
                        BoxFan& fan) const;

  // Calls leaf(first, count) for the leaves whose box meets the slab low <= normal · x <= high; stops when
  // the callback returns false. The normal has length 1.
  template <class Leaf>
  void in_slab(const Vector3& normal, double low, double high, Leaf leaf) const;

 private:
  // Calls leaf(first, count) for the leaves below lanes whose bit is set in meets(node).
  template <class Meets, class Leaf>
  void where(Meets meets, Leaf leaf) const;

  std::vector<BoxNode> nodes_;
  double reach_ = 0.0;
};

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

// A ray against the four boxes of a node. The origin is near the boxes, where single precision suffices.
class BoxRay {
 public:
  BoxRay(const Vector3& origin, const Vector3& direction) {
    for (int a = 0; a < 3; ++a) {
      origin_[a] = static_cast<float>(origin[a]);
      const double d = direction[a];
      inverse_[a] = static_cast<float>(std::abs(d) > 1e-30 ? 1.0 / d : std::copysign(1e30, d));
    }
  }
  // A limit for what follows, a little farther than the distance.
  static float limit_of(double distance) {
    return static_cast<float>(std::min(distance, 1e30)) * (1.0f + 1e-6f);
  }
  // The lanes whose box the ray meets within the limit, and where it enters them.
  unsigned meets(const BoxNode& node, float limit, Lanes& in) const {
    Lanes out = all(limit);
    in = Lanes{};
    for (int a = 0; a < 3; ++a) {
      in = larger(in, (load(inverse_[a] < 0 ? node.high[a] : node.low[a]) - origin_[a]) * inverse_[a]);
      out = smaller(out, (load(inverse_[a] < 0 ? node.low[a] : node.high[a]) - origin_[a]) * inverse_[a]);
    }
    return at_most(in, out * (1.0f + 1e-6f));
  }

 private:
  float origin_[3], inverse_[3];
};

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
  const BoxRay ray(origin + slid * direction, direction);
  float limit = BoxRay::limit_of(bound - slid);
  BoxStack stack;
  stack.push_root();
  while (!stack.empty()) {
    const BoxStack::Entry top = stack.pop();
    if (top.key > limit) continue;
    if (top.count > 0) {
      if (!leaf(top.child, top.count)) return;
      limit = BoxRay::limit_of(bound - slid);
      continue;
    }
    const BoxNode& node = nodes_[top.child];
    Lanes in;
    const unsigned lanes = ray.meets(node, limit, in);
    stack.push(node, in, lanes);
  }
}

// The leaves of a tree that a fan of rays can meet, side by side: so few that each ray looks at all of them.
class BoxFan {
 public:
  void clear() { size_ = 0; }
  // False when it is full.
  bool add(const BoxNode& node, int lane) {
    if (size_ == kMost) return false;
    BoxNode& to = nodes_[size_ / 4];
    const int k = size_++ % 4;
    if (k == 0)
      for (int a = 0; a < 3; ++a) {
        store(all(1e30f), to.low[a]);
        store(all(-1e30f), to.high[a]);
      }
    for (int a = 0; a < 3; ++a) {
      to.low[a][k] = node.low[a][lane];
      to.high[a][k] = node.high[a][lane];
    }
    to.child[k] = node.child[lane];
    to.count[k] = node.count[lane];
    return true;
  }
  // As BoxTree::along_ray, in no order, for a ray of the fan.
  template <class Leaf>
  void along_ray(const Vector3& origin, const Vector3& direction, const double& bound, Leaf leaf) const {
    const BoxRay ray(origin, direction);
    for (int first = 0; first < size_; first += 4) {
      const BoxNode& node = nodes_[first / 4];
      Lanes in;
      for (unsigned lanes = ray.meets(node, BoxRay::limit_of(bound), in); lanes != 0; lanes &= lanes - 1) {
        const int k = __builtin_ctz(lanes);
        if (!leaf(node.child[k], node.count[k])) return;
      }
    }
  }

 private:
  static constexpr int kMost = 32;  // beyond, the tree is faster
  BoxNode nodes_[kMost / 4];
  int size_ = 0;
};

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

// Which lanes of a node meet the slab low <= normal · x <= high. The heights of a box's lowest and highest
// corner are sums of three products in single precision, where no coordinate is beyond `reach`.
class MeetsSlab {
 public:
  MeetsSlab(const Vector3& normal, double low, double high, double reach)
      : low_(static_cast<float>(low)),
        high_(static_cast<float>(high)),
        margin_(static_cast<float>(reach) * 0x1p-19f) {
    for (int a = 0; a < 3; ++a) normal_[a] = static_cast<float>(normal[a]);
  }
  unsigned operator()(const BoxNode& node) const {
    Lanes lowest = all(-margin_), highest = all(margin_);
    for (int a = 0; a < 3; ++a) {
      lowest += normal_[a] * load(normal_[a] < 0 ? node.high[a] : node.low[a]);
      highest += normal_[a] * load(normal_[a] < 0 ? node.low[a] : node.high[a]);
    }
    return at_most(lowest, all(high_)) & at_most(all(low_), highest);
  }

 private:
  float normal_[3], low_, high_, margin_;
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

// Which lanes of a node meet a box and a plane.
class MeetsBoxOnPlane {
 public:
  MeetsBoxOnPlane(const Vector3& low, const Vector3& high, const Vector3& normal, double offset, double reach)
      : box_(low, high), plane_(normal, offset, offset, reach) {}
  unsigned operator()(const BoxNode& node) const {
    const unsigned lanes = box_(node);
    return lanes == 0 ? lanes : lanes & plane_(node);
  }

 private:
  MeetsBox box_;
  MeetsSlab plane_;
};

template <class Leaf>
void BoxTree::in_box_on_plane(const Vector3& low, const Vector3& high, const Vector3& normal, double offset,
                              Leaf leaf) const {
  where(MeetsBoxOnPlane(low, high, normal, offset, reach_), leaf);
}

inline bool BoxTree::collect_on_plane(const Vector3& low, const Vector3& high, const Vector3& normal,
                                      double offset, BoxFan& fan) const {
  const MeetsBoxOnPlane meets(low, high, normal, offset, reach_);
  fan.clear();
  Index waiting[3 * 64];  // as many as BoxStack has
  int size = 0;
  waiting[size++] = 0;
  while (size > 0) {
    const BoxNode& node = nodes_[waiting[--size]];
    for (unsigned lanes = meets(node); lanes != 0; lanes &= lanes - 1) {
      const int k = __builtin_ctz(lanes);
      if (node.count[k] == 0)
        waiting[size++] = node.child[k];
      else if (!fan.add(node, k))
        return false;
    }
  }
  return true;
}

template <class Leaf>
void BoxTree::in_slab(const Vector3& normal, double low, double high, Leaf leaf) const {
  where(MeetsSlab(normal, low, high, reach_), leaf);
}

}  // namespace detail
}  // namespace mspskel
