#include "share_spread.h"

#include <algorithm>
#include <cmath>

namespace mspskel::detail {
namespace {

// Of 1 / r. Turned by 45 degrees, what is r away moves by 0.77 r, and weights are 1.5 times as steep as
// shares where they are steepest; 0.87 would turn over a face that lies along the slope.
constexpr double kSteepest = 0.6;

}  // namespace

ShareSpread::ShareSpread(const SurfaceSnapshot& surface, const Rig& rig, const std::vector<BoneShare>& shares)
    : surface_(surface),
      ways_(rig, shares),
      steep_(rig.joints.size()),
      most_(rig.joints.size()),
      is_halved_(surface.vertex_count(), 0),
      changed_(rig.joints.size()),
      here_(surface.vertex_count()),
      longest_square_(surface.vertex_count(), -1.0),
      queue_(kStretches) {
  for (const RigJoint& joint : rig.joints) at_.push_back(surface.frame.to_normalised(joint.position));
}

// Steps are inline, since most are small and called for each edge.

inline bool ShareSpread::is_even(Index f) const {
  const BoneShare& first = ways_.of_map(surface_.origin[3 * f]);
  return first == ways_.of_map(surface_.origin[3 * f + 1]) &&
         first == ways_.of_map(surface_.origin[3 * f + 2]);
}

inline double ShareSpread::most_change(Index h, Index joint) const {
  const Vector3 &a = surface_.position[surface_.origin[h]], &b = surface_.position[surface_.target(h)];
  const double square = (b - a).squaredNorm(), far = (0.5 * (a + b) - at_[joint]).squaredNorm();
  return kSteepest * std::sqrt(square / std::max(far, 0.25 * square));
}

inline void ShareSpread::note_if_steep(Index h, const std::vector<char>& joints) {
  const Index v = surface_.origin[h], w = surface_.target(h);
  const BoneShare &low = ways_.of_map(v), &high = ways_.of_map(w);
  if (low == high) return;
  for (Index j = high.joint; j > 0; j = ways_.above(j)) {
    if (joints[j]) {
      const double rise = (j == high.joint ? high.share : 1.0) - ways_.at(v, j);
      if (rise > 0 && rise > most_change(h, j)) steep_[j].push_back(h);
    }
    if (j == low.joint) break;
  }
}

inline void ShareSpread::begin_spread(Index joint) {
  joint_ = joint;
  changed_[joint].clear();
  ++spread_;
}

// Whether the joint allows each edge at v what the one above allows it, being nearer to the edge's middle.
inline bool ShareSpread::is_flat_as_above(Index v, const Here& here) {
  if (is_halved_[v]) return false;
  const Vector3 &up = at_[ways_.above(joint_)], bone = at_[joint_] - up;
  const double nearer = (surface_.position[v] - up).squaredNorm() - here.square_far;
  return nearer >= 0 && nearer * nearer >= bone.squaredNorm() * longest_square(v);
}

// Of the edges at a vertex.
inline double ShareSpread::longest_square(Index v) {
  double& longest = longest_square_[v];
  if (longest < 0) {
    longest = 0;
    for_each_neighbour(surface_, v, [&](Index w) {
      longest = std::max(longest, (surface_.position[w] - surface_.position[v]).squaredNorm());
    });
  }
  return longest;
}

inline ShareSpread::Here& ShareSpread::look_up(Index v) {
  Here& here = here_[v];
  if (here.spread != spread_)
    here = {spread_, false, ways_.at(v, joint_), (surface_.position[v] - at_[joint_]).squaredNorm()};
  return here;
}

inline void ShareSpread::lower(Index v, Here& here, double share) {
  here.share = share;
  note_changed(v, here);
  spread_from(v, share);
}

inline void ShareSpread::note_changed(Index v, Here& here) {
  if (!here.is_lowered) changed_[joint_].push_back(v);
  here.is_lowered = true;
}

inline void ShareSpread::spread_from(Index v, double share) {
  const std::size_t stretch = std::min(static_cast<std::size_t>(share * kStretches), kStretches - 1);
  first_queued_ = std::min(first_queued_, stretch);
  queue_[stretch].push_back({share, v});
}

inline void ShareSpread::along_edge(Index h, const Here& here) {
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

// A vertex follows no joint more than the one that it hangs on. Then from what is queued, low shares first.
inline void ShareSpread::spread_below() {
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
  // What an item lowers is in its stretch or a later one.
  for (; first_queued_ < kStretches; ++first_queued_) {
    const std::vector<Item>& items = queue_[first_queued_];
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto [share, v] = items[i];
      const Here& here = look_up(v);
      if (share > here.share) continue;
      Index h = surface_.vertex_halfedge[v];
      const Index first = h;
      do {
        along_edge(h, here);
        h = surface_.next_outgoing(h);
      } while (h != first);
    }
    queue_[first_queued_].clear();
  }
  for (const Index v : changed_[joint_])
    if (here_[v].share < ways_.at(v, joint_)) ways_.lower(v, joint_, here_[v].share);
}

void ShareSpread::note_steep(const std::vector<char>& joints) {
  for (std::vector<Index>& edges : steep_) edges.clear();
  for (Index f = 0; f < surface_.face_count(); ++f)
    if (!is_even(f))
      for (Index h = 3 * f; h < 3 * f + 3; ++h) note_if_steep(h, joints);
}

void ShareSpread::lower_along_edges(Index joint) {
  begin_spread(joint);
  for (const Index h : steep_[joint]) along_edge(h, look_up(surface_.origin[h]));
  spread_below();
}

void ShareSpread::lower_again(Index joint, const std::vector<Index>& lowered,
                              const std::vector<Index>& halved) {
  begin_spread(joint);
  for (const Index v : lowered) {
    note_changed(v, look_up(v));
    spread_from(v, look_up(v).share);
  }
  for (const Index v : halved) spread_from(v, look_up(v).share);
  spread_below();
}

void ShareSpread::keep_change(Index h, Index joint, double most) {
  const auto kept = most_[joint].insert({edge(h), most}).first;
  kept->second = std::min(kept->second, most);
  is_halved_[surface_.origin[h]] = is_halved_[surface_.target(h)] = 1;
}

}  // namespace mspskel::detail
