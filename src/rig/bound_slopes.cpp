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

// Over faces weights are lowered by steps of this at least, so that it ends.
constexpr double kLeastStep = 1e-4;

class Slopes {
 public:
  // Only of the joints for which `asked` is not 0.
  Slopes(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares,
         std::vector<char> asked)
      : surface_(surface),
        rig_(rig),
        shares_(shares),
        asked_(std::move(asked)),
        steep_(rig.joints.size()),
        steep_faces_(rig.joints.size()),
        lowered_(surface.vertex_count(), kUnchanged),
        blunt_(surface.face_count(), kUnknown) {
    for (const RigJoint& joint : rig.joints) at_.push_back(surface.frame.to_normalised(joint.position));
    const std::size_t count = rig.joints.size();
    hangs_on_.assign(count, std::vector<char>(count, 0));
    for (std::size_t j = 0; j < count; ++j)
      for (Index up = rig.joints[j].parent; up != kNone; up = rig.joints[up].parent) hangs_on_[up][j] = 1;
  }

  std::vector<LowerShare> lower_all() {
    note_steep();
    const Index count = static_cast<Index>(steep_.size());
    std::vector<std::size_t> begin(count, 0), end(count, 0);
    for (Index j = 1; j < count; ++j) {
      begin[j] = found_.size();
      const Index above = rig_.joints[j].parent;
      lower(j, begin[above], end[above], 1.0);
      end[j] = found_.size();
    }
    return by_vertex();
  }

  std::vector<Index> find_idle(const std::vector<Index>& joints) {
    note_steep();
    std::vector<Index> following(steep_.size(), 0);
    for (const BoneShare& share : shares_)
      for (Index j = share.joint; j != kNone; j = rig_.joints[j].parent)
        if (asked_[j] && (j != share.joint || share.share >= kHalf)) ++following[j];
    std::vector<Index> idle;
    for (const Index j : joints) {
      found_.clear();
      lower(j, 0, 0, kHalf);
      for (const LowerShare& lower : found_)
        if (lower.share < kHalf && share(lower.vertex, j) >= kHalf) --following[j];
      if (following[j] == 0) idle.push_back(j);
    }
    return idle;
  }

 private:
  static constexpr double kUnchanged = 2, kHalf = 0.5;
  static constexpr Index kUnknown = kNone - 1;

