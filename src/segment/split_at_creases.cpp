#include "mspskel/segment/split_at_creases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

// Pieces of parts that become one, pair by pair. A piece's number is that of one of its faces.
class PieceMerger {
 public:
  PieceMerger(const SurfaceSnapshot& surface, const std::vector<double>& costs,
              const std::vector<Index>& part_of_face, const CreasePartOptions& options)
      : options_(options), into_(part_of_face.size()), border_(part_of_face.size()) {
    std::iota(into_.begin(), into_.end(), 0);
    count_ = surface.face_count();
    for (Index f = 0; f < count_; ++f) area_.push_back(0.5 * surface.face_normal_times_twice_area(f).norm());
    total_ = std::accumulate(area_.begin(), area_.end(), 0.0);
    for (Index h = 0; h < surface.halfedge_count(); ++h) {
      const Index f = h / 3, g = surface.twin[h] / 3;
      if (f != g && part_of_face[f] == part_of_face[g]) border_[f][g] += costs[h];
    }
    for (Index f = 0; f < count_; ++f)
      for (const auto& [g, cost] : border_[f])
        if (f < g) push(f, g);
  }

  void run() {
    while (!queue_.empty() && count_ > options_.least) {
      const Pair pair = queue_.top();
      queue_.pop();
      const auto found = border_[pair.a].find(pair.b);
      if (found == border_[pair.a].end() || worth(pair.a, pair.b, found->second) != pair.worth) continue;
      const bool clean = pair.worth.first == 0 && pair.worth.second <= options_.cost;
      if (clean && (options_.most == 0 || count_ <= options_.most)) return;
      merge(pair.a, pair.b);
    }
  }
  std::vector<Index> numbered() {
    std::vector<Index> number(into_.size(), kNone), part(into_.size());
    Index next = 0;
    for (std::size_t f = 0; f < part.size(); ++f) {
      Index piece = static_cast<Index>(f);
      while (into_[piece] != piece) piece = into_[piece] = into_[into_[piece]];
      if (number[piece] == kNone) number[piece] = next++;
      part[f] = number[piece];
    }
    return part;
  }

 private:
  using Worth = std::pair<int, double>;  // whether one is too small; cost of the border for its size
  struct Pair {
    Worth worth;
    Index a, b;  // a < b
    bool operator<(const Pair& other) const {
      return std::tie(worth, other.a, other.b) < std::tie(other.worth, a, b);
    }
  };

  Worth worth(Index a, Index b, double cost) const {
    const double smaller = std::min(area_[a], area_[b]);
    return {smaller < options_.smallest * total_ ? 1 : 0, smaller > 0 ? cost / std::sqrt(smaller) : total_};
  }
  void push(Index a, Index b) {
    if (b < a) std::swap(a, b);
    queue_.push({worth(a, b, border_[a].at(b)), a, b});
  }
  void merge(Index a, Index b) {
    if (border_[a].size() < border_[b].size()) std::swap(a, b);
    const double before = area_[a];
    border_[a].erase(b);
    border_[b].erase(a);
    into_[b] = a;
    area_[a] += area_[b];
    --count_;
    for (const auto& [c, cost] : border_[b]) {
      border_[c].erase(b);
      border_[c][a] = border_[a][c] += cost;
    }
    // The worth of the others is that of the smaller piece, which has grown only if it is this one.
    for (const auto& [c, cost] : border_[a])
      if (area_[c] > before || border_[b].count(c) > 0) push(a, c);
    border_[b].clear();
  }

  const CreasePartOptions options_;
  std::vector<Index> into_;  // per piece: the one that it became part of; its own number: it stands
  std::vector<std::map<Index, double>> border_;  // per piece: its neighbours and what the border costs
  std::vector<double> area_;
  std::priority_queue<Pair> queue_;
  Index count_ = 0;
  double total_ = 0;
};

}  // namespace

void validate(const CreasePartOptions& options) {
  if (!(options.cost >= 0 && options.cost <= 100)) throw UsageError("creases: cost must be from 0 to 100");
  if (!(options.smallest >= 0 && options.smallest <= 1))
    throw UsageError("creases: smallest must be from 0 to 1");
  if (options.most < 0 || options.least < 0) throw UsageError("creases: counts must not be negative");
}

void split_at_creases(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                      std::vector<Index>& part_of_face, const CreasePartOptions& options) {
  validate(options);
  PieceMerger merger(surface, costs, part_of_face, options);
  merger.run();
  part_of_face = merger.numbered();
}

}  // namespace mspskel
