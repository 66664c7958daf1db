#include "bound_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

namespace mspskel::detail {
namespace {

// Of 1 / r. Turned by 45 degrees, what is r away moves by 0.77 r, and weights are 1.5 times as steep as
// shares where they are steepest; 0.87 would turn over a face that lies along the slope.
constexpr double kSteepest = 0.6;

// Along faces shares are lowered by steps of this at least, so that it ends.
constexpr double kLeastStep = 1e-4;

class Slopes {
 public:
  Slopes(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares,
         const std::vector<char>& asked)
      : surface_(surface),
        rig_(rig),
        shares_(shares),
        asked_(asked),
        steep_(rig.joints.size()),
        lowered_(surface.vertex_count(), kUnchanged),
        bluntness_(surface.face_count(), kUnknown) {
    for (const RigJoint& joint : rig.joints) at_.push_back(surface.frame.to_normalised(joint.position));
    const std::size_t count = rig.joints.size();
    hangs_on_.assign(count, std::vector<char>(count, 0));
    for (std::size_t j = 0; j < count; ++j)
      for (Index up = rig.joints[j].parent; up != kNone; up = rig.joints[up].parent) hangs_on_[up][j] = 1;
  }

  std::vector<LowerShare> run() {
    for (Index f = 0; f < surface_.face_count(); ++f) {
      const auto at = [&](Index k) { return shares_[surface_.origin[3 * f + k]]; };
      if (at(0) == at(1) && at(1) == at(2)) continue;
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        if (!(shares_[surface_.origin[h]] == shares_[surface_.target(h)])) note(h);
        if (is_blunt(h)) note_face(h);
      }
    }
    for (Index j = 1; j < static_cast<Index>(steep_.size()); ++j)
      if (!steep_[j].empty()) lower(j);
    return by_vertex();
  }

 private:
  static constexpr double kUnchanged = 2;
  enum : char { kUnknown, kSharp, kBlunt };

