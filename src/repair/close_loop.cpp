#include "close_loop.h"

#include <limits>
#include <set>
#include <tuple>

namespace mspskel::detail {
namespace {

constexpr Index kMostForLeastArea = 128;

// Clips ears of short diagonals, convex ones first, until few corners are left; returns those.
class Shortening {
 public:
  Shortening(const std::vector<Vector3>& loop, LoopClosing& closing)
      : loop_(loop),
        closing_(closing),
        normal_(loop_shape(loop).area),
        size_(static_cast<Index>(loop.size())) {}

  std::vector<Index> run() {
    for (Index i = 0; i < size_; ++i) {
      next_.push_back(i + 1 == size_ ? 0 : i + 1);
      previous_.push_back(i == 0 ? size_ - 1 : i - 1);
    }
    rank_.resize(size_);
    for (Index i = 0; i < size_; ++i) add(i);
    for (Index left = size_; left > kMostForLeastArea; --left) clip(std::get<2>(*queue_.begin()));
    std::vector<Index> rest;
    for (Index i = 0; i < size_; ++i)
      if (next_[i] != kNone) rest.push_back(i);
    return rest;
  }

 private:
  using Rank = std::tuple<bool, double, Index>;
  void add(Index i) {
    const Vector3 &a = loop_[previous_[i]], &b = loop_[i], &c = loop_[next_[i]];
    rank_[i] = {normal_.dot((b - a).cross(c - b)) < 0, (c - a).squaredNorm(), i};
    queue_.insert(rank_[i]);
  }
  void clip(Index i) {
    const Index a = previous_[i], c = next_[i];
    closing_.triangles.push_back({a, i, c});
    next_[a] = c;
    previous_[c] = a;
    next_[i] = kNone;
    queue_.erase(rank_[i]);
    for (const Index k : {a, c}) {
      queue_.erase(rank_[k]);
      add(k);
    }
  }

  const std::vector<Vector3>& loop_;
  LoopClosing& closing_;
  const Vector3 normal_;
  const Index size_;
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
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if (!(shape.area.dot((a - shape.centre).cross(b - shape.centre)) > 0)) return false;
  }
  return true;
}

LoopClosing fan_round_centre(Index size) {
  LoopClosing closing;
  for (Index i = 0; i < size; ++i) closing.triangles.push_back({i, i + 1 == size ? 0 : i + 1, size});
  return closing;
}

LoopClosing least_area_triangles(const std::vector<Vector3>& loop) {
  LoopClosing closing;
  std::vector<Index> corners = Shortening(loop, closing).run();
  LeastArea(loop, corners, closing).run();
  return closing;
}

}  // namespace mspskel::detail
