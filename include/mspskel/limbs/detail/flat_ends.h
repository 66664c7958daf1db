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
#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

struct FlatEnd {
  LimbTip tip;  // in the cap's middle, a little inside; its cap is ascending and has the rim
  Vector3 normal = Vector3::Zero();
};

// A cap is flat and round, the surface turns off sharply all round it, and the wall beyond its rim runs along
// its normal, as below a tube's opening in a mesh that is not closed. A face of a block is no cap: it is no
// rounder than a square.
class FlatEndSearch {
 public:
  FlatEndSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                const ProgressCallback& progress)
      : surface_(surface),
        solid_(solid),
        half_area_(half_areas_of_components(surface)),
        tried_(static_cast<std::size_t>(surface.face_count()), false),
        reached_(tried_.size(), 0),
        watch_(progress, "arcs") {
    for (Index f = 0; f < surface.face_count(); ++f)
      normal_.push_back(surface.face_normal_times_twice_area(f).normalized());
  }

  // Throws Cancelled. Cost: O(faces); nothing but the normals where no edge is sharp.
  std::vector<FlatEnd> run() {
    std::vector<FlatEnd> ends;
    for (Index h = 0; h < surface_.halfedge_count(); ++h) {
      const Index f = SurfaceSnapshot::face(h);
      if (tried_[f] || !is_sharp_outward(h)) continue;
      if (std::optional<FlatEnd> end = end_beside(f)) ends.push_back(std::move(*end));
    }
    return ends;
  }

 private:
  struct Rim {
    std::vector<Index> halfedges;  // of the cap's faces
    Vector3 centre = Vector3::Zero();
    double length = 0;
  };

  bool is_sharp_outward(Index h) const {
    const Vector3 &a = normal_[SurfaceSnapshot::face(h)],
                  &b = normal_[SurfaceSnapshot::face(surface_.twin[h])];
    const Vector3 along = surface_.position[surface_.target(h)] - surface_.position[surface_.origin[h]];
    return a.dot(b) < kSharp && a.cross(b).dot(along) > 0;
  }

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
  std::optional<FlatEnd> end_beside(Index first) {
    constexpr std::size_t kLeastRim = 8;  // edges: with fewer the tops of noise look round
    constexpr double kLeastShare =
        0.005;  // of the component's area: what is thinner and a limb is told as one
    std::vector<Index> faces = faces_across(normal_[first], first);
    tried_[first] = true;
    const Vector3 axis = area_vector(faces).normalized();
    faces = faces_across(axis, first);
    for (const Index f : faces) tried_[f] = true;
    const Rim rim = rim_of(faces, axis);
    const Vector3 area = area_vector(faces);
    const double radius = rim.length > 0 ? 2 * area.norm() / rim.length : 0.0;
    if (!(radius > 0) || rim.halfedges.size() < kLeastRim ||
        area.norm() < kLeastShare * 2 * half_area_[surface_.component[surface_.origin[3 * first]]] ||
        !is_round(area.norm(), rim.length) || !is_flat(faces, area.normalized(), radius))
      return std::nullopt;
    if (!is_closed_by(faces, rim, area.normalized(), radius)) return std::nullopt;
    return end_at(faces, rim, area.normalized(), radius);
  }

  // The sum over faces, not twice it.
  Vector3 area_vector(const std::vector<Index>& faces) const {
    Vector3 sum = Vector3::Zero();
    for (const Index f : faces) sum += surface_.face_area(f) * normal_[f];
    return sum;
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
          if (!(normal_[SurfaceSnapshot::face(surface_.twin[h])].dot(axis) < kSharp)) smooth += length;
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

  static bool is_round(double area, double length) {
    constexpr double kRounder = 0.82;  // a circle is 1, a square 0.785, a ring of twice the hole's width 0.33
    return 4 * kPi * area >= kRounder * length * length;
  }

  // Whether the faces lie in a plane but for a tenth of the radius, in the square mean.
  bool is_flat(const std::vector<Index>& faces, const Vector3& normal, double radius) const {
    constexpr double kUneven = 0.1;
    double area = 0, first = 0, second = 0;
    for (const Index f : faces) {
      const double own = surface_.face_area(f);
      const double height = (surface_.face_centroid(f) - surface_.face_centroid(faces.front())).dot(normal);
      area += own;
      first += own * height;
      second += own * height * height;
    }
    return second * area - first * first <= std::pow(kUneven * radius * area, 2);
  }

  // Whether a tube ends in the cap: it is as deep as wide by half there, and the wall within half a radius of
  // the rim runs along the normal; by the mean square of the cosine, as a cone does whose side is 30 degrees
  // from its axis.
  bool is_closed_by(const std::vector<Index>& faces, const Rim& rim, const Vector3& normal, double radius) {
    constexpr double kMostAcross = 0.25;
    const Vector3 start = rim.centre - kAhead * radius * normal;
    if (!solid_.inside(start) || solid_.first_hit(start, -normal, (1 - kAhead) * radius)) return false;
    double reach = 0;
    for (const Index h : rim.halfedges)
      reach = std::max(reach, (surface_.position[surface_.origin[h]] - rim.centre).norm());
    reach += 0.5 * radius;
    const auto is_near = [&](Index f) { return (surface_.face_centroid(f) - rim.centre).norm() <= reach; };
    const std::vector<Index> all = connected(faces, is_near);
    double area = 0, across = 0;
    for (std::size_t i = faces.size(); i < all.size(); ++i) {
      const double own = surface_.face_area(all[i]), cosine = normal_[all[i]].dot(normal);
      area += own;
      across += own * cosine * cosine;
    }
    return across <= kMostAcross * area;
  }

  FlatEnd end_at(const std::vector<Index>& faces, const Rim& rim, const Vector3& normal,
                 double radius) const {
    FlatEnd flat{{}, normal};
    LimbTip& end = flat.tip;
    end.kind = TipKind::kFlatEnd;
    end.target = rim.centre - kAhead * radius * normal;
    end.measures.depth = radius;
    end.measures.half_width = 0.25 * radius;  // as that of a body's end: the arc is to end in the middle
    for (const Index f : faces)
      end.cap.insert(end.cap.end(), surface_.origin.begin() + 3 * f, surface_.origin.begin() + 3 * f + 3);
    std::sort(end.cap.begin(), end.cap.end());
    end.cap.erase(std::unique(end.cap.begin(), end.cap.end()), end.cap.end());
    end.vertex = *std::min_element(end.cap.begin(), end.cap.end(), [&](Index v, Index w) {
      return (surface_.position[v] - rim.centre).squaredNorm() <
             (surface_.position[w] - rim.centre).squaredNorm();
    });
    return flat;
  }

  static constexpr double kSharp = 0.64;  // the cosine of 50 degrees
  static constexpr double kAhead = 0.1;   // radii before the surface

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  std::vector<double> half_area_;  // of each component
  std::vector<Vector3> normal_;    // of each face
  std::vector<bool> tried_;
  std::vector<Index> reached_;  // the last round that came by
  Index round_ = 0;
  Watch watch_;
};

}  // namespace detail
}  // namespace mspskel
