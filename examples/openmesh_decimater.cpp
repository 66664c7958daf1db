// Decimates a sample's skeleton mesh in a stock OpenMesh decimater, with the minimum slice perimeter as
// priority.
//
//   openmesh_decimater [SAMPLE [VERTICES]]
//
// The skeleton mesh is the surface with every vertex moved to the skeletal point of its slice. The module
// drives any OpenMesh decimater over it and keeps the merging sets, so that at the end each vertex that is
// left stands for a patch of the surface. It stays a closed mesh: to get down to a graph is what
// collapse_skeleton_mesh() is for.
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "mspskel/center/skeleton_mesh.h"
#include "mspskel/collapse/mod_msp_skeleton.h"
#include "mspskel/samples/samples.h"
#include "mspskel/slice/minimum_slice_perimeter.h"
#include "mspskel/slice/slice_error.h"

namespace {

using namespace mspskel;

// A decimater deletes elements, so the mesh needs status properties.
DefaultMesh sample_mesh(const std::string& name) {
  const PolygonSoup soup = make_sample(name);
  DefaultMesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  std::vector<DefaultMesh::VertexHandle> vertex;
  for (const Vector3& p : soup.points) vertex.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    std::vector<DefaultMesh::VertexHandle> corners;
    for (Index c = soup.begin[f]; c < soup.begin[f + 1]; ++c) corners.push_back(vertex[soup.corners[c]]);
    mesh.add_face(corners);
  }
  return mesh;
}

// Moves the mesh to its skeleton mesh, and returns what the module needs to know of each vertex, in the
// mesh's units.
std::vector<MergingVertex> move_to_skeleton_mesh(DefaultMesh& mesh) {
  const SurfaceSnapshot surface = make_snapshot(mesh);
  const SliceTracer tracer(surface);
  VertexSlices slices = compute_minimum_slice_perimeters(tracer, SamplingOptions{});
  compute_slice_errors(tracer, {}, slices);
  const SkeletonMesh skeleton = make_skeleton_mesh(tracer, slices);
  const double scale = surface.frame.scale;
  std::vector<MergingVertex> vertices;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vector3 point = surface.frame.to_model(skeleton.position[v]);
    mesh.set_point(DefaultMesh::VertexHandle(v), {point.x(), point.y(), point.z()});
    vertices.push_back({point, skeleton.perimeter[v] * scale, skeleton.normal[v], skeleton.error[v],
                        skeleton.area[v] * scale * scale, skeleton.valid[v] != 0});
  }
  return vertices;
}

void decimate(const std::string& name, std::size_t target) {
  DefaultMesh mesh = sample_mesh(name);
  const std::size_t before = mesh.n_vertices();

  OpenMesh::Decimater::DecimaterT<DefaultMesh> decimater(mesh);
  ModMspSkeletonT<DefaultMesh>::Handle handle;
  decimater.add(handle);
  decimater.module(handle).set_vertices(move_to_skeleton_mesh(mesh));
  decimater.initialize();
  const std::size_t collapses = decimater.decimate_to(target);
  std::printf("%s: %zu vertices, %zu collapses, %zu vertices left\n", name.c_str(), before, collapses,
              before - collapses);

  // The merging sets, before garbage_collection() renumbers the vertices.
  std::vector<Index> size(before, 0);
  for (const Index node : decimater.module(handle).node_of_vertex()) ++size[node];
  std::printf("the largest merging set has %d vertices\n", *std::max_element(size.begin(), size.end()));
  mesh.garbage_collection();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    decimate(argc > 1 ? argv[1] : "torus", argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 60);
    return 0;
  } catch (const mspskel::Error& error) {
    std::fprintf(stderr, "openmesh_decimater: %s\n", error.what());
    return static_cast<int>(error.kind());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "openmesh_decimater: %s\n", error.what());
    return 70;
  }
}
