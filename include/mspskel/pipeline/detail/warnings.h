// What the result says of itself.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>

#include "mspskel/base/counted.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/skeleton/useless_pieces.h"

namespace mspskel {
namespace detail {

inline std::string small_handles_left_out(const ExtractResult& result) {
  const std::vector<SmallHandle>& handles = result.cocycles.small_handles;
  const auto& least =
      *std::min_element(handles.begin(), handles.end(),
                        [](const SmallHandle& a, const SmallHandle& b) { return a.length < b.length; });
  const Vector3 at = result.surface.frame.to_model(least.at);
  char text[128];
  std::snprintf(text, sizeof text, "; the shortest loop, %.6g long, is at %.6g %.6g %.6g",
                least.length * result.surface.frame.scale, at.x(), at.y(), at.z());
  return counted(static_cast<Index>(handles.size()), "handle") + " too small for a cycle left out" + text;
}

inline void collect_warnings(ExtractResult& result) {
  if (result.skeleton_mesh.without_slice > 0)
    result.warnings.push_back("no valid slice at " +
                              counted(result.skeleton_mesh.without_slice, "vertex", "vertices") +
                              "; the neighbours' skeletal points stand in");
  if (result.refinement.routing.unroutable > 0)
    result.warnings.push_back("no way inside was found for " +
                              counted(result.refinement.routing.unroutable, "stretch", "stretches") +
                              " of the skeleton outside the solid");
  if (!result.cocycles.small_handles.empty()) result.warnings.push_back(small_handles_left_out(result));
  const UselessPieces useless = find_useless_pieces(result.surface, result.skeleton);
  if (useless.stubs > 0)
    result.warnings.push_back("the skeleton is shorter than a tenth of its extent in " +
                              counted(useless.stubs, "component"));
  if (useless.on_surface > 0)
    result.warnings.push_back("the skeleton lies on the surface at " + counted(useless.on_surface, "node"));
  if (result.cycles.rank < result.cycles.cycles)
    result.warnings.push_back("no way round the handle that it misses was found for " +
                              counted(result.cycles.cycles - result.cycles.rank, "cycle") +
                              " of the skeleton");
}

}  // namespace detail
}  // namespace mspskel
