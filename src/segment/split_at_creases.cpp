#include "mspskel/segment/split_at_creases.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

#include "mspskel/base/error.h"
#include "mspskel/segment/smooth_borders.h"

namespace mspskel {
namespace {

// A border costs at most so many times its length, or it has no creases: anywhere round a long tube a border
// is short for its area.
constexpr double kMostBare = 0.5;
// Borders that cost less count as this, for the sake of the logarithm.
constexpr double kFree = 1e-9;

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

// Sets of faces, each within one part.
struct Patches {
  std::vector<Index> of_face;
  std::vector<Index> part;  // per patch
};

Patches single_faces(const std::vector<Index>& part_of_face) {
  Patches patches{std::vector<Index>(part_of_face.size()), part_of_face};
  std::iota(patches.of_face.begin(), patches.of_face.end(), 0);
  return patches;
}

// Pieces of parts that become one, pair by pair, until each part is one: a tree of merges. Which of them
// stand is decided on the whole tree. A piece's number is that of one of its patches.
class PieceMerger {
 public:
  PieceMerger(const SurfaceSnapshot& surface, const std::vector<double>& costs, const Patches& patches,
              const CreasePartOptions& options)
      : options_(options),
        patch_of_face_(patches.of_face),
        into_(patches.part.size()),
        border_(patches.part.size()),
        area_(patches.part.size(), 0.0),
        gain_(patches.part.size(), 0.0) {
    std::iota(into_.begin(), into_.end(), 0);
    merges_.reserve(into_.size());
    for (Index f = 0; f < surface.face_count(); ++f) area_[patches.of_face[f]] += surface.face_area(f);
    total_ = std::accumulate(area_.begin(), area_.end(), 0.0);
    for (Borders& borders : border_) borders.reserve(3);
    for (Index h = 0; h < surface.halfedge_count(); ++h) {
      const Index a = patches.of_face[h / 3], b = patches.of_face[surface.twin[h] / 3];
      if (a != b && patches.part[a] == patches.part[b])
        add(border_[a], b, {costs[h], surface.edge_length(h)});
    }
    std::vector<Pair> pairs;
    for (Index a = 0; a < static_cast<Index>(into_.size()); ++a)
      for (const auto& [b, border] : border_[a])
        if (a < b) pairs.push_back({key_of(worth(a, b, border)), a, b});
    queue_ = std::priority_queue<Pair>(std::less<Pair>(), std::move(pairs));
  }

  void run() {
    while (!queue_.empty()) {
      const Pair pair = queue_.top();
      queue_.pop();
      if (into_[pair.a] != pair.a || into_[pair.b] != pair.b) continue;
      const Worth found = worth(pair.a, pair.b, place_of(border_[pair.a], pair.b)->second);
      if (key_of(found) == pair.key) merge(pair.a, pair.b, found);
    }
  }
  // Per face what stands apart, numbered by the least face.
  std::vector<Index> numbered() {
    choose();
    std::vector<Index> part(into_.size(), kNone);
    Index next = 0;
    for (std::size_t i = 0; i < part.size(); ++i)
      if (into_[i] == static_cast<Index>(i)) part[i] = next++;
    for (auto merged = merges_.rbegin(); merged != merges_.rend(); ++merged)
      part[merged->gone] = merged->apart ? next++ : part[merged->kept];
    std::vector<Index> number(next, kNone), numbered;
    numbered.reserve(patch_of_face_.size());
    next = 0;
    for (const Index patch : patch_of_face_) {
      Index& chosen = number[part[patch]];
      if (chosen == kNone) chosen = next++;
      numbered.push_back(chosen);
    }
    return numbered;
  }

