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

double change_of(const std::array<double, 3>& weight) {
  return std::max({weight[0], weight[1], weight[2]}) - std::min({weight[0], weight[1], weight[2]});
}

// A line each; the last one is there twice, since lines are computed in pairs.
using Axes = Eigen::Matrix<double, 14, 3>;

const Axes& axes() {
  static const Axes all = [] {
    Axes made;
    Index count = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (count < 13) made.row(count++) = Vector3(x, y, z).normalized();
    made.row(13) = made.row(12);
    return made;
  }();
  return all;
}

}  // namespace

TurnedFace::TurnedFace(const Vector3& a, const Vector3& b, const Vector3& c)
    : corner_{&a, &b, &c}, middle_((a + b + c) * (1.0 / 3)) {
  const Vector3 ab = b - a, ca = a - c;
  const std::array<double, 3> square{ab.squaredNorm(), (c - b).squaredNorm(), ca.squaredNorm()};
  normal_ = ca.cross(ab);
  for (std::size_t k = 1; k < 3; ++k)
    if (square[k] > square[p_]) p_ = k;
  length_ = std::sqrt(square[p_]);
  height_ = square[p_] > 0 ? normal_.norm() / length_ : 0;
}

bool TurnedFace::turns_over(const Vector3& joint, const std::array<double, 3>& weight) const {
  if (!(height_ > 0)) return false;
  const double far = (middle_ - joint).norm();
  return !is_gentle(far, weight) && !is_safe(far, weight) && turns_over_about_axes(joint, weight);
}

// With the parts of is_safe replaced by the most that they can be where weights differ by so much.
bool TurnedFace::is_gentle(double far, const std::array<double, 3>& weight) const {
  return kMove * change_of(weight) * (1.33 * far + 2.95 * length_) <= 0.6 * height_;
}

// Whatever the axis. With p and q the ends of the longest edge, r the third corner and t where its height
// stands on the edge: where weights change evenly along the edge and r has that of its foot, what is farther
// along turns by more, so r leaves the line through p and q by a bow.
bool TurnedFace::is_safe(double far, const std::array<double, 3>& weight) const {
  const std::size_t p = p_, q = (p_ + 1) % 3, r = (p_ + 2) % 3;
  const double t = (x(r) - x(p)).dot(x(q) - x(p)) / (length_ * length_), whole = mean(weight);
  const double along = weight[q] - weight[p], across = weight[r] - weight[p] - t * along;
  // As shares of edge and height, each with its bow.
  const double e = kMove * std::abs(along) * far / length_, h = kMove * std::abs(across) * far / height_;
  const auto is_little = [&](double f, double g) {
    return std::sqrt(e * e + h * h) + f + g + e * g + f * h + f * g <= kSafe;
  };
  // A corner is at most 2/3 of the longest edge from the middle, its weight 2/3 of the change from the mean.
  const double most = kMove * 8 / 9 * change_of(weight);
  if (is_little(most, most * length_ / height_)) return true;
  const auto bow = [&](std::size_t k) -> Vector3 { return (weight[k] - whole) * (x(k) - middle_); };
  const Vector3 edge_bow = bow(q) - bow(p), height_bow = bow(r) - bow(p) - t * edge_bow;
  return is_little(kMove * edge_bow.norm() / length_, kMove * height_bow.norm() / height_);
}

bool TurnedFace::turns_over_about_axes(const Vector3& joint, const std::array<double, 3>& weight) const {
  const double c = 1 - std::cos(kAngle), s = std::sin(kAngle);
  const Vector3 first = weight[0] * (x(0) - joint), &n = normal_;
  const Vector3 v = weight[1] * (x(1) - joint) - first, w = weight[2] * (x(2) - joint) - first;
  const Vector3 a = x(1) - x(0) - c * v, b = x(2) - x(0) - c * w, ab = a.cross(b);
  const double skew = a.dot(w) - b.dot(v);

  Eigen::Matrix<double, 3, 12> vectors;
  vectors << v, w, a, b, n, ab, v.cross(w), n.cross(v), n.cross(w), n.cross(a), n.cross(b), n.cross(ab);
  const Eigen::Array<double, 14, 12> dots = axes().lazyProduct(vectors).array();
  const auto on_v = dots.col(0), on_w = dots.col(1), on_a = dots.col(2), on_b = dots.col(3),
             on_n = dots.col(4), on_ab = dots.col(5), on_vw = dots.col(6);
  // Of the axis' cross product with the normal, with each of the vectors.
  const auto side_v = dots.col(7), side_w = dots.col(8), side_a = dots.col(9), side_b = dots.col(10),
             side_ab = dots.col(11);

  using PerAxis = Eigen::Array<double, 14, 1>;
  const PerAxis level_a = on_a + c * on_v, level_b = on_b + c * on_w, along = s * s * on_vw;
  const PerAxis both_n = ab.dot(n) + c * (on_w * side_a - on_v * side_b) + along * on_n;
  const PerAxis both_side = side_ab + c * (on_w * (on_a * on_n - a.dot(n)) - on_v * (on_b * on_n - b.dot(n)));
  const PerAxis by_side_n = s * (skew * on_n - w.dot(n) * level_a + v.dot(n) * level_b);
  const PerAxis by_side_on = s * (skew - on_w * level_a + on_v * level_b);
  const PerAxis by_side_side = s * (side_v * level_b - side_w * level_a);

  const double whole = mean(weight), cosine = std::cos(kAngle * whole), sine = std::sin(kAngle * whole);
  const PerAxis still = cosine * both_n + (1 - cosine) * on_n * (on_ab + along) + sine * by_side_side;
  const PerAxis turned = cosine * by_side_n + (1 - cosine) * on_n * by_side_on + sine * both_side;
  return (still - turned.abs()).minCoeff() < kLeastLeft * n.squaredNorm();
}

}  // namespace mspskel::detail
