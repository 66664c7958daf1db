// What a node of the collapsing skeleton mesh knows of the vertices that merged into it: sums only.
#pragma once

#include <algorithm>
#include <array>

#include "mspskel/base/types.h"

namespace mspskel {

// One vertex of the skeleton mesh, as the collapse sees it. Lengths in the normalised frame.
struct MergingVertex {
  Vector3 position = Vector3::Zero();  // skeletal point
  double perimeter = 0.0;              // MSP
  Vector3 normal = Vector3::Zero();    // slice normal, unit; its sign means nothing
  double error = 0.0;                  // normalised slice error E_s, 0 to 1
  double area = 0.0;                   // a third of the incident face areas
  bool valid = true;                   // has a slice
};

// The merging set S_M of a node (thesis 4.3.1), by its sums: a merge is O(1), and the order of merges does
// not matter but for rounding. Means are weighted by 1 − E_s (Eq. 4.6). Where all weights vanish they are
// plain means over the vertices that have a slice, and where none has, over all; so each set keeps the sums
// of its best kind only.
class MergingSet {
 public:
  MergingSet() = default;
  explicit MergingSet(const MergingVertex& v)
      : kind_(!v.valid        ? Kind::kNoSlice
              : v.error < 1.0 ? Kind::kWeighted
                              : Kind::kUnweighted),
        count_(1),
        area_(v.area),
        error_(v.error),
        weight_(kind_ == Kind::kWeighted ? std::min(1.0 - v.error, 1.0) : 1.0),
        perimeter_(v.valid ? weight_ * v.perimeter : 0.0),
        position_(weight_ * v.position) {
    if (!v.valid) return;
    const Vector3& n = v.normal;
    axis_ = {n.x() * n.x(), n.y() * n.y(), n.z() * n.z(), n.x() * n.y(), n.x() * n.z(), n.y() * n.z()};
    for (double& sum : axis_) sum *= weight_;
  }

  void merge(const MergingSet& other) {
    count_ += other.count_;
    area_ += other.area_;
    error_ += other.error_;
    if (other.kind_ < kind_) return;
    if (other.kind_ > kind_) clear_means();
    kind_ = other.kind_;
    weight_ += other.weight_;
    perimeter_ += other.perimeter_;
    position_ += other.position_;
    for (std::size_t i = 0; i < axis_.size(); ++i) axis_[i] += other.axis_[i];
  }

  // The set in a frame in which x is scale · x + shift.
  void move(double scale, const Vector3& shift) {
    area_ *= scale * scale;
    perimeter_ *= scale;
    position_ = scale * position_ + weight_ * shift;
  }

  Index count() const { return count_; }  // vertices, T of Eq. 4.3
  double area() const {
    return area_;
  }  // Sat(u): surface area that the set covers; adds up to the whole surface
  double error_sum() const { return error_; }
  double error() const { return count_ > 0 ? error_ / count_ : 0.0; }            // mean E_s
  double perimeter() const { return weight_ > 0 ? perimeter_ / weight_ : 0.0; }  // MSP(u); 0: no slice at all
  Vector3 position() const { return weight_ > 0 ? Vector3(position_ / weight_) : position_; }  // Eq. 4.6
  // N_s(u): the principal eigenvector of Σ w n nᵀ, unit, of no particular sign; zero without any normal.
  Vector3 axis() const;

 private:
  enum class Kind : unsigned char { kNoSlice, kUnweighted, kWeighted };

  void clear_means() {
    weight_ = perimeter_ = 0.0;
    position_.setZero();
    axis_.fill(0.0);
  }

  Kind kind_ = Kind::kNoSlice;
  Index count_ = 0;
  double area_ = 0.0, error_ = 0.0;
  double weight_ = 0.0, perimeter_ = 0.0;
  Vector3 position_ = Vector3::Zero();
  std::array<double, 6> axis_{};  // xx yy zz xy xz yz of Σ w n nᵀ
};

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/merging_set_impl.h"
#endif
