#include "point_tree.h"

#include <algorithm>

namespace mspskel::detail {

PointTree::PointTree(const std::vector<Vector3>& points, std::vector<Index> members)
    : points_(points), members_(std::move(members)), axis_(members_.size(), 0) {
  build(0, static_cast<Index>(members_.size()));
}

void PointTree::build(Index begin, Index end) {
  if (begin >= end) return;
  Vector3 low = points_[members_[begin]], high = low;
  for (Index i = begin; i < end; ++i) {
    low = low.cwiseMin(points_[members_[i]]);
    high = high.cwiseMax(points_[members_[i]]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(
      members_.begin() + begin, members_.begin() + middle, members_.begin() + end, [&](Index a, Index b) {
        return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
      });
  axis_[middle] = static_cast<signed char>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

}  // namespace mspskel::detail
