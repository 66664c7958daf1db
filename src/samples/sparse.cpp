#include "sparse.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalDeviationT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "mspskel/mesh/default_mesh.h"

namespace mspskel::detail {

PolygonSoup with_long_triangles(const PolygonSoup& soup, double error) {
  struct Traits : DefaultTraits {
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  };
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
  Mesh mesh;
  for (const Vector3& p : soup.points) mesh.add_vertex({p.x(), p.y(), p.z()});
  for (std::size_t c = 0; c < soup.corners.size(); c += 3)
    mesh.add_face(Mesh::VertexHandle(soup.corners[c]), Mesh::VertexHandle(soup.corners[c + 1]),
                  Mesh::VertexHandle(soup.corners[c + 2]));
  mesh.update_face_normals();
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  OpenMesh::Decimater::ModQuadricT<Mesh>::Handle quadric;
  OpenMesh::Decimater::ModNormalDeviationT<Mesh>::Handle normals;
  decimater.add(quadric);
  decimater.add(normals);
  decimater.module(quadric).set_max_err(error * error, false);
  decimater.module(normals).set_normal_deviation(15);
  decimater.initialize();
  decimater.decimate_to(4);
  mesh.garbage_collection();
  PolygonSoup result;
  for (const auto v : mesh.vertices()) result.points.push_back(to_vector3(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    auto v = mesh.cfv_iter(f);
    const Index a = (v++)->idx(), b = (v++)->idx(), c = v->idx();
    result.add_triangle(a, b, c);
  }
  return result;
}

}  // namespace mspskel::detail
