#include "bound_slopes.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

namespace mspskel::detail {
namespace {

// Of 1 / r. Turned by 45 degrees, what is r away moves by 0.77 r, and weights are 1.5 times as steep as
// shares where they are steepest; 0.87 would turn over a face that lies along the slope.
constexpr double kSteepest = 0.6;

class Slopes {
 public:
  Slopes(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares)
      : surface_(surface),
        rig_(rig),
        shares_(shares),
        steep_(rig.joints.size()),
        lowered_(surface.vertex_count(), kUnchanged) {
    for (const RigJoint& joint : rig.joints) at_.push_back(surface.frame.to_normalised(joint.position));
  }

  std::vector<LowerShare> run() {
    for (Index h = 0; h < surface_.halfedge_count(); ++h)
      if (!(shares_[surface_.origin[h]] == shares_[surface_.target(h)])) note(h);
    for (Index j = 1; j < static_cast<Index>(steep_.size()); ++j)
      if (!steep_[j].empty()) lower(j);
    std::sort(found_.begin(), found_.end(), [](const LowerShare& a, const LowerShare& b) {
      return std::tie(a.vertex, a.joint) < std::tie(b.vertex, b.joint);
    });
    return std::move(found_);
  }

 private:
  static constexpr double kUnchanged = 2;

  double most_change(Index h, Index joint) const {
    const Vector3 &a = surface_.position[surface_.origin[h]], &b = surface_.position[surface_.target(h)];
    const double length = (b - a).norm(), far = (0.5 * (a + b) - at_[joint]).norm();
    return kSteepest * length / std::max(far, 0.5 * length);
  }
  double share(Index v, Index joint) const {
    const BoneShare& s = shares_[v];
    if (s.joint == joint) return s.share;
    Index above = s.joint;
    while (above > joint) above = rig_.joints[above].parent;
    return above == joint ? 1.0 : 0.0;
  }
  // Keeps the half-edge with each joint whose share rises along it by too much.
  void note(Index h) {
    const BoneShare &low = shares_[surface_.origin[h]], &high = shares_[surface_.target(h)];
    for (Index j = high.joint; j > 0; j = rig_.joints[j].parent) {
      const double rise = (j == high.joint ? high.share : 1.0) - share(surface_.origin[h], j);
      if (rise > 0 && rise > most_change(h, j)) steep_[j].push_back(h);
      if (j == low.joint) return;
    }
  }
  // From the feet of what is too steep, the lowest first.
  void lower(Index joint) {
    using Item = std::pair<double, Index>;
    std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
    const auto from = [&](Index h, double here) {
      const Index w = surface_.target(h);
      const double present = std::min(lowered_[w], share(w, joint));
      if (present <= here) return;
      const double most = here + most_change(h, joint);
      if (most >= present) return;
      if (lowered_[w] == kUnchanged) touched_.push_back(w);
      lowered_[w] = most;
      queue.push({most, w});
    };
    for (const Index h : steep_[joint]) from(h, share(surface_.origin[h], joint));
    while (!queue.empty()) {
      const auto [here, v] = queue.top();
      queue.pop();
      if (here > lowered_[v]) continue;
      Index h = surface_.vertex_halfedge[v];
      const Index first = h;
      do {
        from(h, here);
        h = surface_.next_outgoing(h);
      } while (h != first);
    }
    for (const Index v : touched_) {
      found_.push_back({v, joint, lowered_[v]});
      lowered_[v] = kUnchanged;
    }
    touched_.clear();
  }

  const SurfaceSnapshot& surface_;
  const Rig& rig_;
  const std::vector<BoneShare>& shares_;
  std::vector<Vector3> at_;                // per joint, in the surface's frame
  std::vector<std::vector<Index>> steep_;  // per joint: half-edges, from low to high
  std::vector<double> lowered_;            // per vertex: of the present joint
  std::vector<Index> touched_;
  std::vector<LowerShare> found_;
};

}  // namespace

std::vector<LowerShare> bound_slopes(const SurfaceSnapshot& surface, const Rig& rig,
                                     const std::vector<BoneShare>& shares) {
  return Slopes(surface, rig, shares).run();
}

}  // namespace mspskel::detail
