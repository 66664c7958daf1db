#include "grow_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <unordered_map>

#include "mspskel/base/error.h"
#include "noise.h"
#include "truth.h"

namespace mspskel::detail {

namespace {
struct Tube {
  Vector3 from, to;
  double radius;
  Index parent;
  Index tips;
};

// Nearest distance of two segments: at an end of one, or between two inner points.
double segment_distance(const Tube& s, const Tube& t) {
  const auto to_segment = [](const Vector3& p, const Tube& u) {
    const Vector3 axis = u.to - u.from;
    const double along = std::clamp((p - u.from).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    return (p - u.from - along * axis).norm();
  };
  double least =
      std::min({to_segment(s.from, t), to_segment(s.to, t), to_segment(t.from, s), to_segment(t.to, s)});
  const Vector3 a = s.to - s.from, b = t.to - t.from, gap = t.from - s.from, normal = a.cross(b);
  const double size = normal.squaredNorm();
  if (size > 1e-12 * a.squaredNorm() * b.squaredNorm()) {
    const double u = gap.cross(b).dot(normal) / size, v = gap.cross(a).dot(normal) / size;
    if (u > 0 && u < 1 && v > 0 && v < 1)
      least = std::min(least, std::abs(gap.dot(normal)) / std::sqrt(size));
  }
  return least;
}

// Tubes by the cells of a grid that they pass.
class TubeGrid {
 public:
  explicit TubeGrid(double cell) : cell_(cell) {}

  void add(const Tube& tube, Index number) {
    for_cells(tube, 0, [&](std::uint64_t key) { cells_[key].push_back(number); });
  }
  // The numbers of tubes whose surfaces are nearer than `gap`, and perhaps others; some several times.
  std::vector<Index> near(const Tube& tube, double gap) const {
    std::vector<Index> result;
    for_cells(tube, gap, [&](std::uint64_t key) {
      if (const auto place = cells_.find(key); place != cells_.end())
        result.insert(result.end(), place->second.begin(), place->second.end());
    });
    return result;
  }

 private:
  template <class Take>
  void for_cells(const Tube& tube, double gap, const Take& take) const {
    const double reach = tube.radius + gap;
    std::array<std::int64_t, 3> low{}, high{};
    for (Eigen::Index k = 0; k < 3; ++k) {
      low[k] = static_cast<std::int64_t>(std::floor((std::min(tube.from[k], tube.to[k]) - reach) / cell_));
      high[k] = static_cast<std::int64_t>(std::floor((std::max(tube.from[k], tube.to[k]) + reach) / cell_));
    }
    Tube point = tube;
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          point.from =
              cell_ * (Vector3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) +
                       Vector3::Constant(0.5));
          point.to = point.from + Vector3(1e-6 * cell_, 0, 0);
          if (segment_distance(point, tube) < reach + 0.87 * cell_)
            take(static_cast<std::uint64_t>((x + (1 << 20)) << 42 | (y + (1 << 20)) << 21 | (z + (1 << 20))));
        }
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

class Grower {
 public:
  explicit Grower(const TreeRule& rule, std::uint64_t attempt)
      : rule_(rule), random_(rule.seed + 1000003 * attempt), grid_(kGap * 8) {}

  // False if a branch finds no room.
  bool grow() {
    Tube root{{0, 0, 0}, {0, 0, 0}, radius(rule_.tips), kNone, rule_.tips};
    root.to = {0, 0, 1.3 * rule_.length * root.radius};
    add(root);
    std::deque<Index> waiting{0};
    while (!waiting.empty()) {
      const Index parent = waiting.front();
      waiting.pop_front();
      if (tubes_[parent].tips == 1) continue;
      if (!fork(parent)) return false;
      for (const Index child : {last() - 1, last()}) waiting.push_back(child);
    }
    return true;
  }

  GrownTree result() const {
    GrownTree tree;
    tree.graph.blend = 0.4 * tubes_.front().radius;
    const auto node = [&](const Vector3& position, double radius) {
      tree.truth.nodes.emplace_back();
      tree.truth.nodes.back().position = position;
      tree.truth.nodes.back().radius = radius;
    };
    const Tube& root = tubes_.front();
    node(root.from - (1 - kEndDepth) * root.radius * Vector3::UnitZ(), root.radius);
    for (Index i = 0; i <= last(); ++i) {
      const Tube& tube = tubes_[i];
      const auto first = static_cast<Index>(tree.graph.nodes.size());
      tree.graph.nodes.push_back({tube.from, tube.radius});
      tree.graph.nodes.push_back({tube.to, tube.radius});
      tree.graph.edges.emplace_back(first, first + 1);
      const Vector3 way = (tube.to - tube.from).normalized();
      node(tube.to + (tube.tips == 1 ? (1 - kEndDepth) * tube.radius : 0.0) * way, tube.radius);
      tree.truth.edges.push_back({tube.parent == kNone ? 0 : tube.parent + 1, i + 1});
    }
    std::sort(tree.truth.edges.begin(), tree.truth.edges.end());
    return tree;
  }

 private:
  static constexpr double kGap = 1;  // between tubes, in radii of a tip and of the thinner tube

  double radius(Index tips) const { return std::pow(static_cast<double>(tips), rule_.exponent); }
  Index last() const { return static_cast<Index>(tubes_.size()) - 1; }

  void add(const Tube& tube) {
    tubes_.push_back(tube);
    grid_.add(tube, last());
  }

  bool is_free(const Tube& tube, Index sibling) const {
    // Near the joint it touches its parent, from which its angle keeps it.
    Tube rest = tube;
    rest.from += (tubes_[tube.parent].radius * 1.5) * (tube.to - tube.from).normalized();
    const double gap = kGap * tube.radius + kGap;
    for (const Index i : grid_.near(rest, gap)) {
      if (i == tube.parent || i == sibling) continue;
      if (segment_distance(rest, tubes_[i]) < rest.radius + tubes_[i].radius + gap) return false;
    }
    return true;
  }

  // Both children lean away from their parent's direction, the thinner one more.
  bool fork(Index parent) {
    const Tube from = tubes_[parent];
    const double share = rule_.evenness + (0.5 - rule_.evenness) * random_.uniform();
    const auto few = std::clamp<Index>(static_cast<Index>(std::lround(share * from.tips)), 1, from.tips - 1);
    const Vector3 way = (from.to - from.from).normalized(), side = way.unitOrthogonal();
    constexpr int kTries = 60;
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const double spread = (75 + 0.7 * attempt) * kPi / 180, turn = 2 * kPi * random_.uniform();
      const Vector3 across = std::cos(turn) * side + std::sin(turn) * way.cross(side);
      std::array<Tube, 2> child;
      for (std::size_t k = 0; k < 2; ++k) {
        const Index tips = k == 0 ? from.tips - few : few;
        const double angle =
            (spread * (1 - static_cast<double>(tips) / from.tips)) + 0.1 * (random_.uniform() - 0.5);
        const Vector3 ahead = std::cos(angle) * way + (k == 0 ? 1 : -1) * std::sin(angle) * across;
        const double own = radius(tips);
        const double length = from.radius + rule_.length * own * (1 + (random_.uniform() - 0.5) / 3);
        child[k] = {from.to, from.to + length * ahead, own, parent, tips};
      }
      if (!is_free(child[0], kNone) || !is_free(child[1], kNone)) continue;
      add(child[0]);
      add(child[1]);
      return true;
    }
    return false;
  }

  TreeRule rule_;
  Random random_;
  std::vector<Tube> tubes_;
  TubeGrid grid_;
};
}  // namespace

GrownTree grow_tree(const TreeRule& rule) {
  for (std::uint64_t attempt = 0; attempt < 20; ++attempt) {
    Grower grower(rule, attempt);
    if (grower.grow()) return grower.result();
  }
  throw UsageError("the tree's branches find no room; use another --seed or a smaller --count");
}

}  // namespace mspskel::detail
