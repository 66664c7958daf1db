#pragma once

#include <string>

#include "mspskel/skeleton/spanning_forest.h"

namespace mspskel::detail {

// A polyline a branch, from the root outward; branches share the points of their joints. Arrays as VMTK and
// 3D Slicer name them (Antiga et al. 2008, "An image-based modeling framework for patient-specific
// computational hemodynamics"):
//   points  MaximumInscribedSphereRadius, Radius; Abscissas (way from the root); Curvature, Torsion,
//           FrenetTangent, FrenetNormal, FrenetBinormal, ParallelTransportNormals of the branch that leads
//           to the point; Marks (1 where branches meet)
//   cells   CenterlineIds (the first way from the root to a tip that uses the branch), TractIds (its number
//           on that way), GroupIds (its own), Blanking (1: it lies in the balls of the joints at its ends),
//           Length, Tortuosity (length over distance of the ends, less 1), Topology (the points of the joints
//           at its ends; -1: free)
std::string format_vtp(const CurveSkeleton& skeleton, const RootChoice& root);

}  // namespace mspskel::detail
