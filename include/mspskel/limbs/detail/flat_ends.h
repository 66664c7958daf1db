// Where a tube was cut off: the flat caps of vessels, necks and rods, however short what they end is.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mspskel/base/watch.h"
#include "mspskel/limbs/detail/convex_hull.h"
#include "mspskel/limbs/detail/growing_parts.h"
#include "mspskel/limbs/detail/sharp_turn.h"
#include "mspskel/limbs/limb_tips.h"

namespace mspskel {
namespace detail {

struct FlatEnd {
  LimbTip tip;  // in the cap's middle, a little inside
  Vector3 normal = Vector3::Zero();
  std::vector<Index> vertices;  // of the cap with its rim, ascending
  bool carries = false;         // something stands on its middle
};

// A cap is flat, the surface turns off sharply all round it, and the wall beyond its rim runs along its
// normal, as below a tube's opening in a mesh that is not closed. A face of a block is none: others beside it
// are flat, about as wide as long and end sharply all round, too. What is rounder than a square has no such
// faces beside it. How round and how wide a cap is, its area's moments tell: a rim that noise leaves jagged
// is long, but moves them little.
class FlatEndSearch {
 public:
  FlatEndSearch(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                const ProgressCallback& progress)
      : surface_(surface),
        solid_(solid),
        half_area_(half_areas_of_components(surface)),
        tried_(static_cast<std::size_t>(surface.face_count()), false),
        found_(tried_.size(), false),
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
    double others = 0;  // the length of the other loops but slivers
  };

  struct Cap {
    std::vector<Index> faces;
    Rim rim;
    Vector3 normal = Vector3::Zero(), centre = Vector3::Zero();
    double area = 0;        // as seen along the normal: noise adds to that of the faces
    double radius = 0;      // half the width of the ellipse with its second moments
    double elongation = 1;  // of that ellipse
    double fill = 0;        // its area over the ellipse's: 1, or 0.95 for a rectangle
    double solidity = 0;    // the area in its rim over that of its hull: 0.86 for three squares as an L
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
    constexpr double kMostOthers = 0.3;
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
    set_moments(cap);
    if (!is_flat(cap)) return std::nullopt;
    // Another face that lies aslant leads to the same cap again.
    std::size_t found_before = 0;
    for (const Index f : cap.faces) {
      found_before += found_[f] ? 1 : 0;
      found_[f] = true;
    }
    if (2 * found_before > cap.faces.size()) return std::nullopt;
    if (is_wide(cap))
      for (const Index f : cap.faces) in_cap_[f] = true;
    // What stands on a cap goes on where that would end.
    if (cap.rim.others > kMostOthers * cap.rim.length) return std::nullopt;
    return cap;
  }

