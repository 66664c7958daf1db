// The name of the mesh type in mesh/default_mesh.h, for declarations: its definition brings in OpenMesh, half
// a second of a user's compile time.
#pragma once

namespace OpenMesh {
template <class Traits>
class TriMesh_ArrayKernelT;
}

namespace mspskel {
struct DefaultTraits;
using DefaultMesh = OpenMesh::TriMesh_ArrayKernelT<DefaultTraits>;
}  // namespace mspskel
