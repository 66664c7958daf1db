#include "turned_face.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mspskel::detail {
namespace {

constexpr double kAngle = kPi / 4;

// Of the face's area.
constexpr double kLeastLeft = 0.1;

// What is r from the axis moves by this times r.
const double kMove = 2 * std::sin(kAngle / 2);

// By its mean weight the face is turned and shrunk, to at least cos(22.5 degrees)^2 of its area. What else
// happens to its longest edge and to the height above it must be less than that.
const double kSafe = std::pow(std::cos(kAngle / 2), 2) - kLeastLeft;

double mean(const std::array<double, 3>& weight) { return (weight[0] + weight[1] + weight[2]) / 3; }

const std::array<Vector3, 13>& axes() {
  static const std::array<Vector3, 13> all = [] {
    std::array<Vector3, 13> made;
    std::size_t count = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (count < made.size()) made[count++] = Vector3(x, y, z).normalized();
    return made;
  }();
  return all;
}

}  // namespace

TurnedFace::TurnedFace(const std::array<Vector3, 3>& corner)
    : x_(corner),
      normal_((corner[1] - corner[0]).cross(corner[2] - corner[0])),
      middle_((corner[0] + corner[1] + corner[2]) / 3) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (const double length = (x_[(k + 1) % 3] - x_[k]).squaredNorm(); length > square) {
      square = length;
      p_ = k;
    }
  length_ = std::sqrt(square);
  height_ = square > 0 ? normal_.norm() / length_ : 0;
}

bool TurnedFace::turns_over(const Vector3& joint, const std::array<double, 3>& weight) const {
  if (!(height_ > 0)) return false;
  const double far = (middle_ - joint).norm();
  return !is_gentle(far, weight) && !is_safe(far, weight) && turns_over_about_axes(joint, weight);
}

// With the parts of is_safe replaced by the most that they can be where weights differ by so much.
bool TurnedFace::is_gentle(double far, const std::array<double, 3>& weight) const {
  const double change =
      std::max({weight[0], weight[1], weight[2]}) - std::min({weight[0], weight[1], weight[2]});
  return kMove * change * (1.33 * far + 2.95 * length_) <= 0.6 * height_;
}

// Whatever the axis. With p and q the ends of the longest edge, r the third corner and t where its height
// stands on the edge: where weights change evenly along the edge and r has that of its foot, what is farther
// along turns by more, so r leaves the line through p and q by a bow.
bool TurnedFace::is_safe(double far, const std::array<double, 3>& weight) const {
  const std::size_t p = p_, q = (p_ + 1) % 3, r = (p_ + 2) % 3;
  const double t = (x_[r] - x_[p]).dot(x_[q] - x_[p]) / (length_ * length_), whole = mean(weight);
  const double along = weight[q] - weight[p], across = weight[r] - weight[p] - t * along;
  const auto bow = [&](std::size_t k) -> Vector3 { return (weight[k] - whole) * (x_[k] - middle_); };
  const Vector3 edge_bow = bow(q) - bow(p), height_bow = bow(r) - bow(p) - t * edge_bow;
  // As shares of edge and height.
  const double e = kMove * std::abs(along) * far / length_, h = kMove * std::abs(across) * far / height_,
               f = kMove * edge_bow.norm() / length_, g = kMove * height_bow.norm() / height_;
  return std::sqrt(e * e + h * h) + f + g + e * g + f * h + f * g <= kSafe;
}

bool TurnedFace::turns_over_about_axes(const Vector3& joint, const std::array<double, 3>& weight) const {
  const double whole = mean(weight), cosine = std::cos(kAngle * whole), sine = std::sin(kAngle * whole);
  const double least = kLeastLeft * normal_.squaredNorm();
  for (const Vector3& axis : axes()) {
    // A turn by the angle brings a corner to `level` plus `side`, one the other way to `level` minus `side`.
    std::array<Vector3, 3> level, side;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 arm = x_[k] - joint, to_side = axis.cross(arm);
      side[k] = std::sin(kAngle) * weight[k] * to_side;
      level[k] = arm + (1 - std::cos(kAngle)) * weight[k] * axis.cross(to_side);
    }
    const Vector3 a = level[1] - level[0], b = level[2] - level[0], c = side[1] - side[0],
                  d = side[2] - side[0];
    const Vector3 both = a.cross(b) + c.cross(d), by_side = a.cross(d) + c.cross(b);
    const Vector3 stays = cosine * normal_ + (1 - cosine) * axis.dot(normal_) * axis,
                  turns = sine * axis.cross(normal_);
    if ((both + by_side).dot(stays + turns) < least || (both - by_side).dot(stays - turns) < least)
      return true;
  }
  return false;
}

}  // namespace mspskel::detail
