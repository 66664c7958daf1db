// The boundary of a union of solids, from a grid.
#pragma once

#include <optional>
#include <vector>

#include "crossing_shells.h"
#include "mspskel/base/progress.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Shells, one or more, that are to become one solid, and what tells where their solids and walls are. Refers
// to the surface and the shells.
class ShellGroup {
 public:
  ShellGroup(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
             const std::vector<Index>& members, const Execution& execution);

  const SurfaceSnapshot& surface() const { return surface_; }
  std::size_t size() const { return members_.size(); }
  const Shell& shell(std::size_t i) const { return *members_[i]; }
  const BoundingVolumeHierarchy& solid(std::size_t i) const { return *solids_[i]; }
  const BoundingVolumeHierarchy& walls() const { return *walls_; }  // of all
  const std::vector<Index>& faces() const { return faces_; }        // of all
  const Vector3& low() const { return low_; }                       // the box of all
  const Vector3& high() const { return high_; }

  bool is_in(std::size_t i, const Vector3& p) const;  // in the solid of one
  bool inside(const Vector3& p) const;
  // Distance to the nearest face, or the bound.
  double distance(const Vector3& p, double bound) const;

 private:
  const SurfaceSnapshot& surface_;
  std::vector<const Shell*> members_;
  std::vector<Index> faces_;
  Vector3 low_, high_;
  std::vector<std::optional<BoundingVolumeHierarchy>> solids_;  // per member
  std::optional<BoundingVolumeHierarchy> walls_;
};

// Of the solids that the shells bound, each thickened by `margin`: closed, manifold triangles,
// counter-clockwise as seen from outside, in the surface's coordinates.
PolygonSoup boundary_of_union(const ShellGroup& group, double cell, double margin,
                              const Execution& execution);

}  // namespace mspskel::detail
