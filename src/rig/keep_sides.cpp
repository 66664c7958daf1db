#include "keep_sides.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mspskel/base/clones.h"
#include "turned_face.h"

namespace mspskel::detail {
namespace {

// A face that turns over keeps half of its edges' changes, and none that are less than this, so that it ends.
constexpr double kLeastChange = 1e-3;

class SideKeeper {
 public:
  SideKeeper(const SurfaceSnapshot& surface, ShareSpread& spread)
      : surface_(surface),
        spread_(spread),
        ways_(spread.ways()),
        count_(spread.count()),
        last_look_(surface.face_count(), 0),
        turned_at_(surface.face_count(), kNone) {
    turned_.reserve(surface.face_count());
    rank_joints();
  }

  // Each round lowers shares by a least step, so it ends.
  void run() {
    std::vector<Starts> from(count_);
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (ways_.is_lowered(v)) keep_four(v, from);
    for (Index f = 0; f < surface_.face_count(); ++f) halve_turned(f, from);
    for (bool is_kept = false; !is_kept;) {
      is_kept = true;
      for (Index j = 1; j < count_; ++j) {
        spread_.lower_again(j, from[j].lowered, from[j].halved);
        from[j].lowered.clear();
        from[j].halved.clear();
        if (!spread_.changed(j).empty()) is_kept = false;
      }
      for (Index j = 1; j < count_; ++j) {
        for (const Index v : spread_.changed(j)) keep_four(v, from);
        look_at_faces(j, from[j]);
      }
    }
  }

 private:
  // Vertices that the next spread of a joint begins at.
  struct Starts {
    std::vector<Index> lowered, halved;  // their shares are lower already; faces at them were halved
  };

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
      bone[j] = (spread_.at(j) - spread_.at(above[j])).norm();
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
          if (turned(f, v).turns_over(spread_.at(j), weights(share))) halve(f, j, from[j]);
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
      spread_.keep_change(h, joint, most);
      from.halved.push_back(v);
    }
  }
  // Faces without a share that is lower than before keep their side.
  void look_at_faces(Index joint, Starts& from) {
    ++look_;
    for (const Index at : spread_.changed(joint)) {
      Index h = surface_.vertex_halfedge[at];
      const Index first = h;
      do {
        if (std::exchange(last_look_[h / 3], look_) != look_) {
          const auto v = corners(h / 3);
          const std::array<double, 3> share{ways_.at(v[0], joint), ways_.at(v[1], joint),
                                            ways_.at(v[2], joint)};
          const bool is_even = share[0] == share[1] && share[1] == share[2];
          if (!is_even && turned(h / 3, v).turns_over(spread_.at(joint), weights(share)))
            halve(h / 3, joint, from);
        }
        h = surface_.next_outgoing(h);
      } while (h != first);
    }
  }

  const SurfaceSnapshot& surface_;
  ShareSpread& spread_;
  JointWays& ways_;
  const Index count_;             // of joints
  std::vector<Index> rank_;       // per joint: which goes first
  std::vector<Index> last_look_;  // per face
  Index look_ = 0;
  std::vector<Index> turned_at_;  // per face: place in turned_, or kNone
  std::vector<TurnedFace> turned_;
};

}  // namespace

MSPSKEL_AVX_CLONES void keep_sides(const SurfaceSnapshot& surface, ShareSpread& spread) {
  SideKeeper(surface, spread).run();
}

}  // namespace mspskel::detail
