#include "mspskel/segment/find_parts.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>

#include "cross_sections.h"
#include "mspskel/base/error.h"
#include "mspskel/base/watch.h"
#include "part_tree.h"

namespace mspskel {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// A border along the edges of a mesh is longer than the straight one: 4 / pi times on a square grid, on
// average over its directions.
constexpr double kStraightened = kPi / 4;
// No taper is wider than the widest cross-section by more than rounding.
constexpr double kRounded = 1 - 1e-9;

// Where both are about as large, noise decides which is the larger one; this passes from one to the other.
double soft_maximum(double a, double b) { return std::pow(std::pow(a, 8) + std::pow(b, 8), 0.125); }

using Edge = std::array<Index, 2>;

// One edge, or two that cut a stretch out of a cycle. `edges[0][1]` is in what is cut off.
struct Cut {
  double score = kInfinite;  // less is cleaner
  double widest = 0;         // radius of a cross-section of the part that is cut
  std::vector<Edge> edges;

  bool has(Index a, Index b) const {
    return std::any_of(edges.begin(), edges.end(), [&](const Edge& e) {
      return e == Edge{a, b} || e == Edge{b, a};
    });
  }
};

struct CrossSection {
  double radius = 0, distance = 1;
};

class PartFinder {
 public:
  PartFinder(const CurveSkeleton& skeleton, const std::vector<NodeContact>& contacts,
             const PartOptions& options, const ProgressCallback& progress)
      : skeleton_(skeleton),
        contacts_(contacts),
        options_(options),
        watch_(progress, "parts"),
        next_(adjacency(skeleton)),
        size_(detail::cross_sections(skeleton, next_)),
        part_(skeleton.nodes.size(), kNone),
        distance_(skeleton.nodes.size(), kInfinite),
        side_(skeleton.nodes.size(), 0),
        place_(skeleton.nodes.size(), 0) {
    for (const SkeletonNode& node : skeleton.nodes) total_ += node.area;
    for (const auto& neighbours : next_) taper_.emplace_back(neighbours.size(), -1.0);
  }

  SkeletonParts run() {
    number_pieces();
    split_while_clean();
    if (options_.count > static_cast<Index>(cut_.size())) {
      // Whatever is left to cut, the cleanest first.
      options_.contrast = kInfinite;
      options_.slenderness = 0;
      for (Index p = 0; p < static_cast<Index>(cut_.size()); ++p) cut_[p] = cleanest_cut(root_[p]);
      split_while_clean();
    }
    return {part_, static_cast<Index>(cut_.size())};
  }

 private:
  double length(Index a, Index b) const {
    return (skeleton_.nodes[a].position - skeleton_.nodes[b].position).norm();
  }

  void number_pieces() {
    for (Index n = 0; n < static_cast<Index>(part_.size()); ++n)
      if (part_[n] == kNone) add_part(n, kNone, {});
    for (const Index root : root_) cut_.push_back(cleanest_cut(root));
  }
  // What hangs together with `root` becomes a part of its own.
  void add_part(Index root, Index from, const Cut& cut) {
    const Index to = static_cast<Index>(root_.size());
    root_.push_back(root);
    std::vector<Index> stack{root};
    part_[root] = to;
    while (!stack.empty()) {
      const Index n = stack.back();
      stack.pop_back();
      for (const Index k : next_[n])
        if (part_[k] == from && !cut.has(n, k)) {
          part_[k] = to;
          stack.push_back(k);
        }
    }
  }
  void split_while_clean() {
    for (;;) {
      const auto best = std::min_element(cut_.begin(), cut_.end(),
                                         [](const Cut& a, const Cut& b) { return a.score < b.score; });
      if (best == cut_.end() || best->score == kInfinite) return;
      if (options_.count > 0 && static_cast<Index>(cut_.size()) >= options_.count) return;
      const Index p = static_cast<Index>(best - cut_.begin());
      const Cut cut = *best;
      root_[p] = cut.edges[0][0];
      add_part(cut.edges[0][1], p, cut);
      forget_tapers(cut);
      cut_[p] = cleanest_cut(root_[p]);
      cut_.push_back(cleanest_cut(root_.back()));
    }
  }

