#include "turned_face.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mspskel/base/clones.h"

namespace mspskel::detail {
namespace {

constexpr double kAngle = kPi / 4;

double mean(const std::array<double, 3>& weight) { return (weight[0] + weight[1] + weight[2]) / 3; }

// The last one is there more than once, since compilers compute four axes at a time.
constexpr int kAxes = 16;
struct Axes {
  std::array<double, kAxes> x, y, z;
};

const Axes& axes() {
  static const Axes all = [] {
    Axes made;
    for (int k = 0; k < kAxes; ++k) {
      const int n = std::min(k, 12);
      const Vector3 axis = Vector3(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1).normalized();
      made.x[k] = axis[0];
      made.y[k] = axis[1];
      made.z[k] = axis[2];
    }
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
  const Vector3& p = x(p_);
  foot_ = (x((p_ + 2) % 3) - p).dot(x((p_ + 1) % 3) - p) / (length_ * length_);
  per_length_ = 1 / length_;
  per_height_ = 1 / height_;
  flat_ = length_ / height_;
  slant_ = std::sqrt(1 + flat_ * flat_);
}

MSPSKEL_AVX_CLONES bool TurnedFace::may_turn_over(const Vector3& joint,
                                                  const std::array<double, 3>& weight) const {
  if (!(height_ > 0)) return false;
  return !is_safe((middle_ - joint).norm(), weight) && turns_over_about_axes(joint, weight);
}

// Whatever the axis. With p and q the ends of the longest edge, r the third corner and t where its height
// stands on the edge: where weights change evenly along the edge and r has that of its foot, what is farther
// along turns by more, so r leaves the line through p and q by a bow.
bool TurnedFace::is_safe(double far, const std::array<double, 3>& weight) const {
  const std::size_t p = p_, q = p == 2 ? 0 : p + 1, r = p == 0 ? 2 : p - 1;
  const double t = foot_;
  const double along = weight[q] - weight[p], across = weight[r] - weight[p] - t * along;
  const double whole = mean(weight);
  const auto bow = [&](std::size_t k) -> Vector3 { return (weight[k] - whole) * (x(k) - middle_); };
  const Vector3 edge_bow = bow(q) - bow(p), height_bow = bow(r) - bow(p) - t * edge_bow;
  // As shares of edge and height, each with its bow.
  const double e = kMove * std::abs(along) * far / length_, f = kMove * edge_bow.norm() / length_;
  const double h = kMove * std::abs(across) * far / height_, g = kMove * height_bow.norm() / height_;
  return std::sqrt(e * e + h * h) + f + g + e * g + f * h + f * g <= kSafe;
}

bool TurnedFace::turns_over_about_axes(const Vector3& joint, const std::array<double, 3>& weight) const {
  const double c = 1 - std::cos(kAngle), s = std::sin(kAngle);
  const Vector3 first = weight[0] * (x(0) - joint), &n = normal_;
  const Vector3 v = weight[1] * (x(1) - joint) - first, w = weight[2] * (x(2) - joint) - first;
  const Vector3 a = x(1) - x(0) - c * v, b = x(2) - x(0) - c * w, ab = a.cross(b), vw = v.cross(w);
  const Vector3 nv = n.cross(v), nw = n.cross(w), na = n.cross(a), nb = n.cross(b), nab = n.cross(ab);
  const double skew = a.dot(w) - b.dot(v), ab_n = ab.dot(n), a_n = a.dot(n), b_n = b.dot(n);
  const double v_n = v.dot(n), w_n = w.dot(n), whole = mean(weight);
  const double cosine = std::cos(kAngle * whole), sine = std::sin(kAngle * whole);

  const Axes& axis = axes();
  std::array<double, kAxes> left;
  for (int k = 0; k < kAxes; ++k) {
    const double axis_x = axis.x[k], axis_y = axis.y[k], axis_z = axis.z[k];
    const auto on = [&](const Vector3& u) { return axis_x * u[0] + axis_y * u[1] + axis_z * u[2]; };
    const double on_v = on(v), on_w = on(w), on_a = on(a), on_b = on(b), on_n = on(n), on_vw = on(vw);
    // Of the axis' cross product with the normal, with each of the vectors.
    const double side_v = on(nv), side_w = on(nw), side_a = on(na), side_b = on(nb), side_ab = on(nab);
    const double level_a = on_a + c * on_v, level_b = on_b + c * on_w, along = s * s * on_vw;
    const double both_n = ab_n + c * (on_w * side_a - on_v * side_b) + along * on_n;
    const double both_side = side_ab + c * (on_w * (on_a * on_n - a_n) - on_v * (on_b * on_n - b_n));
    const double by_side_n = s * (skew * on_n - w_n * level_a + v_n * level_b);
    const double by_side_on = s * (skew - on_w * level_a + on_v * level_b);
    const double by_side_side = s * (side_v * level_b - side_w * level_a);
    const double still = cosine * both_n + (1 - cosine) * on_n * (on(ab) + along) + sine * by_side_side;
    const double turned = cosine * by_side_n + (1 - cosine) * on_n * by_side_on + sine * both_side;
    left[k] = still - std::abs(turned);
  }
  double least = left[0];
  for (const double l : left) least = std::min(least, l);
  return least < kLeastLeft * n.squaredNorm();
}

}  // namespace mspskel::detail
