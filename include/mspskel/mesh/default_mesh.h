// The mesh type that the compiled library is instantiated for: an OpenMesh triangle mesh with double
// coordinates.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "mspskel/base/types.h"

namespace mspskel {

struct DefaultTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using DefaultMesh = OpenMesh::TriMesh_ArrayKernelT<DefaultTraits>;

template <class Point>
Vector3 to_vector3(const Point& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace mspskel
