// Shells that are to become one, each moved a little.
#pragma once

#include <vector>

#include "face_cutter.h"
#include "shell_grid.h"

namespace mspskel::detail {

// How far shells are moved to be in general position, in the surface's coordinates.
constexpr double kShellShift = 2e-7;

// A face's plane, seen from outside the shell, along the axis that it faces most.
struct FacePlane {
  int u, v;
  FaceCutter::Point at(const Vector3& p) const { return {p[u], p[v]}; }
};

// A group's shells in general position: no faces are coplanar and no three meet in a line. Refers to the
// group.
class ShiftedShells {
 public:
  // Each shell is moved by up to kShellShift along each axis.
  ShiftedShells(const ShellGroup& group, unsigned seed);

  const ShellGroup& group() const { return group_; }
  const SurfaceSnapshot& surface() const { return group_.surface(); }
  Index corner(Index f, int k) const { return surface().origin[3 * f + k]; }
  // The place of a vertex's or a face's shell in the group.
  Index member(Index v) const { return member_[v]; }
  Index member_of_face(Index f) const { return member_[corner(f, 0)]; }

  // The surface's vertices, moved, then those that were added.
  const std::vector<Vector3>& points() const { return point_; }
  const Vector3& point(Index v) const { return point_[v]; }
  Index add_point(const Vector3& p);

  FacePlane plane_of(Index f) const;
  // Whether a point lies in the solid of a shell.
  bool is_in(Index member, const Vector3& p) const;

 private:
  const ShellGroup& group_;
  std::vector<Index> member_;   // per vertex; kNone: of no shell of the group
  std::vector<Vector3> shift_;  // per member
  std::vector<Vector3> point_;
};

}  // namespace mspskel::detail
