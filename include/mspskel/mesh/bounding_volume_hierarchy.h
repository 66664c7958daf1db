// A hierarchy of boxes over the surface's triangles: distance, rays, inside.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/base/types.h"
#include "mspskel/mesh/detail/box_tree.h"
#include "mspskel/mesh/detail/triangle_block.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

struct ClosestPoint {
  Vector3 point = Vector3::Zero();
  Index face = kNone;  // kNone: nothing within the bound that was asked for
  double distance = std::numeric_limits<double>::infinity();
};

struct RayHit {
  Index face = kNone;
  double distance = 0.0;  // along the ray, in the frame's unit of length
};

// Boxes with four children each over leaves of up to four triangles, split by the surface area heuristic
// (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies"). Boxes are single precision
// and rounded outward; what is reported is computed in double from the triangles themselves.
//
// Coordinates are those of the snapshot (normalised). Copies what it needs: the snapshot may go. Every query
// is const, thread-safe, allocates nothing and takes O(log faces) for well-shaped surfaces. Where several
// faces answer equally well (a point above an edge), any of them is named, always the same for the same
// snapshot.
class BoundingVolumeHierarchy {
 public:
  // O(faces log faces). Throws Cancelled.
  explicit BoundingVolumeHierarchy(const SurfaceSnapshot& snapshot, const ProgressCallback& progress = {});
  // Over some of the faces: queries see only these, and still name them as the snapshot does.
  BoundingVolumeHierarchy(const SurfaceSnapshot& snapshot, const std::vector<Index>& faces,
                          const ProgressCallback& progress = {});

  Index face_count() const { return face_count_; }

  // The surface point nearest to p, if it is nearer than `bound`. A tight bound, such as a neighbour's answer
  // plus the way to the neighbour, saves time. Beyond 10^18 model extents nothing is found.
  ClosestPoint closest(const Vector3& p, double bound = std::numeric_limits<double>::infinity()) const;

  // Distance from p to the surface.
  double distance(const Vector3& p) const { return closest(p).distance; }

  // The first triangle along the ray, at a distance of at most max_distance. The direction may have any
  // length but zero. A ray that passes an edge or vertex hits one of the triangles there.
  std::optional<RayHit> first_hit(const Vector3& origin, const Vector3& direction,
                                  double max_distance = std::numeric_limits<double>::infinity()) const;

  // Triangles that the ray crosses, both ways; an edge or vertex counts once for each triangle that it
  // touches.
  Index count_hits(const Vector3& origin, const Vector3& direction,
                   double max_distance = std::numeric_limits<double>::infinity()) const;

  // Distances to the surface along `count` rays that leave p in the plane of the orthonormal u, w: ray k
  // points to cos(2πk/count) u + sin(2πk/count) w. Infinity where a ray escapes.
  void ray_fan(const Vector3& p, const Vector3& u, const Vector3& w, int count, double* distance) const;

  // Whether p lies in the solid: a ray from it crosses the surface an odd number of times, so a shell inside
  // another bounds a cavity whichever way either is oriented. A ray that comes within rounding of an edge is
  // dropped for another one. Points on the surface, within rounding, are inside.
  bool inside(const Vector3& p) const;

  // Whether the open segment ab meets the surface: touching counts as crossing, an end on the surface does
  // not. Safe against rounding: a segment reported free has both ends strictly on one side, or passes
  // strictly beside, each triangle.
  bool segment_crosses(const Vector3& a, const Vector3& b) const;

  // Calls visit(face) for every face whose box meets the box [low, high], some more; stops when visit returns
  // false.
  template <class Visit>
  void for_each_in_box(const Vector3& low, const Vector3& high, Visit visit) const;

  // The same for the faces of these whose box meets the plane normal · x = offset (unit normal), and some
  // more: as few as a section has, however many the box.
  template <class Visit>
  void for_each_in_box_on_plane(const Vector3& low, const Vector3& high, const Vector3& normal, double offset,
                                Visit visit) const;

 private:
  bool in_winding(const Vector3& p) const;
  // Calls visit(face) for the triangles of a leaf until it returns false, which it then returns.
  template <class Visit>
  bool visit_leaf(Index first, Index count, Visit visit) const;
  // Calls visit(slot) for the triangles near the ray until it returns false. The boxes are the tree, which
  // gives them roughly front to back, or a fan of it.
  template <class Boxes, class Visit>
  void along_ray(const Boxes& boxes, const Vector3& origin, const Vector3& unit, const double& bound,
                 Visit visit) const;
  template <class Boxes>
  RayHit first_hit(const Boxes& boxes, const Vector3& origin, const Vector3& unit, double max_distance) const;

  detail::BoxTree tree_;
  double reach_ = 0.0;  // bounds every coordinate
  Index face_count_ = 0;
  std::vector<detail::Triangle> triangles_;    // per slot of the leaves, four a leaf
  std::vector<Index> face_;                    // per slot, kNone where it is empty
  std::vector<detail::TriangleBlock> blocks_;  // per leaf
};

template <class Visit>
bool BoundingVolumeHierarchy::visit_leaf(Index first, Index count, Visit visit) const {
  for (Index i = first; i < first + count; ++i)
    if (!visit(face_[i])) return false;
  return true;
}

template <class Visit>
void BoundingVolumeHierarchy::for_each_in_box(const Vector3& low, const Vector3& high, Visit visit) const {
  tree_.in_box(low, high, [&](Index first, Index count) { return visit_leaf(first, count, visit); });
}

template <class Visit>
void BoundingVolumeHierarchy::for_each_in_box_on_plane(const Vector3& low, const Vector3& high,
                                                       const Vector3& normal, double offset,
                                                       Visit visit) const {
  tree_.in_box_on_plane(low, high, normal, offset,
                        [&](Index first, Index count) { return visit_leaf(first, count, visit); });
}

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/bounding_volume_hierarchy_impl.h"
#endif