  // Where shares change by too much, per joint.
  void note_steep() {
    for (Index f = 0; f < surface_.face_count(); ++f) {
      const auto at = [&](Index k) { return shares_[surface_.origin[3 * f + k]]; };
      if (at(0) == at(1) && at(1) == at(2)) continue;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (!(shares_[surface_.origin[h]] == shares_[surface_.target(h)])) note(h);
      if (const Index h = blunt_halfedge(f); h != kNone) note_face(h);
    }
  }
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
  // The half-edge opposite the face's wide angle; kNone: there is none.
  Index blunt_halfedge(Index f) {
    if (blunt_[f] == kUnknown) {
      blunt_[f] = kNone;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (is_blunt(h)) blunt_[f] = h;
    }
    return blunt_[f];
  }
  // At the foot of the wide corner on the edge opposite, which lies between the edge's ends.
  struct Foot {
    double along = 0;  // share of the way from the half-edge's origin to its target
    double most = 0;   // by which weights may differ between foot and corner
    double between(double from, double to) const { return (1 - along) * from + along * to; }
  };
  Foot foot_of(Index h, Index joint) const {
    const Vector3 &p = surface_.position[surface_.origin[h]], &q = surface_.position[surface_.target(h)],
                  &x = surface_.position[surface_.apex(h)];
    const double length = (q - p).norm(), far = ((p + q + x) / 3 - at_[joint]).norm();
    const double along = (x - p).dot(q - p) / (length * length);
    return {along, 1.5 * kSteepest * (p + along * (q - p) - x).norm() / std::max(far, 0.5 * length)};
  }
  // Keeps the face, whose wide angle is opposite the half-edge, with each joint whose share changes over it
  // by too much.
  void note_face(Index h) {
    const std::array<Index, 3> corner{surface_.origin[h], surface_.target(h), surface_.apex(h)};
    for (const Index v : corner)
      for (Index j = shares_[v].joint; j > 0; j = rig_.joints[j].parent) {
        if (!asked_[j]) continue;
        std::array<double, 3> has{};
        for (int k = 0; k < 3; ++k) has[k] = share(corner[k], j);
        if (has[0] == has[1] && has[1] == has[2]) break;
        const Foot foot = foot_of(h, j);
        if (std::abs(foot.between(smooth_share(has[0]), smooth_share(has[1])) - smooth_share(has[2])) >
            foot.most + kLeastStep)
          steep_faces_[j].push_back(h);
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
  // From the feet of what is too steep, the lowest first, as far as shares are below `until`. A vertex
  // follows no joint more than the one that it hangs on, whose lower shares are found_[begin] to found_[end -
  // 1].
  void lower(Index joint, std::size_t begin, std::size_t end, double until) {
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
    // What weighs too much over a face with a wide corner is lowered: the corner to what the edge opposite
    // has at its foot, or the edge's ends to what makes the foot fit the corner, the higher end first.
    const auto over_face = [&](Index h) {
      if (h == kNone) return;
      const Index from = surface_.origin[h], to = surface_.target(h), corner = surface_.apex(h);
      const double p = smooth_share(present(from)), q = smooth_share(present(to)),
                   x = smooth_share(present(corner));
      if (p == x && q == x) return;
      const Foot foot = foot_of(h, joint);
      const double at_foot = foot.between(p, q), high = x + foot.most;
      if (x > at_foot + foot.most + kLeastStep) lower_to(corner, share_of_weight(at_foot + foot.most));
      if (at_foot <= high + kLeastStep) return;
      const double t = foot.along;
      if (p > high) lower_to(from, share_of_weight(q >= high ? high : (high - t * q) / (1 - t)));
      if (q > high) lower_to(to, share_of_weight(p >= high ? high : (high - (1 - t) * p) / t));
    };
    for (std::size_t i = begin; i < end; ++i)
      if (share(found_[i].vertex, joint) > found_[i].share) lower_to(found_[i].vertex, found_[i].share);
    for (const Index h : steep_[joint]) along_edge(h, present(surface_.origin[h]));
    for (const Index h : steep_faces_[joint]) over_face(h);
    while (!queue.empty()) {
      const auto [here, v] = queue.top();
      queue.pop();
      if (here >= until) break;
      if (here > lowered_[v]) continue;
      Index h = surface_.vertex_halfedge[v];
      const Index first = h;
      do {
        along_edge(h, here);
        over_face(blunt_halfedge(h / 3));
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
  const std::vector<char> asked_;
  std::vector<std::vector<char>> hangs_on_;      // per joint, for each: whether it is below
  std::vector<Vector3> at_;                      // per joint, in the surface's frame
  std::vector<std::vector<Index>> steep_;        // per joint: half-edges, from low to high
  std::vector<std::vector<Index>> steep_faces_;  // per joint: half-edges opposite wide angles
  std::vector<double> lowered_;                  // per vertex: of the present joint
  std::vector<Index> blunt_;                     // per face: see blunt_halfedge; kUnknown: not asked yet
  std::vector<Index> touched_;
  std::vector<LowerShare> found_;
};

}  // namespace

std::vector<LowerShare> bound_slopes(const SurfaceSnapshot& surface, const Rig& rig,
                                     const std::vector<BoneShare>& shares) {
  return Slopes(surface, rig, shares, std::vector<char>(rig.joints.size(), 1)).lower_all();
}

std::vector<Index> find_idle(const SurfaceSnapshot& surface, const Rig& rig,
                             const std::vector<BoneShare>& shares, const std::vector<Index>& joints) {
  std::vector<char> asked(rig.joints.size(), 0);
  for (const Index j : joints) asked[j] = 1;
  return Slopes(surface, rig, shares, std::move(asked)).find_idle(joints);
}

}  // namespace mspskel::detail
