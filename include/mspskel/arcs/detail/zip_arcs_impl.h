#pragma once

#include "mspskel/arcs/detail/arc_zipper.h"
#include "mspskel/base/linkage.h"

namespace mspskel {

MSPSKEL_INLINE Index zip_arcs(ArcGraph& graph, const SurfaceSnapshot& surface,
                              const BoundingVolumeHierarchy& solid, const ZipOptions& options,
                              const CrossingLabels& crossings, const Execution& execution,
                              const std::vector<bool>& kept) {
  validate(options);
  if (options.closeness == 0) return 0;
  return detail::ArcZipper(graph, surface, solid, options.closeness, crossings, kept).run(execution);
}

}  // namespace mspskel
