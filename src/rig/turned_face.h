// Faces that a turned joint would turn over.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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
  bool turns_over(const Vector3& joint, const std::array<double, 3>& weight) const {
    return !is_surely_safe(joint, weight) && may_turn_over(joint, weight);
  }

 private:
  // What is r from the axis, turned by 45 degrees, moves by this times r.
  static constexpr double kMove = 0.76536686473017954;
  // By its mean weight the face is turned and shrunk, to at least cos(22.5 degrees)^2 of its area. What else
  // happens to its longest edge and to the height above it must leave a tenth of the area.
  static constexpr double kLeastLeft = 0.1;
  static constexpr double kSafe = 0.85355339059327376 - kLeastLeft;

  bool is_surely_safe(const Vector3& joint, const std::array<double, 3>& weight) const;
  bool may_turn_over(const Vector3& joint, const std::array<double, 3>& weight) const;
  bool is_safe(double far, const std::array<double, 3>& weight) const;
  bool turns_over_about_axes(const Vector3& joint, const std::array<double, 3>& weight) const;

  const Vector3& x(std::size_t k) const { return *corner_[k]; }

  std::array<const Vector3*, 3> corner_;
  Vector3 normal_, middle_;  // the normal is twice the area long
  std::size_t p_ = 0;        // where the longest edge begins
  double length_ = 0;        // of that edge
  double height_ = 0;        // above it
  double foot_ = 0;          // of the height, as a share of the edge
  // Of what is_surely_safe needs for each joint: 1 / length, 1 / height, and with the edge over the height as
  // x: x, and the root of 1 + x^2.
  double per_length_ = 0, per_height_ = 0, flat_ = 0, slant_ = 0;
};

// What is_safe asks, where bows are the most that they can be: a corner is at most 2/3 of the longest edge
// from the middle, its weight 2/3 of the change from the mean. That is enough for most faces, so it is
// inline.
inline bool TurnedFace::is_surely_safe(const Vector3& joint, const std::array<double, 3>& weight) const {
  const std::size_t p = p_, q = p == 2 ? 0 : p + 1, r = p == 0 ? 2 : p - 1;
  const double along = weight[q] - weight[p], across = weight[r] - weight[p];
  const double e = along * per_length_, h = (across - foot_ * along) * per_height_;
  const double both = kMove * std::sqrt((middle_ - joint).squaredNorm() * (e * e + h * h));
  const double change = std::max({0.0, along, across}) - std::min({0.0, along, across});
  const double bow = kMove * 8 / 9 * change;
  return both * (1 + bow * slant_) + bow * (1 + flat_ + bow * flat_) <= kSafe;
}

}  // namespace mspskel::detail
