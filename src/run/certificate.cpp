#include "certificate.h"

#include "mspskel/io/write_skeleton.h"
#include "mspskel/skeleton/polyline_graph.h"

namespace mspskel::cli {

TopologyCertificate certify(const SurfaceSnapshot& surface, const VolumeCocycles& cocycles,
                            const SolidHierarchies& solids, const CurveSkeleton& skeleton,
                            CertificateDepth depth, const Execution& execution) {
  refuse_not_finite(skeleton);
  CertificateOptions options;
  // Whether the surface crosses itself decides between "proved" and "kept", and over failure only where a
  // handle has no cocycle of the solid.
  if (depth == CertificateDepth::kVerdict && cocycles.completions == 0) options.self_intersecting = false;
  return certify_topology(surface, cocycles, solids, polyline_graph(surface, skeleton), options, execution);
}

Json certificate_json(const TopologyCertificate& c) {
  return {{"b0", c.b0},
          {"b1", c.b1},
          {"topology", to_string(c.verdict)},
          {"reason", c.reason},
          {"components", c.components},
          {"nested_components", c.nested_components},
          {"genus", c.genus},
          {"small_handles", c.small_handles},
          {"self_intersecting", c.self_intersecting},
          {"discs", c.discs},
          {"holed_regions", c.holed_regions},
          {"linking", c.linking},
          {"completions", c.completions},
          {"cocycle_rank", c.cocycle_rank},
          {"crossing_rank", c.crossing_rank},
          {"inside", c.inside},
          {"edges_not_inside", c.edges_not_inside}};
}

}  // namespace mspskel::cli