  // The part's cross-sections on either side of the edge a-b, by distance along the skeleton. Nodes are taken
  // in the order in which they are first reached, and again where a shorter way turns up, which on trees
  // never happens.
  const std::array<std::vector<CrossSection>, 2>& sides_of(Index a, Index b, double limit) {
    reached_.clear();
    const auto reach = [&](Index n, double distance, char side) {
      if (distance > limit || distance >= distance_[n]) return;
      distance_[n] = distance;
      side_[n] = side;
      reached_.push_back(n);
    };
    reach(a, 0.5 * length(a, b), 0);
    reach(b, 0.5 * length(a, b), 1);
    for (std::size_t i = 0; i < reached_.size(); ++i) {
      const Index n = reached_[i];
      for (const Index k : next_[n])
        if (part_[k] == part_[n]) reach(k, distance_[n] + length(n, k), side_[n]);
    }
    for (std::vector<CrossSection>& sections : sides_) sections.clear();
    for (const Index n : reached_) {
      if (distance_[n] == kInfinite) continue;
      sides_[side_[n]].push_back({size_[n], distance_[n]});
      distance_[n] = kInfinite;
    }
    return sides_;
  }
  // The widest straight taper over the edge a-b, from the largest cross-section near it on one side to any on
  // the other side: its radius at the edge. Kept until a cut comes near.
  double tapered(Index a, Index b, double widest) {
    const auto at = std::find(next_[a].begin(), next_[a].end(), b) - next_[a].begin();
    double& known = taper_of(a, static_cast<std::size_t>(at));
    if (known < 0) known = search_taper(std::min(a, b), std::max(a, b), widest);
    return known;
  }
  double search_taper(Index a, Index b, double widest) {
    const auto& sides = sides_of(a, b, options_.reach * widest);
    double best = 0;
    for (int side = 0; side < 2; ++side) {
      CrossSection y;
      for (const CrossSection& c : sides[side])
        if (c.distance <= options_.reach * c.radius && c.radius > y.radius) y = c;
      if (y.radius <= 0) continue;
      for (const CrossSection& z : sides[1 - side])
        if (z.distance <= options_.reach * y.radius && y.distance + z.distance > 0)
          best = std::max(best, (y.radius * z.distance + z.radius * y.distance) / (y.distance + z.distance));
    }
    return best;
  }

  // Of edges that the cut, which is made, may have parted from what their tapers come from.
  void forget_tapers(const Cut& cut) {
    for (const Edge& edge : cut.edges)
      for (const Index end : edge) {
        reached_.assign(1, end);
        distance_[end] = 0;
        for (std::size_t i = 0; i < reached_.size(); ++i) {
          const Index n = reached_[i];
          for (std::size_t k = 0; k < next_[n].size(); ++k) {
            const Index other = next_[n][k];
            taper_of(n, k) = -1;
            const double there = distance_[n] + length(n, other);
            if (part_[other] != part_[n] || there > options_.reach * cut.widest || there >= distance_[other])
              continue;
            distance_[other] = there;
            reached_.push_back(other);
          }
        }
        for (const Index n : reached_) distance_[n] = kInfinite;
      }
  }
  double& taper_of(Index n, std::size_t k) {
    const Index other = next_[n][k];
    if (n < other) return taper_[n][k];
    return taper_[other][static_cast<std::size_t>(std::find(next_[other].begin(), next_[other].end(), n) -
                                                  next_[other].begin())];
  }

  // Whether what a cross-section cuts off is a part by its size. `area` is what is cut off from `whole`.
  bool is_part(double radius, double area, double whole) const {
    const double smaller = std::min(area, whole - area), perimeter = 2 * kPi * radius;
    return smaller > 0 && smaller >= options_.smallest * total_ &&
           smaller >= options_.slenderness * perimeter * perimeter;
  }
  double score(double radius, double area, double whole) const {
    return 2 * kPi * radius / std::sqrt(std::min(area, whole - area));
  }
  // For a contrast of `least` or more: tapers cost most of the search, so they wait until this holds.
  bool may_be_cleaner(const Cut& best, double radius, double least, double area, double whole) const {
    return least <= options_.contrast && is_part(radius, area, whole) &&
           score(radius, area, whole) < best.score;
  }
  // Keeps the cut if it is clean enough and cleaner than the best. `contrast` is the cross-section's share of
  // the taper's.
  void consider(Cut& best, double radius, double contrast, double area, double whole,
                std::initializer_list<Edge> edges) const {
    if (contrast > options_.contrast || !is_part(radius, area, whole)) return;
    const double found = score(radius, area, whole);
    if (found < best.score) best = {found, best.widest, edges};
  }