  // The centre of the cap's area and its ellipse. The second moment of a triangle of area A with corners a
  // and centroid c is A / 12 (sum of a aᵀ + 9 c cᵀ).
  void set_moments(Cap& cap) const {
    double area = 0;
    Vector3 first = Vector3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const Index f : cap.faces) {
      const double own = surface_.face_area(f);
      const Vector3 centroid = surface_.face_centroid(f);
      area += own;
      first += own * centroid;
      second += 0.75 * own * centroid * centroid.transpose();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Vector3& corner = surface_.position[surface_.origin[h]];
        second += own / 12 * corner * corner.transpose();
      }
    }
    cap.centre = first / area;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second / area -
                                                                cap.centre * cap.centre.transpose());
    const double width = std::sqrt(std::max(0.0, solver.eigenvalues()[1])),
                 length = std::sqrt(std::max(0.0, solver.eigenvalues()[2]));
    cap.radius = 2 * width;
    cap.elongation = length / width;
    cap.fill = cap.area / (4 * kPi * width * length);
    std::vector<Vector3> rim;
    for (const Index h : cap.rim.halfedges) rim.push_back(surface_.position[surface_.origin[h]]);
    const PlaneHull hull(rim, cap.normal);
    cap.solidity = hull.area_in(rim) / hull.area();
  }

  // Whether it is about as wide as long, and no L or T.
  static bool is_wide(const Cap& cap) {
    constexpr double kSlim = 2.2, kHollow = 0.9;
    return cap.elongation <= kSlim && cap.solidity >= kHollow;
  }

  // A cap is as wide as long, about, and no top of noise.
  bool is_face_of_block(const Cap& cap) const {
    constexpr double kRounder = 0.975;
    constexpr std::size_t kLeastRim = 8;  // edges: with fewer the tops of noise look round
    constexpr double kLeastShare =
        0.005;  // of the component's area: what is thinner and a limb is told as one
    const Index component = surface_.component[surface_.origin[3 * cap.faces.front()]];
    if (cap.area < kLeastShare * 2 * half_area_[component]) return true;
    if (!is_wide(cap)) return true;
    if (cap.fill >= kRounder) return cap.rim.halfedges.size() < kLeastRim;
    return std::any_of(cap.rim.halfedges.begin(), cap.rim.halfedges.end(),
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
    constexpr double kMostSmooth = 0.2, kSliver = 0.1;  // of the loop
    std::unordered_set<Index> walked;
    Rim longest;
    std::vector<double> lengths;
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
        lengths.push_back(rim.length);
        if (rim.length <= longest.length) continue;
        longest = std::move(rim);
        if (smooth > kMostSmooth * longest.length) longest.halfedges.clear();
      }
    if (longest.halfedges.empty()) return {};
    longest.centre /= longest.length;
    for (const double length : lengths)
      if (length >= kSliver * longest.length) longest.others += length;
    longest.others -= longest.length;
    return longest;
  }

  // Whether the faces, and their rim by itself, lie in a plane but for a tenth of the radius, in the square
  // mean. A few sides of a prism are as flat, but not where they end.
  bool is_flat(const Cap& cap) const {
    constexpr double kUneven = 0.1;
    const auto square_of_height = [&](const Vector3& x) {
      return std::pow((x - cap.centre).dot(cap.normal), 2);
    };
    double area = 0, of_faces = 0, of_rim = 0;
    for (const Index f : cap.faces) {
      area += surface_.face_area(f);
      of_faces += surface_.face_area(f) * square_of_height(surface_.face_centroid(f));
    }
    for (const Index h : cap.rim.halfedges) {
      const Vector3 middle =
          0.5 * (surface_.position[surface_.origin[h]] + surface_.position[surface_.target(h)]);
      of_rim += surface_.edge_length(h) * square_of_height(middle);
    }
    const double most = std::pow(kUneven * cap.radius, 2);
    return of_faces <= most * area && of_rim <= most * cap.rim.length;
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
    FlatEnd flat{{}, cap.normal, vertices_of(surface_, cap.faces)};
    LimbTip& end = flat.tip;
    end.kind = TipKind::kFlatEnd;
    end.target = cap.centre - kAhead * cap.radius * cap.normal;
    end.measures.depth = end.flat_end = cap.radius;
    end.measures.half_width = 0.25 * cap.radius;  // as that of a body's end: the arc is to end in the middle
    flat.carries = !solid_.first_hit(end.target, cap.normal, 2 * kAhead * cap.radius);
    const auto away = [&](Index v) { return (surface_.position[v] - cap.centre).norm(); };
    end.vertex = *std::min_element(flat.vertices.begin(), flat.vertices.end(),
                                   [&](Index v, Index w) { return away(v) < away(w); });
    // An arc that ends here is nearest to the inner part of the cap, whatever other arcs pass by its rim.
    const double inner = std::max(0.5 * cap.radius, away(end.vertex));
    for (const Index v : flat.vertices)
      if (away(v) <= inner) end.cap.push_back(v);
    return flat;
  }

  static constexpr double kAhead = 0.1;  // radii before the surface

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  std::vector<double> half_area_;  // of each component
  std::vector<Vector3> normal_;    // of each face
  std::vector<bool> tried_;
  std::vector<bool> found_;     // of flat caps with a sharp rim
  std::vector<bool> in_cap_;    // of caps that are not slim, be they ends or not
  std::vector<Index> reached_;  // the last round that came by
  Index round_ = 0;
  Watch watch_;
};

}  // namespace detail
}  // namespace mspskel
