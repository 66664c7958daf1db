// The topology certificate of a skeleton, wherever it comes from.
#pragma once

#include "command_line.h"
#include "mspskel/collapse/topology_certificate.h"
#include "mspskel/mesh/solid_hierarchies.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::cli {

enum class CertificateDepth {
  kVerdict,  // whether the skeleton fails; "proved" then means that nothing but a crossing surface is against
             // it
  kFull,     // the surface is tested for self-intersections too
};

// `solids` are those of the surface; the skeleton is in model units and may lack its surface map. Throws
// NoSkeletonError if a number of the skeleton is not finite; Cancelled.
TopologyCertificate certify(const SurfaceSnapshot& surface, const VolumeCocycles& cocycles,
                            const SolidHierarchies& solids, const CurveSkeleton& skeleton,
                            CertificateDepth depth, const Execution& execution = {});

Json certificate_json(const TopologyCertificate& certificate);

}  // namespace mspskel::cli
