// Builds a tetrahedron in OpenMesh, as a user would, and asks the installed library for its snapshot.
#include <cstdio>

#include "mspskel/mesh/default_mesh.h"
#include "mspskel/mesh/surface_snapshot.h"

int main() {
  mspskel::DefaultMesh mesh;
  const auto a = mesh.add_vertex({0, 0, 0}), b = mesh.add_vertex({1, 0, 0}), c = mesh.add_vertex({0, 1, 0}),
             d = mesh.add_vertex({0, 0, 1});
  mesh.add_face(a, c, b);
  mesh.add_face(a, b, d);
  mesh.add_face(b, c, d);
  mesh.add_face(c, a, d);
  const mspskel::SurfaceSnapshot snapshot = mspskel::make_snapshot(mesh);
  std::printf("%d faces\n", snapshot.face_count());
  return snapshot.face_count() == 4 && snapshot.component_count == 1 ? 0 : 1;
}