  // They were found joint by joint.
  std::vector<LowerShare> by_vertex() const {
    std::vector<std::size_t> place(surface_.vertex_count() + 1, 0);
    for (const LowerShare& lower : found_) ++place[lower.vertex + 1];
    for (std::size_t v = 1; v < place.size(); ++v) place[v] += place[v - 1];
    std::vector<LowerShare> sorted(found_.size());
    for (const LowerShare& lower : found_) sorted[place[lower.vertex]++] = lower;
    return sorted;
  }
  double most_change(Index h, Index joint) const {
    const Vector3 &a = surface_.position[surface_.origin[h]], &b = surface_.position[surface_.target(h)];
    const double length = (b - a).norm(), far = (0.5 * (a + b) - at_[joint]).norm();
    return kSteepest * length / std::max(far, 0.5 * length);
  }
  double share(Index v, Index joint) const {
    const BoneShare& s = shares_[v];
    if (s.joint == joint) return s.share;
    return hangs_on_[joint][s.joint];
  }
  // Whether the face is wider than a right angle opposite the half-edge. In others no slope is more than 1.41
  // times those of the edges.
  bool is_blunt(Index h) const {
    const Vector3& x = surface_.position[surface_.apex(h)];
    return (surface_.position[surface_.origin[h]] - x).dot(surface_.position[surface_.target(h)] - x) < 0;
  }
  bool is_blunt_face(Index f) {
    if (bluntness_[f] == kUnknown)
      bluntness_[f] = is_blunt(3 * f) || is_blunt(3 * f + 1) || is_blunt(3 * f + 2) ? kBlunt : kSharp;
    return bluntness_[f] == kBlunt;
  }
  // What the share at the apex may be at most, so that it changes over the face by no more than the steepest
  // slope, where the edge's ends have `a` and `b`.
  double most_at_apex(Index h, Index joint, double a, double b) const {
    const Vector3 &p = surface_.position[surface_.origin[h]], &q = surface_.position[surface_.target(h)],
                  &x = surface_.position[surface_.apex(h)];
    const double length = (q - p).norm(), far = ((p + q + x) / 3 - at_[joint]).norm();
    if (!(length > 0)) return kUnchanged;
    const double steepest = kSteepest / std::max(far, 0.5 * length), along = (b - a) / length;
    if (std::abs(along) >= steepest) return kUnchanged;
    const double foot = (x - p).dot(q - p) / length;
    const double height = std::sqrt(std::max(0.0, (x - p).squaredNorm() - foot * foot));
    return std::max(0.0, a + along * foot + std::sqrt(steepest * steepest - along * along) * height);
  }
  // Keeps the edges of the face, whose widest angle is opposite the half-edge, with each joint whose share
  // rises over it by too much.
  void note_face(Index h) {
    const std::array<Index, 3> corner{surface_.origin[h], surface_.target(h), surface_.apex(h)};
    for (const Index v : corner)
      for (Index j = shares_[v].joint; j > 0; j = rig_.joints[j].parent) {
        if (!asked_[j]) continue;
        std::array<double, 3> has{};
        for (int k = 0; k < 3; ++k) has[k] = share(corner[k], j);
        if (has[0] == has[1] && has[1] == has[2]) break;
        for (Index k = 0, side = h; k < 3; ++k, side = SurfaceSnapshot::next(side))
          if (has[(k + 2) % 3] > most_at_apex(side, j, has[k], has[(k + 1) % 3]) + kLeastStep) {
            steep_[j].push_back(side);
            steep_[j].push_back(SurfaceSnapshot::next(side));
          }
      }
  }
  // Keeps the half-edge with each joint whose share rises along it by too much.
  void note(Index h) {
    const BoneShare &low = shares_[surface_.origin[h]], &high = shares_[surface_.target(h)];
    for (Index j = high.joint; j > 0; j = rig_.joints[j].parent) {
      const double rise = (j == high.joint ? high.share : 1.0) - share(surface_.origin[h], j);
      if (asked_[j] && rise > 0 && rise > most_change(h, j)) steep_[j].push_back(h);
      if (j == low.joint) return;
    }
  }
  // From the feet of what is too steep, the lowest first.
  void lower(Index joint) {
    using Item = std::pair<double, Index>;
    std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
    const auto present = [&](Index v) { return std::min(lowered_[v], share(v, joint)); };
    const auto lower_to = [&](Index w, double most) {
      if (lowered_[w] == kUnchanged) touched_.push_back(w);
      lowered_[w] = most;
      queue.push({most, w});
    };
    const auto along_edge = [&](Index h, double here) {
      const Index w = surface_.target(h);
      const double there = present(w);
      if (there <= here) return;
      if (const double most = here + most_change(h, joint); most < there) lower_to(w, most);
    };
    const auto over_face = [&](Index h, double here) {
      const Index w = surface_.apex(h);
      const double there = present(w);
      if (there <= here) return;
      const double most = most_at_apex(h, joint, present(surface_.origin[h]), present(surface_.target(h)));
      if (most < there - kLeastStep) lower_to(w, most);
    };
    const auto over_blunt_face = [&](Index h, double here) {
      if (!is_blunt_face(h / 3)) return;
      over_face(h, here);
      over_face(SurfaceSnapshot::prev(h), here);
    };
    for (const Index h : steep_[joint]) {
      const double here = present(surface_.origin[h]);
      along_edge(h, here);
      over_blunt_face(h, here);
    }
    while (!queue.empty()) {
      const auto [here, v] = queue.top();
      queue.pop();
      if (here > lowered_[v]) continue;
      Index h = surface_.vertex_halfedge[v];
      const Index first = h;
      do {
        along_edge(h, here);
        over_blunt_face(h, here);
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
  const std::vector<char>& asked_;
  std::vector<std::vector<char>> hangs_on_;  // per joint, for each: whether it is below
  std::vector<Vector3> at_;                // per joint, in the surface's frame
  std::vector<std::vector<Index>> steep_;  // per joint: half-edges, from low to high
  std::vector<double> lowered_;            // per vertex: of the present joint
  std::vector<char> bluntness_;            // per face
  std::vector<Index> touched_;
  std::vector<LowerShare> found_;
};

}  // namespace

std::vector<LowerShare> bound_slopes(const SurfaceSnapshot& surface, const Rig& rig,
                                     const std::vector<BoneShare>& shares, const std::vector<char>& asked) {
  return Slopes(surface, rig, shares, asked).run();
}

}  // namespace mspskel::detail
