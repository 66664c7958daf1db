// Where the bodies of components end that no limb ends: the foot and the mouth of a vase, the ends of a
// hammer's head.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "mspskel/limbs/detail/limb_measurement.h"
#include "mspskel/limbs/detail/part_walk.h"
#include "mspskel/mesh/component_areas.h"

namespace mspskel {
namespace detail {

// What is left of each component without its limbs. A body that is longer than wide ends twice along its
// principal axis. One that is not ends opposite to its limbs if all leave to one side (in its middle if it is
// not long that way, as the head of a tack or the foot of a stand, and has no handle), and twice along the
// axis that stands apart if it has none. A limb that leaves the body near such an end, or has the end on its
// surface, stands for it.
class BodyEnds {
 public:
  BodyEnds(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
           const std::vector<FoundLimb>& limbs)
      : surface_(surface),
        solid_(solid),
        body_(static_cast<std::size_t>(surface.component_count)),
        area_with_limbs_(component_areas(surface)),
        in_limb_(surface.position.size(), 0) {
    set_carried(limbs);
    for (Body& body : body_)
      for (const FoundLimb* const limb : body.carried) {
        if (!is_limb_tip(limb)) continue;
        const double mouth = 2 * kPi * limb->tip.measures.depth / limb->tip.measures.depth_over_mouth;
        body.mouths += mouth * mouth / (4 * kPi);
        body.handles_of_limbs += handles_of(limb->part);
      }
    for (const FoundLimb& limb : limbs)
      if (limb.tip.kind == TipKind::kLimb) ++body_[surface.component[limb.tip.vertex]].limbs;
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      if (in_limb_[v] || surface.vertex_halfedge[v] == kNone) continue;
      const Vector3& x = surface.position[v];
      Body& body = body_[surface.component[v]];
      body.area += surface.vertex_area[v];
      body.centre += surface.vertex_area[v] * x;
      body.second += surface.vertex_area[v] * x * x.transpose();
    }
    for (Body& body : body_)
      if (body.area > 0) body.centre /= body.area;
  }

  Index limb_count(Index component) const { return body_[component].limbs; }
  // Of those that the body carries, as the eye of a rod.
  Index handles_of_limbs(Index component) const { return body_[component].handles_of_limbs; }

  // Where the only limb of a body that is a flat plate leaves it, if that is a rod: its arc goes all its
  // length.
  std::optional<LimbTip> foot(Index component) const {
    constexpr double kLeastSlenderness = 2, kSolid = 0.5;
    const Body& body = body_[component];
    if (body.carried.size() != 1 || !is_plate(body)) return std::nullopt;
    const FoundLimb& only = *body.carried.front();
    if (!only.tip.plate.empty() || !solid_.inside(only.root)) return std::nullopt;
    const LimbMeasures& m = only.tip.measures;
    if (m.slenderness < kLeastSlenderness || m.half_chord < kSolid * m.half_width) return std::nullopt;
    return end_at(component, only.root);
  }

  // The ends of one component's body that no limb stands for. `loops`: whether it has handles.
  std::vector<LimbTip> run(Index component, bool loops) const {
    const Body& body = body_[component];
    std::vector<LimbTip> ends;
    // With less surface than its limbs' mouths it is but the seam between them.
    if (!(body.area > body.mouths) || !solid_.inside(body.centre)) return ends;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance(body));
    const Vector3 moment = solver.eigenvalues();  // ascending
    if (moment[2] >= kLonger * kLonger * moment[1])
      for (const double sign : {-1.0, 1.0}) add_end(component, sign * solver.eigenvectors().col(2), ends);
    if (body.limbs == 0 && ends.empty()) add_ends_of_axis(component, solver, ends);
    if (!ends.empty()) return ends;
    const std::optional<Vector3> away = away_from_limbs(body);
    if (!away) return ends;
    const bool limbs_alone = !loops && std::all_of(body.carried.begin(), body.carried.end(), is_limb_tip);
    // Nothing else tells where the arc of a lone limb is to end.
    const bool lone = limbs_alone && body.carried.size() == 1;
    add_end(component, *away, ends, lone ? kFlat : kLonger);
    if (ends.empty() && (lone || (limbs_alone && is_far_from_limbs(component))))
      ends.push_back(end_at(component, body.centre));
    return ends;
  }

 private:
  struct Body {
    Index limbs = 0;
    std::vector<const FoundLimb*> carried;  // limbs and ears that are no part of another one
    double mouths = 0;                      // area of discs with the rims of the mouths of those limbs
    Index handles_of_limbs = 0;
    double area = 0;
    Vector3 centre = Vector3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // ∫ x xᵀ
  };

  static bool is_limb_tip(const FoundLimb* limb) { return limb->tip.kind == TipKind::kLimb; }

  // A limb is a part of another one, as an arm of the pole that it leaves, if that one's surface has its tip.
  void set_carried(const std::vector<FoundLimb>& limbs) {
    std::vector<const FoundLimb*> by_size;
    for (const FoundLimb& limb : limbs) by_size.push_back(&limb);
    std::stable_sort(by_size.begin(), by_size.end(),
                     [](const FoundLimb* a, const FoundLimb* b) { return a->part.size() > b->part.size(); });
    for (const FoundLimb* const limb : by_size) {
      const Index top = limb->tip.vertex;
      if (!in_limb_[top]) body_[surface_.component[top]].carried.push_back(limb);
      for (const Index v : limb->part) in_limb_[v] = 1;
    }
  }

