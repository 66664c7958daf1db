#include "name_joints.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mspskel::detail {
namespace {

// Twins may be so far from each other's mirror image, as a share of the model's extent.
constexpr double kMirrorError = 0.1;

struct MirrorPlane {
  Vector3 point, normal;
  Vector3 mirrored(const Vector3& x) const { return x - 2 * (x - point).dot(normal) * normal; }
};

class JointNames {
 public:
  JointNames(Rig& rig, double extent) : joints_(rig.joints), error_(kMirrorError * extent) {
    children_.resize(joints_.size());
    for (Index j = 1; j < size(); ++j) children_[joints_[j].parent].push_back(j);
  }

  void run() {
    find_chains();
    if (const auto plane = best_plane()) pair_chains(*plane);
    name_chains();
  }

 private:
  // Joints below a junction up to the next one or to an end.
  struct Chain {
    std::vector<Index> joints;
    bool is_limb = false;
    Index twin = kNone;
    bool left = false;
  };

  Index size() const { return static_cast<Index>(joints_.size()); }
  const Vector3& tip(const Chain& chain) const { return joints_[chain.joints.back()].position; }

  void find_chains() {
    for (Index j = 1; j < size(); ++j) {
      const Index above = joints_[j].parent;
      if (above != 0 && children_[above].size() == 1) continue;
      Chain chain{{j}};
      while (children_[chain.joints.back()].size() == 1)
        chain.joints.push_back(children_[chain.joints.back()][0]);
      chain.is_limb = children_[chain.joints.back()].empty();
      chains_.push_back(std::move(chain));
    }
  }

  // The other chain whose end is nearest to the mirror image of this one's; itself where it lies on the
  // plane.
  Index image_of(Index c, const MirrorPlane& plane) const {
    const Vector3 image = plane.mirrored(tip(chains_[c]));
    double least = error_;
    Index found = kNone;
    for (Index d = 0; d < static_cast<Index>(chains_.size()); ++d) {
      if (chains_[d].is_limb != chains_[c].is_limb) continue;
      const double off = (tip(chains_[d]) - image).norm();
      if (off >= least) continue;
      least = off;
      found = d;
    }
    return found;
  }
  // Between the ends of two limbs; the one that mirrors the most limbs onto limbs, three in four at least.
  std::optional<MirrorPlane> best_plane() const {
    Index limbs = 0, most = 0;
    for (const Chain& chain : chains_) limbs += chain.is_limb ? 1 : 0;
    std::optional<MirrorPlane> best;
    for (std::size_t a = 0; a < chains_.size(); ++a)
      for (std::size_t b = a + 1; b < chains_.size(); ++b) {
        const Vector3 across = tip(chains_[b]) - tip(chains_[a]);
        if (!chains_[a].is_limb || !chains_[b].is_limb || across.norm() < 2 * error_) continue;
        const MirrorPlane plane{0.5 * (tip(chains_[a]) + tip(chains_[b])), across.normalized()};
        if (std::abs((joints_[0].position - plane.point).dot(plane.normal)) > error_) continue;
        Index matched = 0;
        for (Index c = 0; c < static_cast<Index>(chains_.size()); ++c)
          matched += chains_[c].is_limb && image_of(c, plane) != kNone ? 1 : 0;
        if (matched <= most || 4 * matched < 3 * limbs) continue;
        most = matched;
        best = plane;
      }
    return best;
  }
  void pair_chains(const MirrorPlane& plane) {
    // Left is where the normal's largest coordinate is positive: +x of a character that looks along +z.
    Eigen::Index axis = 0;
    plane.normal.cwiseAbs().maxCoeff(&axis);
    const double sign = plane.normal[axis] > 0 ? 1.0 : -1.0;
    for (Index c = 0; c < static_cast<Index>(chains_.size()); ++c) {
      const Index d = image_of(c, plane);
      if (d == kNone || d <= c || image_of(d, plane) != c) continue;
      chains_[c].twin = d;
      chains_[d].twin = c;
      const double side = sign * (tip(chains_[c]) - plane.point).dot(plane.normal);
      chains_[c].left = side > 0;
      chains_[d].left = side <= 0;
      const std::size_t pairs = std::min(chains_[c].joints.size(), chains_[d].joints.size());
      for (std::size_t i = 0; i < pairs; ++i) {
        joints_[chains_[c].joints[i]].twin = chains_[d].joints[i];
        joints_[chains_[d].joints[i]].twin = chains_[c].joints[i];
      }
    }
  }
  void name_chains() {
    joints_[0].name = "root";
    Index limbs = 0, bodies = 0;
    std::vector<std::string> name(chains_.size());
    for (Index c = 0; c < static_cast<Index>(chains_.size()); ++c) {
      const Chain& chain = chains_[c];
      const bool second = chain.twin != kNone && chain.twin < c;
      name[c] = second          ? name[chain.twin]
                : chain.is_limb ? "limb" + std::to_string(++limbs)
                                : "body" + std::to_string(++bodies);
      const std::string side = chain.twin == kNone ? "" : chain.left ? "_L" : "_R";
      for (std::size_t i = 0; i < chain.joints.size(); ++i)
        joints_[chain.joints[i]].name = name[c] + "_" + std::to_string(i + 1) + side;
    }
  }

  std::vector<RigJoint>& joints_;
  double error_;
  std::vector<std::vector<Index>> children_;
  std::vector<Chain> chains_;
};

}  // namespace

void name_joints(Rig& rig, double extent) { JointNames(rig, extent).run(); }

}  // namespace mspskel::detail
