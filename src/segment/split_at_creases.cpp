#include "mspskel/segment/split_at_creases.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <queue>
#include <tuple>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

// A border costs at most so many times its length, or it has no creases: anywhere round a long tube a border
// is short for its area.
constexpr double kMostBare = 0.5;

// Of the border between two pieces.
struct Border {
  double cost = 0, length = 0;
};
// Neighbours of a piece, ascending, and the borders with them. Few, so a sorted list beats a tree.
using Borders = std::vector<std::pair<Index, Border>>;

Borders::iterator place_of(Borders& borders, Index piece) {
  return std::lower_bound(borders.begin(), borders.end(), piece,
                          [](const auto& entry, Index p) { return entry.first < p; });
}
void erase(Borders& borders, Index piece) { borders.erase(place_of(borders, piece)); }
// Adds to the border with the piece; returns the whole of it.
Border add(Borders& borders, Index piece, const Border& border) {
  auto at = place_of(borders, piece);
  if (at == borders.end() || at->first != piece) at = borders.insert(at, {piece, {}});
  at->second.cost += border.cost;
  at->second.length += border.length;
  return at->second;
}

// Pieces of parts that become one, pair by pair. A piece's number is that of one of its faces.
class PieceMerger {
 public:
  PieceMerger(const SurfaceSnapshot& surface, const std::vector<double>& costs,
              const std::vector<Index>& part_of_face, const CreasePartOptions& options)
      : options_(options), into_(part_of_face.size()), border_(part_of_face.size()) {
    std::iota(into_.begin(), into_.end(), 0);
    count_ = surface.face_count();
    for (Index f = 0; f < count_; ++f) area_.push_back(surface.face_area(f));
    total_ = std::accumulate(area_.begin(), area_.end(), 0.0);
    for (Borders& borders : border_) borders.reserve(3);
    for (Index h = 0; h < surface.halfedge_count(); ++h) {
      const Index f = h / 3, g = surface.twin[h] / 3;
      if (f != g && part_of_face[f] == part_of_face[g])
        add(border_[f], g, {costs[h], surface.edge_length(h)});
    }
    std::vector<Pair> pairs;
    for (Index f = 0; f < count_; ++f)
      for (const auto& [g, border] : border_[f])
        if (f < g) pairs.push_back({key_of(worth(f, g, border)), f, g});
    queue_ = std::priority_queue<Pair>(std::less<Pair>(), std::move(pairs));
  }

  void run() {
    while (!queue_.empty() && count_ > options_.least) {
      const Pair pair = queue_.top();
      queue_.pop();
      if (into_[pair.a] != pair.a || into_[pair.b] != pair.b) continue;
      const auto found = place_of(border_[pair.a], pair.b);
      const Worth found_worth = worth(pair.a, pair.b, found->second);
      if (key_of(found_worth) != pair.key) continue;
      const bool clean = found_worth.first == 0 && found_worth.second <= options_.cost;
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
  using Worth = std::pair<int, double>;  // whether one is too small; what the border costs
  struct Pair {
    std::uint64_t key;  // of its worth
    Index a, b;         // a < b
    bool operator<(const Pair& other) const {
      if (key != other.key) return key < other.key;
      return std::tie(other.a, other.b) < std::tie(a, b);
    }
  };
  // Keys are as worths are to each other: bits of numbers that are not negative count up with them.
  static std::uint64_t key_of(const Worth& worth) {
    const double cost = std::abs(worth.second);
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof cost);
    std::memcpy(&bits, &cost, sizeof bits);
    return bits | static_cast<std::uint64_t>(worth.first) << 63;
  }

  Worth worth(Index a, Index b, const Border& border) const {
    const double smaller = std::min(area_[a], area_[b]);
    const int small = smaller < options_.smallest * total_ ? 1 : 0;
    if (smaller <= 0 || border.length <= 0) return {small, total_};
    // More than the limit where creases take less than their share.
    const double bare = options_.cost * border.cost / (kMostBare * border.length);
    return {small, std::max(border.cost / std::sqrt(smaller), bare)};
  }
  void push(Index a, Index b, const Border& border) {
    queue_.push({key_of(worth(a, b, border)), std::min(a, b), std::max(a, b)});
  }
  void merge(Index a, Index b) {
    if (border_[a].size() < border_[b].size()) std::swap(a, b);
    const double before = area_[a];
    erase(border_[a], b);
    erase(border_[b], a);
    into_[b] = a;
    area_[a] += area_[b];
    --count_;
    // The worth of a border is that of the smaller piece: of those that b did not touch only it can change.
    for (const auto& [c, border] : border_[a])
      if (area_[c] > before) push(a, c, border);
    for (const auto& [c, border] : border_[b]) {
      erase(border_[c], b);
      add(border_[c], a, border);
      push(a, c, add(border_[a], c, border));
    }
    Borders().swap(border_[b]);
  }

  const CreasePartOptions options_;
  std::vector<Index> into_;  // per piece: the one that it became part of; its own number: it stands
  std::vector<Borders> border_;
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
