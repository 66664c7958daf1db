#include "bound_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <utility>

#include "turned_face.h"

namespace mspskel::detail {
namespace {

// Of 1 / r. Turned by 45 degrees, what is r away moves by 0.77 r, and weights are 1.5 times as steep as
// shares where they are steepest; 0.87 would turn over a face that lies along the slope.
constexpr double kSteepest = 0.6;

// A face that turns over keeps half of its edges' changes, and none that are less than this, so that it ends.
constexpr double kLeastChange = 1e-3;

class Slopes {
 public:
  Slopes(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares)
      : surface_(surface),
        count_(static_cast<Index>(rig.joints.size())),
        ways_(rig, shares),
        steep_(rig.joints.size()),
        most_(rig.joints.size()),
        changed_(rig.joints.size()),
        is_changed_(surface.vertex_count(), 0),
        last_look_(surface.face_count(), 0) {
    for (const RigJoint& joint : rig.joints) at_.push_back(surface.frame.to_normalised(joint.position));
    note_steep();
  }

  JointWays lower_all() {
    lower_along_edges();
    rank_joints();
    keep_sides();
    return std::move(ways_);
  }
  // Whether a vertex follows one of the joints by half or more, as far as edges tell.
  bool is_one_followed(const std::vector<char>& joints) {
    lower_along_edges();
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      for (Index j = ways_.of_map(v).joint; j != kNone; j = ways_.above(j))
        if (joints[j] && ways_.at(v, j) >= 0.5) return true;
    return false;
  }

