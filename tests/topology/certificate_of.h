// The certificate of what an extraction made.
#pragma once

#include "mspskel/collapse/topology_certificate.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/skeleton/polyline_graph.h"

namespace mspskel::test {

inline TopologyCertificate certificate_of(const ExtractResult& result) {
  return certify_topology(result.surface, result.cocycles, BoundingVolumeHierarchy(result.surface),
                          polyline_graph(result.surface, result.skeleton));
}

}  // namespace mspskel::test
