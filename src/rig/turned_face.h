// Faces that a turned joint would turn over.
#pragma once

#include <array>
#include <cstddef>

#include "mspskel/base/types.h"

namespace mspskel::detail {

class TurnedFace {
 public:
  // Keeps the addresses of the corners.
  TurnedFace(const Vector3& a, const Vector3& b, const Vector3& c);

  // Whether the joint, turned by 45 degrees about some axis, leaves less than a tenth of the face's area on
  // the side that it shows: that which the turn by the mean of its corners' weights gives it. What is safe
  // about each axis is told first; others are turned about 13 axes, of which each axis has one within 28
  // degrees. A face without area does not turn over.
  bool turns_over(const Vector3& joint, const std::array<double, 3>& weight) const;

 private:
  // The weights differ by `change` at most.
  bool is_gentle(double far, double change) const;
  bool is_safe(double far, double change, const std::array<double, 3>& weight) const;
  bool turns_over_about_axes(const Vector3& joint, const std::array<double, 3>& weight) const;

  const Vector3& x(std::size_t k) const { return *corner_[k]; }

  std::array<const Vector3*, 3> corner_;
  Vector3 normal_, middle_;  // the normal is twice the area long
  std::size_t p_ = 0;        // where the longest edge begins
  double length_ = 0;        // of that edge
  double height_ = 0;        // above it
  double foot_ = 0;          // of the height, as a share of the edge
};

}  // namespace mspskel::detail