  // The edge above a node, where it could be cut by its size.
  struct Bridge {
    Index node;
    double radius, score;
  };
  // The cleanest first: the search for tapers ends at the first that has the contrast.
  std::vector<Bridge> bridges_of(const detail::PartTree& tree, double widest) const {
    std::vector<Bridge> bridges;
    const double whole = tree.area[tree.order[0]];
    for (const Index n : tree.order) {
      if (!tree.is_bridge(n)) continue;
      const double radius =
          soft_maximum(0.5 * (size_[tree.parent[n]] + size_[n]), kStraightened * tree.border[n] / (2 * kPi));
      if (radius > options_.contrast * widest || !is_part(radius, tree.area[n], whole)) continue;
      bridges.push_back({n, radius, score(radius, tree.area[n], whole)});
    }
    std::stable_sort(bridges.begin(), bridges.end(),
                     [](const Bridge& a, const Bridge& b) { return a.score < b.score; });
    return bridges;
  }
  Cut cleanest_cut(Index root) {
    watch_.ask(0.2);
    const detail::PartTree tree = detail::make_part_tree(skeleton_, next_, contacts_, part_, root);
    double widest = 0;
    for (const Index n : tree.order) widest = std::max(widest, size_[n]);
    Cut best;
    best.widest = widest;
    for (const Bridge& bridge : bridges_of(tree, widest)) {
      if (bridge.score >= best.score) break;
      const Index n = bridge.node, m = tree.parent[n];
      consider(best, bridge.radius, bridge.radius / tapered(m, n, widest), tree.area[n], tree.area[root],
               {Edge{m, n}});
    }
    for (const std::vector<Index>& chain : chains_on_cycles(tree))
      cut_stretch(best, chain, widest, tree.area[root]);
    return best;
  }