 private:
  using Worth = std::pair<int, double>;  // whether one is too small; what the border costs
  struct Merge {
    Index kept, gone;
    bool apart;  // what both are made of is parted rather than one
  };
  struct Pair {
    std::uint64_t key;  // of its worth
    Index a, b;         // a < b
    bool operator<(const Pair& other) const {
      if (key != other.key) return key < other.key;
      return std::tie(other.a, other.b) < std::tie(a, b);
    }
  };
  // Keys are as worths are to each other: bits of numbers that are not negative count up with them. What
  // differs by rounding alone is equal, as on regular meshes: else the order would be how the surface lies.
  static std::uint64_t key_of(const Worth& worth) {
    const auto rounded = static_cast<float>(std::abs(worth.second));
    std::uint32_t bits = 0;
    static_assert(sizeof bits == sizeof rounded);
    std::memcpy(&bits, &rounded, sizeof bits);
    return bits | static_cast<std::uint64_t>(worth.first) << 32;
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
  // Keeping both sides of the border apart is worth log(limit / cost), and so are the borders within the
  // sides, which stand only if this one does: a ring that is a little too dear does not undo what lies
  // within, and one that is just cheap enough does not hold up a patchwork of dear ones. A side too small
  // cannot stand.
  void record(Index kept, Index gone, const Worth& border) {
    const double gain = border.first != 0 ? -std::numeric_limits<double>::infinity()
                                          : std::log(options_.cost / std::max(border.second, kFree));
    const double sum = gain + gain_[kept] + gain_[gone];
    gain_[kept] = std::max(0.0, sum);
    merges_.push_back({kept, gone, sum > 0});
  }
  // From the last merge down: below one that parts nothing all are one. Where that gives too many parts, or
  // too few, those stand that became one last.
  void choose() {
    const Index whole = static_cast<Index>(into_.size() - merges_.size());
    Index count = whole;
    std::vector<char> open(into_.size(), 1);
    for (auto merged = merges_.rbegin(); merged != merges_.rend(); ++merged) {
      merged->apart = merged->apart && open[merged->kept];
      open[merged->kept] = open[merged->gone] = merged->apart ? 1 : 0;
      if (merged->apart) ++count;
    }
    Index wanted = std::max(count, options_.least);
    if (options_.most > 0) wanted = std::min(wanted, std::max(options_.most, options_.least));
    if (wanted == count) return;
    const auto last = static_cast<std::size_t>(std::max(0, wanted - whole));
    for (std::size_t i = 0; i < merges_.size(); ++i) merges_[i].apart = i + last >= merges_.size();
  }
  void merge(Index a, Index b, const Worth& found) {
    if (border_[a].size() < border_[b].size()) std::swap(a, b);
    record(a, b, found);
    const double before = area_[a];
    erase(border_[a], b);
    erase(border_[b], a);
    into_[b] = a;
    area_[a] += area_[b];
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
  const std::vector<Index>& patch_of_face_;
  std::vector<Index> into_;  // per piece: the one that it became part of; its own number: it stands
  std::vector<Borders> border_;
  std::vector<double> area_;
  std::priority_queue<Pair> queue_;
  std::vector<double> gain_;  // per piece: of the borders within it that stand if its own do
  std::vector<Merge> merges_;
  double total_ = 0;
};

std::vector<Index> merge_patches(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                                 const Patches& patches, const CreasePartOptions& options) {
  PieceMerger merger(surface, costs, patches, options);
  merger.run();
  return merger.numbered();
}

}  // namespace

void validate(const CreasePartOptions& options) {
  if (!(options.cost >= 0 && options.cost <= 100)) throw UsageError("creases: cost must be from 0 to 100");
  if (!(options.smallest >= 0 && options.smallest <= 1))
    throw UsageError("creases: smallest must be from 0 to 1");
  if (!(options.border_width >= 0 && options.border_width <= 10))
    throw UsageError("creases: border width must be from 0 to 10");
  if (!(options.doubt >= 1 && options.doubt <= 100)) throw UsageError("creases: doubt must be from 1 to 100");
  if (options.most < 0 || options.least < 0) throw UsageError("creases: counts must not be negative");
}

void split_at_creases(const SurfaceSnapshot& surface, const std::vector<double>& costs,
                      std::vector<Index>& part_of_face, const CreasePartOptions& options) {
  validate(options);
  // Borders of grown pieces are as rough as the order of their merges made them. What they cost is told once
  // they have settled.
  CreasePartOptions doubtful = options;
  doubtful.cost *= options.doubt;
  doubtful.most = 0;
  Patches grown{merge_patches(surface, costs, single_faces(part_of_face), doubtful), {}};
  // They are numbered by their least faces.
  for (std::size_t f = 0; f < part_of_face.size(); ++f)
    if (grown.of_face[f] == static_cast<Index>(grown.part.size())) grown.part.push_back(part_of_face[f]);
  smooth_borders(surface, costs, grown.of_face, options.border_width);
  connect_parts(surface, grown.of_face);
  part_of_face = merge_patches(surface, costs, grown, options);
}

}  // namespace mspskel
