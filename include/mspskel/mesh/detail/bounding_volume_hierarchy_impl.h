#pragma once

#include <array>
#include <cmath>
#include <numeric>

#include "mspskel/base/clones.h"
#include "mspskel/base/even_directions.h"
#include "mspskel/base/linkage.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/detail/segment_triangle.h"

namespace mspskel {

namespace detail {

inline PrimitiveBox box_of(const Triangle& t, Index primitive) {
  const Vector3 low = t.a.cwiseMin(t.b).cwiseMin(t.c), high = t.a.cwiseMax(t.b).cwiseMax(t.c);
  return {{static_cast<float>(low[0]), static_cast<float>(low[1]), static_cast<float>(low[2]), 0.0f},
          {static_cast<float>(high[0]), static_cast<float>(high[1]), static_cast<float>(high[2])},
          primitive};
}

}  // namespace detail

MSPSKEL_INLINE BoundingVolumeHierarchy::BoundingVolumeHierarchy(const SurfaceSnapshot& s,
                                                                const ProgressCallback& progress)
    : BoundingVolumeHierarchy(
          s,
          [&] {
            std::vector<Index> all(s.face_count());
            std::iota(all.begin(), all.end(), 0);
            return all;
          }(),
          progress) {}

MSPSKEL_INLINE BoundingVolumeHierarchy::BoundingVolumeHierarchy(const SurfaceSnapshot& s,
                                                                const std::vector<Index>& faces,
                                                                const ProgressCallback& progress) {
  const auto triangle = [&](Index f) {
    return detail::Triangle{s.position[s.origin[3 * f]], s.position[s.origin[3 * f + 1]],
                            s.position[s.origin[3 * f + 2]]};
  };
  std::vector<detail::PrimitiveBox> boxes;
  boxes.reserve(faces.size());
  for (const Index f : faces) {
    const detail::Triangle t = triangle(f);
    boxes.push_back(detail::box_of(t, f));
    for (const Vector3* p : {&t.a, &t.b, &t.c}) reach_ = std::max(reach_, p->cwiseAbs().maxCoeff());
  }
  face_ = tree_.build(boxes, reach_, progress);
  face_count_ = static_cast<Index>(faces.size());
  triangles_.resize(face_.size());
  blocks_.reserve(face_.size() / detail::BoxTree::kLeafSize);
  for (std::size_t leaf = 0; leaf < face_.size(); leaf += detail::BoxTree::kLeafSize) {
    Index count = 0;
    for (; count < detail::BoxTree::kLeafSize && face_[leaf + count] != kNone; ++count)
      triangles_[leaf + count] = triangle(face_[leaf + count]);
    blocks_.emplace_back(&triangles_[leaf], count);
  }
}

MSPSKEL_AVX_CLONES MSPSKEL_INLINE ClosestPoint BoundingVolumeHierarchy::closest(const Vector3& p,
                                                                                double bound) const {
  ClosestPoint best;
  double square = bound * bound;
  const detail::FilterPoint rough(p, reach_);
  const double error = detail::TriangleBlock::distance_error(rough);
  double limit = (bound + error) * (bound + error);
  tree_.by_distance(p, square, [&](Index first, Index count) {
    alignas(16) float around[4];
    blocks_[first / detail::BoxTree::kLeafSize].squared_distances(rough, around);
    for (Index k = 0; k < count; ++k) {
      if (static_cast<double>(around[k]) > limit) continue;
      const Vector3 q = detail::closest_on_triangle(p, triangles_[first + k]);
      const double d = (q - p).squaredNorm();
      if (d >= square) continue;
      square = d;
      limit = (std::sqrt(d) + error) * (std::sqrt(d) + error);
      best.point = q;
      best.face = face_[first + k];
    }
  });
  if (best.face != kNone) best.distance = std::sqrt(square);
  return best;
}

template <class Boxes, class Visit>
void BoundingVolumeHierarchy::along_ray(const Boxes& boxes, const Vector3& origin, const Vector3& unit,
                                        const double& bound, Visit visit) const {
  const detail::FilterPoint rough(origin, reach_);
  const float direction[3] = {static_cast<float>(unit[0]), static_cast<float>(unit[1]),
                              static_cast<float>(unit[2])};
  boxes.along_ray(origin, unit, bound, [&](Index first, Index count) {
    alignas(16) float may[4];
    blocks_[first / detail::BoxTree::kLeafSize].may_meet(rough, direction, may);
    for (Index k = 0; k < count; ++k)
      if (may[k] >= 0 && !visit(first + k)) return false;
    return true;
  });
}

template <class Boxes>
RayHit BoundingVolumeHierarchy::first_hit(const Boxes& boxes, const Vector3& origin, const Vector3& unit,
                                          double max_distance) const {
  RayHit best{kNone, max_distance};
  along_ray(boxes, origin, unit, best.distance, [&](Index slot) {
    const detail::RayTriangle r(origin, unit, triangles_[slot]);
    if (!r.meets_line() || r.volume() == 0) return true;
    const double t = r.distance(unit);
    if (t >= 0 && t <= best.distance) best = {face_[slot], t};
    return true;
  });
  return best;
}

MSPSKEL_AVX_CLONES MSPSKEL_INLINE std::optional<RayHit> BoundingVolumeHierarchy::first_hit(
    const Vector3& origin, const Vector3& direction, double max_distance) const {
  const RayHit hit = first_hit(tree_, origin, direction.normalized(), max_distance);
  if (hit.face == kNone) return std::nullopt;
  return hit;
}

MSPSKEL_INLINE Index BoundingVolumeHierarchy::count_hits(const Vector3& origin, const Vector3& direction,
                                                         double max_distance) const {
  const Vector3 unit = direction.normalized();
  Index hits = 0;
  along_ray(tree_, origin, unit, max_distance, [&](Index slot) {
    const detail::RayTriangle r(origin, unit, triangles_[slot]);
    if (!r.meets_line() || r.volume() == 0) return true;
    const double t = r.distance(unit);
    if (t >= 0 && t <= max_distance) ++hits;
    return true;
  });
  return hits;
}

// Rays of a fan meet the same few leaves, those on its plane within the farthest hit: they are collected
// once, out to twice what the first ray that passes them all sees, and each ray looks at them before the
// tree.
MSPSKEL_AVX_CLONES MSPSKEL_INLINE void BoundingVolumeHierarchy::ray_fan(const Vector3& p, const Vector3& u,
                                                                        const Vector3& w, int count,
                                                                        double* distance) const {
  const std::vector<Vector2>& direction = even_directions(count);
  const Vector3 normal = u.cross(w);
  // Far from the boxes single precision does not tell where the plane is.
  bool collects = p.cwiseAbs().maxCoeff() <= reach_;
  double radius = 0.0;  // the fan has all leaves within it
  detail::BoxFan fan;
  for (int k = 0; k < count; ++k) {
    const Vector3 unit = (direction[k].x() * u + direction[k].y() * w).normalized();
    RayHit hit;
    if (radius > 0) hit = first_hit(fan, p, unit, radius);
    if (hit.face == kNone) {
      hit = first_hit(tree_, p, unit, std::numeric_limits<double>::infinity());
      if (collects && hit.face != kNone) {
        radius = 2 * hit.distance;
        const Vector3 reach = Vector3::Constant(radius);
        collects = tree_.collect_on_plane(p - reach, p + reach, normal, normal.dot(p), fan);
        if (!collects) radius = 0.0;
      }
    }
    distance[k] = hit.face != kNone ? hit.distance : std::numeric_limits<double>::infinity();
  }
}

MSPSKEL_INLINE bool BoundingVolumeHierarchy::inside(const Vector3& p) const {
  // Spread by the golden angle, so that no two are alike and none is parallel to an axis or a diagonal. The
  // one that points away from the middle has the least surface ahead.
  constexpr int kDirections = 16;
  static const auto directions = [] {
    std::array<Vector3, kDirections> d;
    for (int k = 0; k < kDirections; ++k) {
      const double z = 1 - (2 * k + 1.0) / kDirections, angle = k * kPi * (3 - std::sqrt(5.0)) + 0.35;
      d[k] = Vector3(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    }
    return d;
  }();
  int start = 0;
  for (int k = 1; k < kDirections; ++k)
    if (directions[k].dot(p) > directions[start].dot(p)) start = k;
  for (int k = 0; k < kDirections; ++k) {
    const Vector3& direction = directions[(start + k) % kDirections];
    bool odd = false, doubtful = false, on_surface = false;
    along_ray(tree_, p, direction, std::numeric_limits<double>::infinity(), [&](Index slot) {
      const detail::Crossing crossing = detail::ray_crossing(p, direction, triangles_[slot]);
      odd = odd != (crossing == detail::Crossing::kClear);
      doubtful = doubtful || crossing == detail::Crossing::kDoubtful;
      on_surface = on_surface || crossing == detail::Crossing::kOnSurface;
      return !doubtful && !on_surface;
    });
    if (on_surface) return true;
    if (!doubtful) return odd;
  }
  // Every ray meets an edge at p itself, unless p is on the surface.
  return distance(p) <= 1e-14 * std::max(1.0, p.norm()) || in_winding(p);
}

// By the solid angles of the triangles (Van Oosterom, Strackee 1983). O(faces): for points that no ray could
// settle.
MSPSKEL_INLINE bool BoundingVolumeHierarchy::in_winding(const Vector3& p) const {
  double angle = 0.0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (face_[i] == kNone) continue;
    const detail::Triangle& t = triangles_[i];
    const Vector3 a = t.a - p, b = t.b - p, c = t.c - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::lround(angle / (4 * kPi)) % 2 != 0;
}

MSPSKEL_AVX_CLONES MSPSKEL_INLINE bool BoundingVolumeHierarchy::segment_crosses(const Vector3& a,
                                                                                const Vector3& b) const {
  const double length = (b - a).norm();
  if (!(length > 0)) return false;
  bool crossed = false;
  along_ray(tree_, a, (b - a) / length, length, [&](Index slot) {
    crossed = detail::segment_meets_triangle(a, b, triangles_[slot], false);
    return !crossed;
  });
  return crossed;
}

}  // namespace mspskel
