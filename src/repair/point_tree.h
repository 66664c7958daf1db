#pragma once

#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Points by halves, along the longest side of their box in turn: finds those near a place.
class PointTree {
 public:
  PointTree(const std::vector<Vector3>& points, std::vector<Index> members);
  // Calls visit(point) for every member within the distance.
  template <class Visit>
  void each_within(const Vector3& place, double distance, Visit visit) const {
    if (!members_.empty()) search(0, static_cast<Index>(members_.size()), place, distance, visit);
  }

 private:
  void build(Index begin, Index end);
  template <class Visit>
  void search(Index begin, Index end, const Vector3& place, double distance, Visit& visit) const {
    const Index middle = begin + (end - begin) / 2;
    const Vector3& p = points_[members_[middle]];
    if ((p - place).norm() <= distance) visit(members_[middle]);
    const double side = place[axis_[middle]] - p[axis_[middle]];
    if (begin < middle && side <= distance) search(begin, middle, place, distance, visit);
    if (middle + 1 < end && -side <= distance) search(middle + 1, end, place, distance, visit);
  }

  const std::vector<Vector3>& points_;
  std::vector<Index> members_;
  std::vector<signed char> axis_;
};

}  // namespace mspskel::detail
