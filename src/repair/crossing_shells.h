// Which components of a surface pass through each other.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/repair/unite_shells.h"

namespace mspskel::detail {

struct Shell {
  std::vector<Index> faces, vertices;
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();  // its box
  double width = 0;                                       // four times volume over area: a tube's diameter
  bool inside_out = false;  // its faces are counter-clockwise as seen from inside
  double extent() const { return (high - low).norm(); }
};

std::vector<Shell> shells_of(const SurfaceSnapshot& surface);

// See crossing_shells in unite_shells.h.
CrossingShells find_crossings(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                              const ProgressCallback& progress);

// The groups of those that cross by a thousandth of their extent, whatever their width, as grids do not tell
// less, and of the copies that are known.
std::vector<std::vector<Index>> deep_groups(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                                            const std::vector<Index>& copy_of,
                                            const ProgressCallback& progress);

}  // namespace mspskel::detail
