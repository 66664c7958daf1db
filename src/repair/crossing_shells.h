// Which components of a surface pass through each other.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel::detail {

struct Shell {
  std::vector<Index> faces, vertices;
  Vector3 low = Vector3::Zero(), high = Vector3::Zero();  // its box
  double width = 0;                                       // four times volume over area: a tube's diameter
  bool inside_out = false;  // its faces are counter-clockwise as seen from inside
  double extent() const { return (high - low).norm(); }
};

std::vector<Shell> shells_of(const SurfaceSnapshot& surface);

// The members without those that are copies of one before them: each lies within a small part of its width of
// the other everywhere.
std::vector<Index> without_copies(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                                  const std::vector<Index>& members, const ProgressCallback& progress);

// See crossing_shells in unite_shells.h. kDeep: whatever the shells' width, as grids do not tell less.
enum class CrossingDepth { kAny, kDeep };
std::vector<std::vector<Index>> crossing_groups(const SurfaceSnapshot& surface,
                                                const std::vector<Shell>& shells,
                                                const ProgressCallback& progress,
                                                CrossingDepth depth = CrossingDepth::kAny);

}  // namespace mspskel::detail
