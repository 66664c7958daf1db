#include "pair_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "../mesh/edge_table.h"
#include "disjoint_sets.h"

namespace mspskel::detail {
namespace {

// A face at an edge a-b: by angle round the edge, from the first face on.
struct Spoke {
  double angle;  // radians, 0 to 2 pi
  bool ends;     // material ends here as the angle grows: the face runs from a to b
  Index halfedge;
};

class Pairing {
 public:
  Pairing(const std::vector<Vector3>& points, FaceSet& faces, MendCounts& counts)
      : points_(points), faces_(faces), counts_(counts), sets_(faces.count()) {}

  std::vector<Index> run() {
    const auto vertices = static_cast<Index>(points_.size());
    orient(EdgeTable(vertices, faces_.corners));
    return match(EdgeTable(vertices, faces_.corners));
  }

 private:
  void orient(const EdgeTable& edges) {
    edges.each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd* last) {
      if (last - first != 2) return;
      const Index g = first[0].halfedge, h = first[1].halfedge;
      sets_.unite(g / 3, h / 3, faces_.origin(g) == faces_.origin(h));
    });
    const std::vector<char> crowded = join_patches(edges);
    turn(crowded);
  }

  // Patches that meet at crowded edges: the pairs of patches with most votes first. Per root of a set that
  // has such edges 1.
  std::vector<char> join_patches(const EdgeTable& edges) {
    std::map<std::pair<Index, Index>, Index> votes;  // positive: equal
    std::vector<Index> touched;
    edges.each_edge([&](Index a, Index b, const HalfedgeEnd* first, const HalfedgeEnd* last) {
      if (last - first < 3) return;
      sort_spokes(a, b, first, last);
      touched.push_back(first->halfedge / 3);
      for (std::size_t i = 0; i < spokes_.size(); ++i) {
        const Spoke &s = spokes_[i], &t = spokes_[(i + 1) % spokes_.size()];
        const auto [p, turned_p] = sets_.find(s.halfedge / 3);
        const auto [q, turned_q] = sets_.find(t.halfedge / 3);
        if (p == q) continue;
        const bool opposite = (s.ends == t.ends) != (turned_p != turned_q);
        votes[{std::min(p, q), std::max(p, q)}] += opposite ? -1 : 1;
      }
    });
    std::vector<std::tuple<Index, Index, Index, char>> order;
    for (const auto& [pair, vote] : votes)
      if (vote != 0) order.emplace_back(-std::abs(vote), pair.first, pair.second, vote < 0);
    std::sort(order.begin(), order.end());
    for (const auto& [weight, p, q, opposite] : order) sets_.unite(p, q, opposite);
    std::vector<char> crowded(faces_.count(), 0);
    for (const Index f : touched) crowded[sets_.find(f).first] = 1;
    return crowded;
  }

  void turn(const std::vector<char>& crowded) {
    const Index count = faces_.count();
    std::vector<Index> balance(count, 0);  // per set: faces that agree with the root less those that do not
    std::vector<double> volume(count, 0.0);
    for (Index f = 0; f < count; ++f) {
      const auto [root, opposite] = sets_.find(f);
      balance[root] += opposite ? -1 : 1;
      const Vector3& base = points_[faces_.corners[3 * root]];
      volume[root] +=
          (opposite ? -1 : 1) * area_vector(points_, faces_, f).dot(points_[faces_.corners[3 * f]] - base);
    }
    for (Index f = 0; f < count; ++f) {
      const auto [root, opposite] = sets_.find(f);
      bool turned = opposite != (balance[root] < 0);
      // The pairs depend on which side is material, so the majority has no say.
      if (crowded[root]) turned = opposite != (volume[root] < 0);
      if (!turned) continue;
      std::swap(faces_.corners[3 * f + 1], faces_.corners[3 * f + 2]);
      ++counts_.turned_faces;
    }
  }

  std::vector<Index> match(const EdgeTable& edges) {
    std::vector<Index> twin(faces_.corners.size(), kNone);
    edges.each_edge([&](Index a, Index b, const HalfedgeEnd* first, const HalfedgeEnd* last) {
      if (last - first == 2) {
        const Index g = first[0].halfedge, h = first[1].halfedge;
        if (faces_.origin(g) == faces_.origin(h)) {
          ++counts_.one_sided_edges;
          return;
        }
        twin[g] = h;
        twin[h] = g;
      } else if (last - first > 2) {
        ++counts_.paired_edges;
        sort_spokes(a, b, first, last);
        match_wedges(twin);
      }
    });
    return twin;
  }

  // As brackets: where material begins and the nearest end after it, also past 2 pi.
  void match_wedges(std::vector<Index>& twin) {
    std::vector<Index> open;
    for (int round = 0; round < 2; ++round)
      for (const Spoke& s : spokes_) {
        if (!s.ends) {
          if (round == 0) open.push_back(s.halfedge);
        } else if (twin[s.halfedge] == kNone && !open.empty()) {
          twin[s.halfedge] = open.back();
          twin[open.back()] = s.halfedge;
          open.pop_back();
        }
      }
  }

  void sort_spokes(Index a, Index b, const HalfedgeEnd* first, const HalfedgeEnd* last) {
    const Vector3 axis = (points_[b] - points_[a]).normalized();
    const auto arm = [&](Index h) {
      const Vector3 to_apex = points_[faces_.corners[FaceSet::prev(h)]] - points_[a];
      return Vector3(to_apex - to_apex.dot(axis) * axis);
    };
    const Vector3 x = arm(first->halfedge), y = axis.cross(x);
    spokes_.clear();
    for (const HalfedgeEnd* e = first; e != last; ++e) {
      const Vector3 r = arm(e->halfedge);
      double angle = std::atan2(r.dot(y), r.dot(x));
      if (angle < -kCoincident) angle += 2 * kPi;
      spokes_.push_back({angle, faces_.origin(e->halfedge) == a, e->halfedge});
    }
    std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& s, const Spoke& t) {
      return s.angle != t.angle ? s.angle < t.angle : s.halfedge < t.halfedge;
    });
    // Where faces coincide material ends before it begins again.
    for (std::size_t i = 0, j; i < spokes_.size(); i = j) {
      for (j = i + 1; j < spokes_.size() && spokes_[j].angle - spokes_[j - 1].angle < kCoincident;) ++j;
      std::stable_partition(spokes_.begin() + i, spokes_.begin() + j, [](const Spoke& s) { return s.ends; });
    }
  }

  static constexpr double kCoincident = 1e-9;  // radians
  const std::vector<Vector3>& points_;
  FaceSet& faces_;
  MendCounts& counts_;
  SignedSets sets_;
  std::vector<Spoke> spokes_;
};

}  // namespace

std::vector<Index> pair_faces(const std::vector<Vector3>& points, FaceSet& faces, MendCounts& counts) {
  return Pairing(points, faces, counts).run();
}

}  // namespace mspskel::detail
