// Where a tube was cut off: the flat caps of vessels, necks and rods, however short what they end is.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/sharp_turn.h"
#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

struct FlatEnd {
  LimbTip tip;  // in the cap's middle, a little inside; its cap is ascending and has the rim
  Vector3 normal = Vector3::Zero();
};

// A cap is flat, the surface turns off sharply all round it, and the wall beyond its rim runs along its
// normal, as below a tube's opening in a mesh that is not closed. A face of a block is none: others beside it
// are flat, about as wide as long and end sharply all round, too. What is rounder than a square has no such
// faces beside it.
class FlatEndSearch {
 public:
  FlatEndSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                const ProgressCallback& progress)
      : surface_(surface),
        solid_(solid),
        half_area_(half_areas_of_components(surface)),
        tried_(static_cast<std::size_t>(surface.face_count()), false),
        in_cap_(tried_.size(), false),
        reached_(tried_.size(), 0),
        watch_(progress, "arcs") {
    for (Index f = 0; f < surface.face_count(); ++f)
      normal_.push_back(surface.face_normal_times_twice_area(f).normalized());
  }

  // Throws Cancelled. Cost: O(faces); nothing but the normals where no edge is sharp.
  std::vector<FlatEnd> run() {
    std::vector<Cap> caps;
    for (Index h = 0; h < surface_.halfedge_count(); ++h) {
      const Index f = SurfaceSnapshot::face(h);
      if (tried_[f] || !turns_off(h, normal_[f])) continue;
      if (std::optional<Cap> cap = cap_beside(f)) caps.push_back(std::move(*cap));
    }
    std::vector<FlatEnd> ends;
    for (const Cap& cap : caps)
      if (!is_face_of_block(cap) && ends_tube(cap)) ends.push_back(end_at(cap));
    return ends;
  }

 private:
  struct Rim {
    std::vector<Index> halfedges;  // of the cap's faces
    Vector3 centre = Vector3::Zero();
    double length = 0;
  };

  struct Cap {
    std::vector<Index> faces;
    Rim rim;
    Vector3 normal = Vector3::Zero();
    double area = 0, radius = 0;
    double roundness = 0;  // 1 for a circle, 0.785 for a square, 0.33 for a ring of twice the hole's width
  };

  // The faces that hang together with one and lie about across an axis.
  std::vector<Index> faces_across(const Vector3& axis, Index first) {
    constexpr double kAlong = 0.7071;
    return connected({first}, [&](Index f) { return normal_[f].dot(axis) >= kAlong; });
  }

  // Those that `belongs` holds for and that hang together with some faces, and these.
  template <class Belongs>
  std::vector<Index> connected(std::vector<Index> faces, const Belongs& belongs) {
    ++round_;
    for (const Index f : faces) reached_[f] = round_;
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (Index h = 3 * faces[i]; h < 3 * faces[i] + 3; ++h) {
        watch_.step();
        const Index f = SurfaceSnapshot::face(surface_.twin[h]);
        if (reached_[f] == round_ || !belongs(f)) continue;
        reached_[f] = round_;
        faces.push_back(f);
      }
    return faces;
  }

  // A noisy surface's first face may lie aslant, so the cap grows twice, the second time across its own mean
  // normal.
  std::optional<Cap> cap_beside(Index first) {
    constexpr std::size_t kLeastRim = 4;  // edges
    Cap cap;
    cap.faces = faces_across(normal_[first], first);
    tried_[first] = true;
    const Vector3 axis = area_vector(cap.faces).normalized();
    cap.faces = faces_across(axis, first);
    for (const Index f : cap.faces) tried_[f] = true;
    cap.rim = rim_of(cap.faces, axis);
    const Vector3 area = area_vector(cap.faces);
    cap.area = area.norm();
    if (cap.rim.halfedges.size() < kLeastRim || !(cap.area > 0)) return std::nullopt;
    cap.normal = area.normalized();
    cap.radius = 2 * cap.area / cap.rim.length;
    cap.roundness = 4 * kPi * cap.area / (cap.rim.length * cap.rim.length);
    if (!is_flat(cap)) return std::nullopt;
    if (cap.roundness >= kSlim)
      for (const Index f : cap.faces) in_cap_[f] = true;
    return cap;
  }

  // A cap is as wide as long, about, and no top of noise.
  bool is_face_of_block(const Cap& cap) const {
    constexpr double kRounder = 0.82;
    constexpr std::size_t kLeastRim = 8;  // edges: with fewer the tops of noise look round
    constexpr double kLeastShare =
        0.005;  // of the component's area: what is thinner and a limb is told as one
    const Index component = surface_.component[surface_.origin[3 * cap.faces.front()]];
    if (cap.area < kLeastShare * 2 * half_area_[component]) return true;
    if (cap.roundness >= kRounder) return cap.rim.halfedges.size() < kLeastRim;
    return cap.roundness < kSlim ||
           std::any_of(cap.rim.halfedges.begin(), cap.rim.halfedges.end(),
                       [&](Index h) { return in_cap_[SurfaceSnapshot::face(surface_.twin[h])]; });
  }

  // The sum over faces, not twice it.
  Vector3 area_vector(const std::vector<Index>& faces) const {
    Vector3 sum = Vector3::Zero();
    for (const Index f : faces) sum += surface_.face_area(f) * normal_[f];
    return sum;
  }

  // Whether the surface turns off sharply, and outward, across a half-edge of a face that lies across an
  // axis.
  bool turns_off(Index h, const Vector3& axis) const {
    return sharp_turn(surface_, h, axis, normal_[SurfaceSnapshot::face(surface_.twin[h])]) > 0;
  }

  bool leads_out(Index h) const { return reached_[SurfaceSnapshot::face(surface_.twin[h])] != round_; }

  // The longest loop round faces that have just been reached: others go round slivers that lie aslant among
  // them. Empty where a good part of it is not sharp.
  Rim rim_of(const std::vector<Index>& faces, const Vector3& axis) const {
    constexpr double kMostSmooth = 0.2;
    std::unordered_set<Index> walked;
    Rim longest;
    for (const Index f : faces)
      for (Index first = 3 * f; first < 3 * f + 3; ++first) {
        if (!leads_out(first) || !walked.insert(first).second) continue;
        Rim rim;
        double smooth = 0;
        for (Index h = first;;) {
          const double length = surface_.edge_length(h);
          rim.halfedges.push_back(h);
          rim.length += length;
          rim.centre +=
              0.5 * length * (surface_.position[surface_.origin[h]] + surface_.position[surface_.target(h)]);
          if (!turns_off(h, axis)) smooth += length;
          for (h = SurfaceSnapshot::next(h); !leads_out(h);) h = SurfaceSnapshot::next(surface_.twin[h]);
          if (h == first) break;
          walked.insert(h);
        }
        if (rim.length <= longest.length) continue;
        longest = std::move(rim);
        if (smooth > kMostSmooth * longest.length) longest.halfedges.clear();
      }
    if (longest.halfedges.empty()) return {};
    longest.centre /= longest.length;
    return longest;
  }

  // Whether the faces lie in a plane but for a tenth of the radius, in the square mean.
  bool is_flat(const Cap& cap) const {
    constexpr double kUneven = 0.1;
    double area = 0, first = 0, second = 0;
    for (const Index f : cap.faces) {
      const double own = surface_.face_area(f);
      const double height =
          (surface_.face_centroid(f) - surface_.face_centroid(cap.faces.front())).dot(cap.normal);
      area += own;
      first += own * height;
      second += own * height * height;
    }
    return second * area - first * first <= std::pow(kUneven * cap.radius * area, 2);
  }

  // Whether a tube ends in the cap: it is as deep as wide by half there, and the wall within half a radius of
  // the rim runs along the normal; by the mean square of the cosine, as a cone does whose side is 30 degrees
  // from its axis.
  bool ends_tube(const Cap& cap) {
    constexpr double kMostAcross = 0.25;
    const Vector3& centre = cap.rim.centre;
    const Vector3 start = centre - kAhead * cap.radius * cap.normal;
    if (!solid_.inside(start) || solid_.first_hit(start, -cap.normal, (1 - kAhead) * cap.radius))
      return false;
    double reach = 0;
    for (const Index h : cap.rim.halfedges)
      reach = std::max(reach, (surface_.position[surface_.origin[h]] - centre).norm());
    reach += 0.5 * cap.radius;
    const std::vector<Index> all =
        connected(cap.faces, [&](Index f) { return (surface_.face_centroid(f) - centre).norm() <= reach; });
    double area = 0, across = 0;
    for (std::size_t i = cap.faces.size(); i < all.size(); ++i) {
      const double own = surface_.face_area(all[i]);
      area += own;
      across += own * std::pow(normal_[all[i]].dot(cap.normal), 2);
    }
    return across <= kMostAcross * area;
  }

  FlatEnd end_at(const Cap& cap) const {
    FlatEnd flat{{}, cap.normal};
    LimbTip& end = flat.tip;
    end.kind = TipKind::kFlatEnd;
    end.target = cap.rim.centre - kAhead * cap.radius * cap.normal;
    end.measures.depth = cap.radius;
    end.measures.half_width = 0.25 * cap.radius;  // as that of a body's end: the arc is to end in the middle
    end.cap = vertices_of(surface_, cap.faces);
    const auto away = [&](Index v) { return (surface_.position[v] - cap.rim.centre).squaredNorm(); };
    end.vertex = *std::min_element(end.cap.begin(), end.cap.end(),
                                   [&](Index v, Index w) { return away(v) < away(w); });
    return flat;
  }

  static constexpr double kSlim = 0.6;   // roundness of a rectangle 2.5 times as long as wide, or of an L
  static constexpr double kAhead = 0.1;  // radii before the surface

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  std::vector<double> half_area_;  // of each component
  std::vector<Vector3> normal_;    // of each face
  std::vector<bool> tried_;
  std::vector<bool> in_cap_;    // of caps that are not slim, be they ends or not
  std::vector<Index> reached_;  // the last round that came by
  Index round_ = 0;
  Watch watch_;
};

}  // namespace detail
}  // namespace mspskel
