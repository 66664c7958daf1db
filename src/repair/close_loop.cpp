#include "close_loop.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <tuple>

namespace mspskel::detail {
namespace {

constexpr Index kMostForLeastArea = 128;

// Clips ears off a loop, those of short chords first.
class Ears {
 public:
  // Whether an ear, given by its corner and those before and after it, comes after all others.
  using Last = std::function<bool(const Vector3& before, const Vector3& corner, const Vector3& after)>;
  Ears(const std::vector<Vector3>& loop, Last last, LoopClosing& closing)
      : loop_(loop), last_(std::move(last)), closing_(closing), left_(static_cast<Index>(loop.size())) {
    for (Index i = 0; i < left_; ++i) {
      next_.push_back(i + 1 == left_ ? 0 : i + 1);
      previous_.push_back(i == 0 ? left_ - 1 : i - 1);
    }
    rank_.resize(left_);
    for (Index i = 0; i < left_; ++i) add(i);
  }

  Index left() const { return left_; }
  bool only_last_left() const { return std::get<0>(*queue_.begin()); }
  void clip() {
    const Index i = std::get<2>(*queue_.begin()), a = previous_[i], c = next_[i];
    closing_.triangles.push_back({a, i, c});
    next_[a] = c;
    previous_[c] = a;
    next_[i] = kNone;
    queue_.erase(rank_[i]);
    for (const Index k : {a, c}) {
      queue_.erase(rank_[k]);
      add(k);
    }
    --left_;
  }
  std::vector<Index> rest() const {
    std::vector<Index> corners;
    for (Index i = 0; i < static_cast<Index>(next_.size()); ++i)
      if (next_[i] != kNone) corners.push_back(i);
    return corners;
  }

 private:
  using Rank = std::tuple<bool, double, Index>;
  void add(Index i) {
    const Vector3 &a = loop_[previous_[i]], &b = loop_[i], &c = loop_[next_[i]];
    rank_[i] = {last_(a, b, c), (c - a).squaredNorm(), i};
    queue_.insert(rank_[i]);
  }

  const std::vector<Vector3>& loop_;
  const Last last_;
  LoopClosing& closing_;
  Index left_;
  std::vector<Index> next_, previous_;
  std::vector<Rank> rank_;
  std::set<Rank> queue_;
};

// least[i, j]: the smallest area of triangles between the corners i, i+1, .. j and the chord from i to j.
class LeastArea {
 public:
  LeastArea(const std::vector<Vector3>& loop, const std::vector<Index>& corners, LoopClosing& closing)
      : loop_(loop),
        corners_(corners),
        closing_(closing),
        size_(static_cast<Index>(corners.size())),
        least_(corners.size() * corners.size(), 0.0),
        apex_(corners.size() * corners.size(), kNone) {}

  void run() {
    for (Index span = 2; span < size_; ++span)
      for (Index i = 0; i + span < size_; ++i) find(i, i + span);
    std::vector<std::pair<Index, Index>> chords{{0, size_ - 1}};
    while (!chords.empty()) {
      const auto [i, j] = chords.back();
      chords.pop_back();
      if (j - i < 2) continue;
      const Index k = apex_[i * size_ + j];
      closing_.triangles.push_back({corners_[i], corners_[k], corners_[j]});
      chords.emplace_back(i, k);
      chords.emplace_back(k, j);
    }
  }

 private:
  void find(Index i, Index j) {
    const Vector3 &a = loop_[corners_[i]], ab = loop_[corners_[j]] - a;
    double best = std::numeric_limits<double>::infinity();
    for (Index k = i + 1; k < j; ++k) {
      const double area =
          ab.cross(loop_[corners_[k]] - a).norm() + least_[i * size_ + k] + least_[k * size_ + j];
      if (area < best || apex_[i * size_ + j] == kNone) {
        best = area;
        apex_[i * size_ + j] = k;
      }
    }
    least_[i * size_ + j] = best;
  }

  const std::vector<Vector3>& loop_;
  const std::vector<Index>& corners_;
  LoopClosing& closing_;
  const Index size_;
  std::vector<double> least_;
  std::vector<Index> apex_;
};

}  // namespace

LoopShape loop_shape(const std::vector<Vector3>& loop) {
  LoopShape shape;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const double length = (b - a).norm();
    shape.length += length;
    shape.centre += length * ((a - loop[0]) + (b - loop[0])) / 2;
    shape.area += (a - loop[0]).cross(b - loop[0]) / 2;
  }
  if (shape.length > 0) shape.centre /= shape.length;
  shape.centre += loop[0];
  return shape;
}

bool is_star_shaped(const std::vector<Vector3>& loop, const LoopShape& shape) {
  constexpr double kMostBack = 0.05;
  const Vector3 normal = shape.area.normalized();
  double back = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    back -= std::min(0.0, normal.dot((a - shape.centre).cross(b - shape.centre)) / 2);
  }
  return back <= kMostBack * shape.area.norm();
}

std::vector<Index> fill_notches(const std::vector<Vector3>& loop, const TubeWall& wall,
                                LoopClosing& closing) {
  constexpr double kMostAcross = 0.5;
  const auto from_axis = [&](const Vector3& p) {
    const Vector3 arm = p - wall.centre;
    return Vector3(arm - arm.dot(wall.axis) * wall.axis);
  };
  const auto is_no_wall = [&](const Vector3& before, const Vector3& corner, const Vector3& after) {
    const Vector3 area = (corner - before).cross(after - corner);
    const Vector3 a = from_axis(before), c = from_axis(after);
    return std::abs(area.dot(wall.axis)) >= kMostAcross * area.norm() ||
           (area.dot(a + c) > 0) != wall.faces_outward || a.dot(c) <= 0;
  };
  Ears ears(loop, is_no_wall, closing);
  while (ears.left() > 3 && !ears.only_last_left()) ears.clip();
  return ears.rest();
}

void add_fan(const std::vector<Index>& corners, Index centre, LoopClosing& closing) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    closing.triangles.push_back({corners[i], corners[i + 1 == corners.size() ? 0 : i + 1], centre});
}

LoopClosing least_area_triangles(const std::vector<Vector3>& loop) {
  LoopClosing closing;
  const Vector3 normal = loop_shape(loop).area;
  const auto is_concave = [&](const Vector3& before, const Vector3& corner, const Vector3& after) {
    return normal.dot((corner - before).cross(after - corner)) < 0;
  };
  Ears ears(loop, is_concave, closing);
  while (ears.left() > kMostForLeastArea) ears.clip();
  const std::vector<Index> corners = ears.rest();
  LeastArea(loop, corners, closing).run();
  return closing;
}

}  // namespace mspskel::detail