  // A part that is open at one place is a disc with handles: its Euler characteristic is 1 less 2 for each.
  Index handles_of(const std::vector<Index>& part) const {
    const std::unordered_set<Index> within(part.begin(), part.end());
    const Index euler = euler_characteristic(surface_, part, [&](Index v) { return within.count(v) > 0; });
    return std::max<Index>(0, (1 - euler) / 2);
  }

  // Whether the surface is no farther from its middle plane than the plate is thick in its middle.
  bool is_plate(const Body& body) const {
    if (!(body.area > 0) || !solid_.inside(body.centre)) return false;
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance(body)).eigenvalues()[0];
    return std::sqrt(std::max(0.0, least)) <= 2 * solid_.distance(body.centre);
  }

  static Eigen::Matrix3d covariance(const Body& body) {
    return body.second / body.area - body.centre * body.centre.transpose();
  }

  static constexpr double kLonger = 1.4;  // length over width
  static constexpr double kFlat = 1.15;   // the same of a body that ends in its middle

  // Of a squat body, where one principal axis differs from the other two, and the way along it is longer than
  // the ball in the middle is wide: in a plate it is not.
  void add_ends_of_axis(Index component, const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& solver,
                        std::vector<LimbTip>& ends) const {
    constexpr double kApart = 1.1, kStretch = 1.25;
    const Vector3 moment = solver.eigenvalues();  // ascending
    const bool long_one = moment[2] * moment[0] > moment[1] * moment[1];
    if (moment[long_one ? 2 : 1] < kApart * kApart * moment[long_one ? 1 : 0]) return;
    const Vector3 axis = solver.eigenvectors().col(long_one ? 2 : 0), centre = body_[component].centre;
    const auto ahead = solid_.first_hit(centre, axis), back = solid_.first_hit(centre, -axis);
    if (!ahead || !back || ahead->distance + back->distance < 2 * kStretch * solid_.distance(centre)) return;
    for (const double sign : {-1.0, 1.0}) add_end(component, sign * axis, ends, 1.0);
  }

  // The opposite of where all limbs leave, seen from the middle of the body; nothing if they leave to several
  // sides, or if there are none.
  static std::optional<Vector3> away_from_limbs(const Body& body) {
    constexpr double kOneSide = 0.5;  // the cosine of the half angle of the cone that they are in
    std::vector<Vector3> directions;
    Vector3 sum = Vector3::Zero();
    for (const FoundLimb* const limb : body.carried) {
      if (!is_limb_tip(limb)) continue;
      directions.push_back((limb->root - body.centre).normalized());
      sum += directions.back();
    }
    const Vector3 axis = sum.normalized();
    const auto is_beside = [&](const Vector3& direction) { return direction.dot(axis) < kOneSide; };
    if (!(sum.norm() > 0) || std::any_of(directions.begin(), directions.end(), is_beside))
      return std::nullopt;
    return -axis;
  }

  // Where several limbs meet in the middle of the body, or it is but the fold between them, their arcs meet
  // without an end of its own.
  bool is_far_from_limbs(Index component) const {
    constexpr double kLeastShare = 0.2;
    const Body& body = body_[component];
    if (body.area < kLeastShare * area_with_limbs_[component]) return false;
    const Vector3& centre = body.centre;
    const double least = kLonger * solid_.distance(centre);
    return std::none_of(body.carried.begin(), body.carried.end(),
                        [&](const FoundLimb* limb) { return (limb->root - centre).norm() < least; });
  }

  // The end must be at least so many radii of the ball in the middle away.
  void add_end(Index component, const Vector3& direction, std::vector<LimbTip>& ends,
               double least = kLonger) const {
    constexpr double kNear = 0.4;   // of the way to the end: a limb that leaves beyond it stands for the end
    constexpr double kAhead = 0.1;  // radii of the ball in the middle before the surface
    const Vector3& centre = body_[component].centre;
    const auto hit = solid_.first_hit(centre, direction);
    const double radius = solid_.distance(centre);
    if (!hit || hit->distance < least * radius) return;
    for (const FoundLimb* const limb : body_[component].carried)
      if ((limb->root - centre).dot(direction) > kNear * hit->distance) return;
    const Vector3 end = centre + hit->distance * direction;
    LimbTip tip = end_at(component, end);
    if (in_limb_[tip.vertex]) return;
    tip.target = end - kAhead * radius * direction;
    tip.measures.depth = hit->distance;
    ends.push_back(std::move(tip));
  }

  // In the middle of the body or on its surface. It is as wide as the ball in the middle.
  LimbTip end_at(Index component, const Vector3& end) const {
    LimbTip tip;
    tip.kind = TipKind::kBodyEnd;
    tip.target = end;
    tip.vertex = nearest_vertex(component, end);
    const double radius = solid_.distance(body_[component].centre);
    tip.measures.depth = radius;
    tip.measures.half_width = 0.25 * radius;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (is_of(component, v) &&
          (surface_.position[v] - surface_.position[tip.vertex]).norm() <= 0.5 * radius)
        tip.cap.push_back(v);
    return tip;
  }

  bool is_of(Index component, Index v) const {
    return surface_.component[v] == component && surface_.vertex_halfedge[v] != kNone;
  }

  Index nearest_vertex(Index component, const Vector3& x) const {
    Index best = kNone;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (is_of(component, v) && (best == kNone || (surface_.position[v] - x).squaredNorm() <
                                                       (surface_.position[best] - x).squaredNorm()))
        best = v;
    return best;
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  std::vector<Body> body_;               // per component
  std::vector<double> area_with_limbs_;  // per component
  std::vector<std::uint8_t> in_limb_;    // per vertex
};

}  // namespace detail
}  // namespace mspskel
