// Which nodes of a curve skeleton belong to one part of the shape.
#pragma once

#include <array>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

struct PartOptions {
  // A part ends where the cross-section is at most so many times what a straight taper between its neighbours
  // would have there; (0, 1]. 1 cuts at every waist, small values only at deep ones.
  double contrast = 0.93;
  // How far those neighbours may be, in radii of the larger one's cross-section; [0, 100].
  double reach = 2.0;
  // A part's surface is at least so many times the square of the perimeter that cuts it off; [0, 100]. A tube
  // as long as it is wide has 1 / pi = 0.32, a hemisphere 1 / (2 pi) = 0.16.
  double slenderness = 0.2;
  // Parts below this share of the surface are not cut off; [0, 1].
  double smallest = 0.003;
  // At most so many parts, the clearest first, [0, 2^31), though never fewer than the skeleton has pieces; 0:
  // as many as the shape asks for. Where it asks for fewer, waists and tubes that it would leave whole are
  // cut too.
  Index count = 0;
};

// Throws UsageError naming the option.
void validate(const PartOptions& options);

// Where the vertices of two nodes meet on the surface.
struct NodeContact {
  std::array<Index, 2> nodes{};
  double length = 0.0;  // of the border between them, model units
};

struct SkeletonParts {
  std::vector<Index> part_of_node;  // 0 to count - 1; the nodes of a part are connected
  Index count = 0;
};

// Cuts the skeleton at its waists and where limbs leave thicker bodies (docs/segmentation.md). Cross-sections
// are the nodes' mean minimum slice perimeters, or the length of the border that the cut has on the surface
// where that is longer: a plate's corner is no limb. Cuts are made one by one, the cleanest first; one cut
// through an arc that is on no cycle, two through an arc that is. Parts are numbered in the order in which
// they were cut off. Throws UsageError for options out of range, Cancelled; the callback is
// asked once a part. Cost: O(parts * nodes^2) at worst.
SkeletonParts find_parts(const CurveSkeleton& skeleton, const std::vector<NodeContact>& contacts,
                         const PartOptions& options = {}, const ProgressCallback& progress = {});

}  // namespace mspskel
