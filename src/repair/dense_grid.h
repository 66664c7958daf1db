#pragma once

#include <array>
#include <cmath>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Nodes of a box by one number, along x first.
class DenseGrid {
 public:
  DenseGrid() = default;
  DenseGrid(const Vector3& low, const Vector3& high, double side) : low_(low), side_(side) {
    for (int k = 0; k < 3; ++k) size_[k] = static_cast<Index>(std::ceil((high[k] - low[k]) / side)) + 1;
  }
  Index count() const { return size_[0] * size_[1] * size_[2]; }
  Index size(int axis) const { return size_[axis]; }
  Index stride(int axis) const { return axis == 0 ? 1 : axis == 1 ? size_[0] : size_[0] * size_[1]; }
  Index coordinate(Index node, int axis) const { return node / stride(axis) % size_[axis]; }
  Index node(Index x, Index y, Index z) const { return (z * size_[1] + y) * size_[0] + x; }
  Vector3 place(Index node) const {
    return low_ + side_ * Vector3(coordinate(node, 0), coordinate(node, 1), coordinate(node, 2));
  }
  double side() const { return side_; }
  // The node at or below p along the axis.
  Index below(double p, int axis) const {
    const double steps = std::floor((p - low_[axis]) / side_);
    return static_cast<Index>(std::fmin(std::fmax(steps, 0), size_[axis] - 1));
  }
  // Calls visit(neighbour) for the nodes one step away along an axis.
  template <class Visit>
  void each_neighbour(Index node, Visit visit) const {
    for (int k = 0; k < 3; ++k) {
      const Index at = coordinate(node, k);
      if (at > 0) visit(node - stride(k));
      if (at + 1 < size_[k]) visit(node + stride(k));
    }
  }

 private:
  Vector3 low_ = Vector3::Zero();
  double side_ = 1;
  std::array<Index, 3> size_{0, 0, 0};
};

}  // namespace mspskel::detail