 private:
  void lower_along_edges() {
    for (Index j = 1; j < count_; ++j) {
      for (const Index h : steep_[j]) along_edge(h, ways_.at(surface_.origin[h], j), j);
      spread_below(j);
    }
  }
  // Where shares change by too much along edges, per joint.
  void note_steep() {
    for (Index h = 0; h < surface_.halfedge_count(); ++h) {
      const Index v = surface_.origin[h], w = surface_.target(h);
      const BoneShare &low = ways_.of_map(v), &high = ways_.of_map(w);
      if (low == high) continue;
      for (Index j = high.joint; j > 0; j = ways_.above(j)) {
        const double rise = (j == high.joint ? high.share : 1.0) - ways_.at(v, j);
        if (rise > 0 && rise > most_change(h, j)) steep_[j].push_back(h);
        if (j == low.joint) break;
      }
    }
  }
  double most_change(Index h, Index joint) const {
    const Vector3 &a = surface_.position[surface_.origin[h]], &b = surface_.position[surface_.target(h)];
    const double length = (b - a).norm(), far = (0.5 * (a + b) - at_[joint]).norm();
    const double most = kSteepest * length / std::max(far, 0.5 * length);
    if (most_[joint].empty()) return most;
    const auto kept = most_[joint].find(edge(h));
    return kept == most_[joint].end() ? most : std::min(most, kept->second);
  }
  Index edge(Index h) const { return std::min(h, surface_.twin[h]); }
  void lower(Index v, Index joint, double share) {
    ways_.lower(v, joint, share);
    spread_from(v, share, joint);
  }
  void spread_from(Index v, double share, Index joint) {
    queue_.push_back({share, v});
    std::push_heap(queue_.begin(), queue_.end(), std::greater<Item>());
    if (!is_changed_[v]) changed_[joint].push_back(v);
    is_changed_[v] = 1;
  }
  void along_edge(Index h, double here, Index joint) {
    const Index w = surface_.target(h);
    const double there = ways_.at(w, joint);
    if (there <= here) return;
    const Vector3 &a = surface_.position[surface_.origin[h]], &b = surface_.position[w];
    const double rise = there - here, square = (b - a).squaredNorm();
    const double far = std::max((0.5 * (a + b) - at_[joint]).squaredNorm(), 0.25 * square);
    if (most_[joint].empty() && kSteepest * kSteepest * square >= rise * rise * far) return;
    if (const double most = here + most_change(h, joint); most < there) lower(w, joint, most);
  }
  // From what is queued, the lowest first.
  void spread(Index joint) {
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), std::greater<Item>());
      const auto [here, v] = queue_.back();
      queue_.pop_back();
      if (here > ways_.at(v, joint)) continue;
      Index h = surface_.vertex_halfedge[v];
      const Index first = h;
      do {
        along_edge(h, here, joint);
        h = surface_.next_outgoing(h);
      } while (h != first);
    }
    for (const Index v : changed_[joint]) is_changed_[v] = 0;
  }
  // A vertex follows no joint more than the one that it hangs on.
  void spread_below(Index joint) {
    for (const Index v : changed_[ways_.above(joint)])
      if (const double most = ways_.at(v, ways_.above(joint)); most < ways_.at(v, joint))
        lower(v, joint, most);
    spread(joint);
  }

  // Until each vertex follows four joints or fewer and no face turns over: of the joints that a vertex has
  // more, the one with the shortest bone has nothing of its own; the edges of a face that turns over keep
  // half of their changes. Each lowers shares by a least step, so it ends.
  void keep_sides() {
    std::vector<std::vector<Index>> from(count_);
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (ways_.is_lowered(v)) keep_four(v, from);
    for (Index f = 0; f < surface_.face_count(); ++f) halve_turned(f, from);
    for (bool is_kept = false; !is_kept;) {
      is_kept = true;
      for (Index j = 1; j < count_; ++j) {
        changed_[j].clear();
        for (const Index v : from[j]) spread_from(v, ways_.at(v, j), j);
        from[j].clear();
        spread_below(j);
        if (!changed_[j].empty()) is_kept = false;
      }
      for (Index j = 1; j < count_; ++j) {
        for (const Index v : changed_[j]) keep_four(v, from);
        for (const Index f : faces_at(changed_[j])) {
          const auto v = corners(f);
          if (TurnedFace(positions(v)).turns_over(at_[j], weights(v, j))) halve(f, j, from[j]);
        }
      }
    }
  }
  std::array<Index, 3> corners(Index f) const {
    return {surface_.origin[3 * f], surface_.origin[3 * f + 1], surface_.origin[3 * f + 2]};
  }
  std::array<Vector3, 3> positions(const std::array<Index, 3>& v) const {
    return {surface_.position[v[0]], surface_.position[v[1]], surface_.position[v[2]]};
  }
  std::array<double, 3> weights(const std::array<Index, 3>& v, Index j) const {
    return {smooth_share(ways_.at(v[0], j)), smooth_share(ways_.at(v[1], j)),
            smooth_share(ways_.at(v[2], j))};
  }
  // The shortest bone first; what hangs on its joint then hangs on the one above.
  void rank_joints() {
    std::vector<Index> above(count_, kNone);
    std::vector<double> bone(count_, 0);
    rank_.assign(count_, kNone);
    for (Index j = 1; j < count_; ++j) {
      above[j] = ways_.above(j);
      bone[j] = (at_[j] - at_[above[j]]).norm();
    }
    for (Index rank = 0; rank + 1 < count_; ++rank) {
      Index shortest = kNone;
      for (Index j = 1; j < count_; ++j)
        if (rank_[j] == kNone && (shortest == kNone || bone[j] < bone[shortest])) shortest = j;
      rank_[shortest] = rank;
      for (Index j = 1; j < count_; ++j) {
        if (above[j] != shortest) continue;
        above[j] = above[shortest];
        bone[j] += bone[shortest];
      }
    }
  }
  void keep_four(Index v, std::vector<std::vector<Index>>& from) {
    for (;;) {
      Index joints = 0, first = kNone;
      double below = 0;
      for (Index j = ways_.of_map(v).joint; j != kNone; j = ways_.above(j)) {
        const double weight = smooth_share(ways_.at(v, j)), own = weight - below;
        below = weight;
        if (own <= kLeastWeight) continue;
        ++joints;
        if (j > 0 && (first == kNone || rank_[j] < rank_[first])) first = j;
      }
      if (joints <= 4) return;
      Index next = kNone;
      for (Index j = ways_.of_map(v).joint; j != first; j = ways_.above(j)) next = j;
      ways_.lower(v, first, next == kNone ? 0.0 : ways_.at(v, next));
      from[first].push_back(v);
    }
  }
  void halve_turned(Index f, std::vector<std::vector<Index>>& from) {
    const std::array<Index, 3> v = corners(f);
    const auto as_first = [&](Index w) {
      return !ways_.is_lowered(w) && ways_.of_map(w) == ways_.of_map(v[0]);
    };
    if (as_first(v[0]) && as_first(v[1]) && as_first(v[2])) return;
    const TurnedFace face(positions(v));
    for (std::size_t k = 0; k < 3; ++k)
      for (Index j = ways_.of_map(v[k]).joint; j > 0; j = ways_.above(j)) {
        if ((k > 0 && ways_.is_on_way(v[0], j)) || (k > 1 && ways_.is_on_way(v[1], j))) break;
        const std::array<double, 3> weight = weights(v, j);
        if (weight[0] == 1 && weight[1] == 1 && weight[2] == 1) break;
        if (weight[0] == weight[1] && weight[1] == weight[2]) continue;
        if (face.turns_over(at_[j], weight)) halve(f, j, from[j]);
      }
  }
  void halve(Index f, Index joint, std::vector<Index>& from) {
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index v = surface_.origin[h];
      const double change = std::abs(ways_.at(v, joint) - ways_.at(surface_.target(h), joint)),
                   most = change < 2 * kLeastChange ? 0 : 0.5 * change;
      const auto kept = most_[joint].insert({edge(h), most}).first;
      kept->second = std::min(kept->second, most);
      from.push_back(v);
    }
  }
  std::vector<Index> faces_at(const std::vector<Index>& vertices) {
    ++look_;
    std::vector<Index> faces;
    for (const Index v : vertices) {
      Index h = surface_.vertex_halfedge[v];
      const Index first = h;
      do {
        if (std::exchange(last_look_[h / 3], look_) != look_) faces.push_back(h / 3);
        h = surface_.next_outgoing(h);
      } while (h != first);
    }
    return faces;
  }

  const SurfaceSnapshot& surface_;
  const Index count_;  // of joints
  JointWays ways_;
  const std::vector<char> asked_;                        // per joint
  std::vector<Vector3> at_;                              // per joint, in the surface's frame
  std::vector<std::vector<Index>> steep_;                // per joint: half-edges, from low to high
  std::vector<std::unordered_map<Index, double>> most_;  // per joint: of edges of faces that turned over
  std::vector<std::vector<Index>> changed_;              // per joint: vertices, at the last spread
  std::vector<Index> rank_;                              // per joint: which goes first
  std::vector<char> is_changed_;  // per vertex: whether in the present joint's changed_
  std::vector<Index> last_look_;  // per face
  Index look_ = 0;
  using Item = std::pair<double, Index>;
  std::vector<Item> queue_;  // shares of vertices
};

}  // namespace

JointWays bound_slopes(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares) {
  return Slopes(surface, rig, shares).lower_all();
}

bool may_follow(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares,
                const std::vector<char>& joints) {
  return Slopes(surface, rig, shares).is_one_followed(joints);
}

}  // namespace mspskel::detail