  // Chains of the part's edges that are no bridges; inner nodes have two neighbours in the part.
  std::vector<std::vector<Index>> chains_on_cycles(const detail::PartTree& tree) {
    const auto on_cycle = [&](Index a, Index b) {
      if (part_[a] != part_[b]) return false;
      return !(tree.parent[a] == b && tree.is_bridge(a)) && !(tree.parent[b] == a && tree.is_bridge(b));
    };
    const auto is_inner = [&](Index n) {
      Index degree = 0;
      for (const Index k : next_[n]) degree += part_[k] == part_[n] ? 1 : 0;
      return degree == 2 &&
             std::any_of(next_[n].begin(), next_[n].end(), [&](Index k) { return on_cycle(n, k); });
    };
    std::vector<std::vector<Index>> chains;
    std::vector<char> walked(part_.size(), 0);
    for (const Index start : tree.order) {
      if (is_inner(start)) continue;
      for (const Index first : next_[start]) {
        if (!on_cycle(start, first) || !is_inner(first) || walked[first]) continue;
        std::vector<Index> chain{start, first};
        while (is_inner(chain.back())) {
          const Index here = chain.back(), came = chain[chain.size() - 2];
          walked[here] = 1;
          for (const Index k : next_[here])
            if (k != came && part_[k] == part_[here]) chain.push_back(k);
        }
        chains.push_back(std::move(chain));
      }
    }
    return chains;
  }
  // What the inner nodes of a chain touch: nodes of the part that come before them in the chain, and all.
  struct ChainContacts {
    std::vector<std::vector<std::pair<std::size_t, double>>> before;  // place in the chain, length
    std::vector<double> all;
  };
  ChainContacts contacts_of(const std::vector<Index>& chain) {
    ChainContacts touched{std::vector<std::vector<std::pair<std::size_t, double>>>(chain.size()),
                          std::vector<double>(chain.size(), 0.0)};
    for (std::size_t i = 1; i + 1 < chain.size(); ++i) place_[chain[i]] = i;
    const Index part = part_[chain[0]];
    for (const NodeContact& contact : contacts_) {
      const auto [a, b] = contact.nodes;
      if (part_[a] != part || part_[b] != part) continue;
      const std::size_t first = std::min(place_[a], place_[b]), last = std::max(place_[a], place_[b]);
      touched.all[first] += contact.length;
      touched.all[last] += contact.length;
      if (first > 0) touched.before[last].push_back({first, contact.length});
    }
    for (const Index n : chain) place_[n] = 0;
    return touched;
  }
  void cut_stretch(Cut& best, const std::vector<Index>& chain, double widest, double whole) {
    const std::size_t edges = chain.size() - 1;
    std::optional<ChainContacts> touched;  // few chains have a stretch whose sections would do
    std::vector<double> radius(edges), least(edges), contrast(edges, -1.0);
    for (std::size_t i = 0; i < edges; ++i) {
      radius[i] = 0.5 * (size_[chain[i]] + size_[chain[i + 1]]);
      least[i] = kRounded * radius[i] / widest;
    }
    const auto contrast_at = [&](std::size_t i) {
      if (contrast[i] < 0) contrast[i] = radius[i] / tapered(chain[i], chain[i + 1], widest);
      return contrast[i];
    };
    for (std::size_t i = 0; i + 1 < edges; ++i) {
      if (least[i] > options_.contrast) continue;
      double area = 0, border = 0;
      std::size_t measured = i;  // the border is that of the nodes after i up to this one
      for (std::size_t j = i + 1; j < edges; ++j) {
        area += skeleton_.nodes[chain[j]].area;
        const double section = std::max(radius[i], radius[j]);
        if (!may_be_cleaner(best, section, std::max(least[i], least[j]), area, whole)) continue;
        if (!touched) touched = contacts_of(chain);
        while (measured < j) {
          border += touched->all[++measured];
          for (const auto& [place, length] : touched->before[measured])
            if (place > i) border -= 2 * length;
        }
        // Half of the border is that of either cut.
        const double wider = soft_maximum(section, kStraightened * border / (4 * kPi));
        const double longer = wider / section;
        if (!may_be_cleaner(best, wider, longer * std::max(least[i], least[j]), area, whole)) continue;
        consider(best, wider, longer * std::max(contrast_at(i), contrast_at(j)), area, whole,
                 {Edge{chain[i], chain[i + 1]}, Edge{chain[j], chain[j + 1]}});
      }
    }
  }

  const CurveSkeleton& skeleton_;
  const std::vector<NodeContact>& contacts_;
  PartOptions options_;
  detail::Watch watch_;
  std::vector<std::vector<Index>> next_;
  std::vector<double> size_;  // per node: radius of a circle with the cross-section's perimeter
  std::vector<Index> part_;
  std::vector<std::vector<double>>
      taper_;                     // per node and neighbour with a larger number; negative: not known
  std::vector<double> distance_;  // of sides_of, and infinite between its calls
  std::vector<char> side_;
  std::vector<std::size_t> place_;  // of contacts_of: in the chain, 0 elsewhere
  std::vector<Index> reached_;
  std::array<std::vector<CrossSection>, 2> sides_;
  std::vector<Index> root_;  // per part: one of its nodes
  std::vector<Cut> cut_;     // per part: its cleanest
  double total_ = 0;
};

void require(bool in_range, const char* message) {
  if (!in_range) throw UsageError(message);
}

}  // namespace

void validate(const PartOptions& options) {
  require(options.contrast > 0 && options.contrast <= 1, "parts: contrast must be above 0 and at most 1");
  require(options.reach >= 0 && options.reach <= 100, "parts: reach must be from 0 to 100");
  require(options.slenderness >= 0 && options.slenderness <= 100, "parts: slenderness must be from 0 to 100");
  require(options.smallest >= 0 && options.smallest <= 1, "parts: smallest must be from 0 to 1");
  require(options.count >= 0, "parts: count must not be negative");
}

SkeletonParts find_parts(const CurveSkeleton& skeleton, const std::vector<NodeContact>& contacts,
                         const PartOptions& options, const ProgressCallback& progress) {
  validate(options);
  return PartFinder(skeleton, contacts, options, progress).run();
}

}  // namespace mspskel
