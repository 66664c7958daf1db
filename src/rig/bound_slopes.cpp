#include "bound_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>
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
        is_halved_(surface.vertex_count(), 0),
        changed_(rig.joints.size()),
        here_(surface.vertex_count()),
        last_look_(surface.face_count(), 0),
        turned_at_(surface.face_count(), kNone),
        longest_square_(surface.vertex_count(), -1.0) {
    for (const RigJoint& joint : rig.joints) at_.push_back(surface.frame.to_normalised(joint.position));
  }

  JointWays lower_all() {
    note_steep(std::vector<char>(count_, 1));
    for (Index j = 1; j < count_; ++j) lower_along_edges(j);
    rank_joints();
    keep_sides();
    return std::move(ways_);
  }
  // Whether a vertex follows one of the joints by half or more, as far as edges tell. Joints above lower it
  // only further, so they are not asked where none does already. Nor is it asked where else shares of half or
  // more fall, since what falls below half falls from less.
  bool is_one_followed(const std::vector<char>& joints) {
    limit_ = 0.5;
    note_steep(joints);
    for (Index j = 1; j < count_; ++j)
      if (joints[j]) lower_along_edges(j);
    std::vector<char> on_way(count_, 0);
    std::vector<Index> followers;
    for (Index v = 0; v < surface_.vertex_count(); ++v) {
      Index j = ways_.of_map(v).joint;
      while (j > 0 && !(joints[j] && ways_.at_on_way(v, j) >= 0.5)) j = ways_.above(j);
      if (j > 0) followers.push_back(v);
      for (; j > 0; j = ways_.above(j)) on_way[j] = 1;
    }
    for (std::vector<Index>& edges : steep_) edges.clear();
    if (!followers.empty()) note_steep(on_way);
    for (Index j = 1; j < count_ && !followers.empty(); ++j) {
      if (!on_way[j]) continue;
      lower_along_edges(j);
      followers.erase(std::remove_if(followers.begin(), followers.end(),
                                     [&](Index v) { return !may_lead(v, j, joints); }),
                      followers.end());
    }
    return !followers.empty();
  }

 private:
  // Whether the vertex may follow by half or more one of `joints` that is the joint or below it, or one
  // above.
  bool may_lead(Index v, Index joint, const std::vector<char>& joints) const {
    if (!ways_.is_on_way(v, joint) || ways_.at_on_way(v, joint) >= 0.5) return true;
    for (Index j = ways_.above(joint); j > 0; j = ways_.above(j))
      if (joints[j]) return true;
    return false;
  }
  void lower_along_edges(Index joint) {
    begin_spread(joint);
    for (const Index h : steep_[joint]) along_edge(h, look_up(surface_.origin[h]));
    spread_below();
  }
  // Where shares of `joints` change by too much along edges, per joint.
  void note_steep(const std::vector<char>& joints) {
    for (Index h = 0; h < surface_.halfedge_count(); ++h) {
      if (h % 3 == 0 && is_even(h / 3)) {
        h += 2;
        continue;
      }
      const Index v = surface_.origin[h], w = surface_.target(h);
      const BoneShare &low = ways_.of_map(v), &high = ways_.of_map(w);
      if (low == high) continue;
      for (Index j = high.joint; j > 0; j = ways_.above(j)) {
        if (joints[j]) {
          const double rise = (j == high.joint ? high.share : 1.0) - ways_.at(v, j);
          if (rise > 0 && rise > most_change(h, j)) steep_[j].push_back(h);
        }
        if (j == low.joint) break;
      }
    }
  }
  bool is_even(Index f) const {
    const BoneShare& first = ways_.of_map(surface_.origin[3 * f]);
    return first == ways_.of_map(surface_.origin[3 * f + 1]) &&
           first == ways_.of_map(surface_.origin[3 * f + 2]);
  }
  double most_change(Index h, Index joint) const {
    const Vector3 &a = surface_.position[surface_.origin[h]], &b = surface_.position[surface_.target(h)];
    const double square = (b - a).squaredNorm(), far = (0.5 * (a + b) - at_[joint]).squaredNorm();
    return kSteepest * std::sqrt(square / std::max(far, 0.25 * square));
  }
  Index edge(Index h) const { return std::min(h, surface_.twin[h]); }

  // Of a vertex, to be told once a spread, since most are looked at from all their neighbours.
  struct Here {
    Index spread = 0;
    bool is_lowered = false;
    double share = 0;
    double square_far = 0;  // from the joint
  };
  void begin_spread(Index joint) {
    joint_ = joint;
    changed_[joint].clear();
    ++spread_;
  }
  // Whether the joint allows each edge at v what the one above allows it, being nearer to the edge's middle.
  bool is_flat_as_above(Index v, const Here& here) {
    if (is_halved_[v]) return false;
    const Vector3 &up = at_[ways_.above(joint_)], bone = at_[joint_] - up;
    const double nearer = (surface_.position[v] - up).squaredNorm() - here.square_far;
    return nearer >= 0 && nearer * nearer >= bone.squaredNorm() * longest_square(v);
  }
  // Of the edges at a vertex.
  double longest_square(Index v) {
    double& longest = longest_square_[v];
    if (longest < 0) {
      longest = 0;
      for_each_neighbour(surface_, v, [&](Index w) {
        longest = std::max(longest, (surface_.position[w] - surface_.position[v]).squaredNorm());
      });
    }
    return longest;
  }
  Here& look_up(Index v) {
    Here& here = here_[v];
    if (here.spread != spread_)
      here = {spread_, false, ways_.at(v, joint_), (surface_.position[v] - at_[joint_]).squaredNorm()};
    return here;
  }
  void lower(Index v, Here& here, double share) {
    here.share = share;
    note_changed(v, here);
    spread_from(v, share);
  }
  void note_changed(Index v, Here& here) {
    if (!here.is_lowered) changed_[joint_].push_back(v);
    here.is_lowered = true;
  }
  void spread_from(Index v, double share) {
    queue_.push_back({share, v});
    std::push_heap(queue_.begin(), queue_.end());
  }
  void along_edge(Index h, const Here& here) {
    if (here.share >= limit_) return;
    const Index w = surface_.origin[surface_.twin[h]];
    Here& there = look_up(w);
    const double rise = there.share - here.share;
    if (rise <= 0) return;
    const double square = (surface_.position[w] - surface_.position[surface_.origin[h]]).squaredNorm();
    // Of the edge's middle.
    const double far = std::max(0.5 * (here.square_far + there.square_far) - 0.25 * square, 0.25 * square);
    const bool is_flat = kSteepest * kSteepest * square >= rise * rise * far;
    const bool may_be_halved = is_halved_[w] && is_halved_[surface_.origin[h]];
    if (is_flat && !may_be_halved) return;
    double most = is_flat ? rise : kSteepest * std::sqrt(square / far);
    if (may_be_halved)
      if (const auto kept = most_[joint_].find(edge(h)); kept != most_[joint_].end())
        most = std::min(most, kept->second);
    if (const double share = here.share + most; share < std::min(there.share, limit_)) lower(w, there, share);
  }
  // A vertex follows no joint more than the one that it hangs on. Then from what is queued, the lowest first.
  void spread_below() {
    const Index above = ways_.above(joint_);
    for (const Index v : changed_[above]) {
      if (!ways_.is_on_way(v, joint_)) continue;
      const double most = ways_.at_on_way(v, above);
      if (!(most < std::min(ways_.at_on_way(v, joint_), limit_))) continue;
      Here& here = look_up(v);
      if (!(most < here.share)) continue;
      here.share = most;
      note_changed(v, here);
      if (!is_flat_as_above(v, here)) spread_from(v, most);
    }
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end());
      const auto [share, v] = queue_.back();
      queue_.pop_back();
      const Here& here = look_up(v);
      if (share > here.share) continue;
      Index h = surface_.vertex_halfedge[v];
      const Index first = h;
      do {
        along_edge(h, here);
        h = surface_.next_outgoing(h);
      } while (h != first);
    }
    for (const Index v : changed_[joint_])
      if (here_[v].share < ways_.at(v, joint_)) ways_.lower(v, joint_, here_[v].share);
  }

  // Vertices that the next spread of a joint begins at.
  struct Starts {
    std::vector<Index> lowered, halved;  // their shares are lower already; faces at them were halved
  };
  // Until each vertex follows four joints or fewer and no face turns over: of the joints that a vertex has
  // more, the one with the shortest bone has nothing of its own; the edges of a face that turns over keep
  // half of their changes. Each lowers shares by a least step, so it ends.
  void keep_sides() {
    std::vector<Starts> from(count_);
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (ways_.is_lowered(v)) keep_four(v, from);
    for (Index f = 0; f < surface_.face_count(); ++f) halve_turned(f, from);
    for (bool is_kept = false; !is_kept;) {
      is_kept = true;
      for (Index j = 1; j < count_; ++j) {
        begin_spread(j);
        for (const Index v : from[j].lowered) {
          note_changed(v, look_up(v));
          spread_from(v, look_up(v).share);
        }
        for (const Index v : from[j].halved) spread_from(v, look_up(v).share);
        from[j].lowered.clear();
        from[j].halved.clear();
        spread_below();
        if (!changed_[j].empty()) is_kept = false;
      }
      for (Index j = 1; j < count_; ++j) {
        for (const Index v : changed_[j]) keep_four(v, from);
        look_at_faces(j, from[j]);
      }
    }
  }
  std::array<Index, 3> corners(Index f) const {
    return {surface_.origin[3 * f], surface_.origin[3 * f + 1], surface_.origin[3 * f + 2]};
  }
  // Most are looked at for several joints.
  const TurnedFace& turned(Index f, const std::array<Index, 3>& v) {
    if (turned_at_[f] == kNone) {
      turned_at_[f] = static_cast<Index>(turned_.size());
      turned_.emplace_back(surface_.position[v[0]], surface_.position[v[1]], surface_.position[v[2]]);
    }
    return turned_[turned_at_[f]];
  }
  static std::array<double, 3> weights(const std::array<double, 3>& share) {
    return {smooth_share(share[0]), smooth_share(share[1]), smooth_share(share[2])};
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
  void keep_four(Index v, std::vector<Starts>& from) {
    while (ways_.level(ways_.of_map(v).joint) > 3) {
      Index joints = 0, first = kNone;
      double below = 0;
      for (Index j = ways_.of_map(v).joint; j != kNone; j = ways_.above(j)) {
        const double weight = smooth_share(ways_.at_on_way(v, j)), own = weight - below;
        below = weight;
        if (own <= kLeastWeight) continue;
        ++joints;
        if (j > 0 && (first == kNone || rank_[j] < rank_[first])) first = j;
      }
      if (joints <= 4) return;
      Index next = kNone;
      for (Index j = ways_.of_map(v).joint; j != first; j = ways_.above(j)) next = j;
      ways_.lower(v, first, next == kNone ? 0.0 : ways_.at(v, next));
      from[first].lowered.push_back(v);
    }
  }
  void halve_turned(Index f, std::vector<Starts>& from) {
    const std::array<Index, 3> v = corners(f);
    const auto as_first = [&](Index w) {
      return !ways_.is_lowered(w) && ways_.of_map(w) == ways_.of_map(v[0]);
    };
    if (as_first(v[0]) && as_first(v[1]) && as_first(v[2])) return;
    for (std::size_t k = 0; k < 3; ++k) {
      bool is_common = false;
      for (Index j = ways_.of_map(v[k]).joint; j > 0; j = ways_.above(j)) {
        std::array<double, 3> share{};
        if (!is_common) {
          const std::array<bool, 3> on{ways_.is_on_way(v[0], j), ways_.is_on_way(v[1], j),
                                       ways_.is_on_way(v[2], j)};
          if ((k > 0 && on[0]) || (k > 1 && on[1])) break;
          is_common = on[0] && on[1] && on[2];
          for (std::size_t i = 0; i < 3; ++i)
            if (on[i]) share[i] = ways_.at_on_way(v[i], j);
        } else {
          for (std::size_t i = 0; i < 3; ++i) share[i] = ways_.at_on_way(v[i], j);
        }
        if (share[0] != share[1] || share[1] != share[2]) {
          if (turned(f, v).turns_over(at_[j], weights(share))) halve(f, j, from[j]);
        } else if (share[0] == 1) {
          break;
        }
      }
    }
  }
  void halve(Index f, Index joint, Starts& from) {
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      const Index v = surface_.origin[h];
      const double change = std::abs(ways_.at(v, joint) - ways_.at(surface_.target(h), joint)),
                   most = change < 2 * kLeastChange ? 0 : 0.5 * change;
      const auto kept = most_[joint].insert({edge(h), most}).first;
      kept->second = std::min(kept->second, most);
      from.halved.push_back(v);
      is_halved_[v] = 1;
    }
  }
  // Faces without a share that is lower than before keep their side.
  void look_at_faces(Index joint, Starts& from) {
    ++look_;
    for (const Index at : changed_[joint]) {
      Index h = surface_.vertex_halfedge[at];
      const Index first = h;
      do {
        if (std::exchange(last_look_[h / 3], look_) != look_) {
          const auto v = corners(h / 3);
          const std::array<double, 3> share{ways_.at(v[0], joint), ways_.at(v[1], joint),
                                            ways_.at(v[2], joint)};
          const bool is_even = share[0] == share[1] && share[1] == share[2];
          if (!is_even && turned(h / 3, v).turns_over(at_[joint], weights(share))) halve(h / 3, joint, from);
        }
        h = surface_.next_outgoing(h);
      } while (h != first);
    }
  }

  const SurfaceSnapshot& surface_;
  const Index count_;  // of joints
  JointWays ways_;
  std::vector<Vector3> at_;                              // per joint, in the surface's frame
  std::vector<std::vector<Index>> steep_;                // per joint: half-edges, from low to high
  std::vector<std::unordered_map<Index, double>> most_;  // per joint: of edges of faces that turned over
  std::vector<char> is_halved_;                          // per vertex: whether at an edge in most_
  std::vector<std::vector<Index>> changed_;              // per joint: vertices that its last spread lowered
  std::vector<Index> rank_;                              // per joint: which goes first
  double limit_ = 1;                                     // shares become lower where less than this
  Index joint_ = 0;                                      // of the present spread
  Index spread_ = 0;
  std::vector<Here> here_;        // per vertex
  std::vector<Index> last_look_;  // per face
  Index look_ = 0;
  std::vector<Index> turned_at_;  // per face: place in turned_, or kNone
  std::vector<TurnedFace> turned_;
  std::vector<double> longest_square_;  // per vertex: of its edges; negative: not known
  struct Item {
    double share;
    Index vertex;
    bool operator<(const Item& other) const { return share > other.share; }
  };
  std::vector<Item> queue_;  // the lowest share first
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
