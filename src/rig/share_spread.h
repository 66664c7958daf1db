// Shares that are lowered, and what that lowers along the surface.
#pragma once

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "joint_ways.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel::detail {

// Lowers joints' shares until none changes along an edge by more than a joint allows, a joint at a time. A
// vertex follows no joint more than the one that it hangs on, so joints are taken in their order.
class ShareSpread {
 public:
  // Keeps references to the surface and the shares.
  ShareSpread(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares);

  // From here on only shares become lower that are to be less than this.
  void set_limit(double limit) { limit_ = limit; }
  // Where shares of `joints` change by too much along edges, in place of what was noted before.
  void note_steep(const std::vector<char>& joints);
  // From what was noted, and from what the last spread of the joint above lowered.
  void lower_along_edges(Index joint);
  // From vertices whose shares are lower already, those at edges that keep less, and those as above.
  void lower_again(Index joint, const std::vector<Index>& lowered, const std::vector<Index>& halved);
  // The joint's share changes by no more than `most` along the edge from the next spread on.
  void keep_change(Index h, Index joint, double most);

  Index count() const { return static_cast<Index>(at_.size()); }  // of joints
  const Vector3& at(Index joint) const { return at_[joint]; }     // in the surface's frame
  // Vertices that the joint's last spread lowered.
  const std::vector<Index>& changed(Index joint) const { return changed_[joint]; }
  JointWays& ways() { return ways_; }
  const JointWays& ways() const { return ways_; }

 private:
  // Of a vertex, to be told once a spread, since most are looked at from all their neighbours.
  struct Here {
    Index spread = 0;
    bool is_lowered = false;
    double share = 0;
    double square_far = 0;  // from the joint
  };
  struct Item {
    double share;
    Index vertex;
  };
  // Shares from 0 to 1 wait in so many stretches. Within one they come in any order, which costs less than a
  // heap, since a vertex that is lowered again is spread from again.
  static constexpr std::size_t kStretches = 64;

  bool is_even(Index f) const;
  void note_if_steep(Index h, const std::vector<char>& joints);
  double most_change(Index h, Index joint) const;
  Index edge(Index h) const { return std::min(h, surface_.twin[h]); }
  void begin_spread(Index joint);
  bool is_flat_as_above(Index v, const Here& here);
  double longest_square(Index v);
  Here& look_up(Index v);
  void lower(Index v, Here& here, double share);
  void note_changed(Index v, Here& here);
  void spread_from(Index v, double share);
  void along_edge(Index h, const Here& here);
  void spread_below();

  const SurfaceSnapshot& surface_;
  JointWays ways_;
  std::vector<Vector3> at_;                              // per joint
  std::vector<std::vector<Index>> steep_;                // per joint: half-edges, from low to high
  std::vector<std::unordered_map<Index, double>> most_;  // per joint: of edges that keep less
  std::vector<char> is_halved_;                          // per vertex: whether at an edge in most_
  std::vector<std::vector<Index>> changed_;              // per joint
  double limit_ = 1;
  Index joint_ = 0;  // of the present spread
  Index spread_ = 0;
  std::vector<Here> here_;                 // per vertex
  std::vector<double> longest_square_;     // per vertex: of its edges; negative: not known
  std::vector<std::vector<Item>> queue_;   // per stretch of shares
  std::size_t first_queued_ = kStretches;  // no stretch before it has an item
};

}  // namespace mspskel::detail
