// The mesh type that the compiled library is instantiated for: an OpenMesh triangle mesh with double
// coordinates.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "mspskel/mesh/default_mesh_fwd.h"

namespace mspskel {

struct DefaultTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

}  // namespace mspskel
