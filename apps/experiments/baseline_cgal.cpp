#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/extract_mean_curvature_flow_skeleton.h>

#include <algorithm>

#include "baseline.h"

namespace mspskel::experiments {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;
using CgalMesh = CGAL::Surface_mesh<Point>;
using Flow = CGAL::Mean_curvature_flow_skeletonization<CgalMesh>;

CgalMesh to_cgal(const SurfaceSnapshot& surface) {
  CgalMesh mesh;
  std::vector<CgalMesh::Vertex_index> vertex(surface.vertex_count());
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (surface.vertex_halfedge[v] == kNone) continue;
    const Vector3 x = surface.frame.to_model(surface.position[v]);
    vertex[v] = mesh.add_vertex(Point(x.x(), x.y(), x.z()));
  }
  for (Index h = 0; h < surface.halfedge_count(); h += 3)
    mesh.add_face(vertex[surface.origin[h]], vertex[surface.origin[h + 1]], vertex[surface.origin[h + 2]]);
  return mesh;
}

}  // namespace

bool has_baseline() { return true; }

CurveSkeleton baseline_skeleton(const SurfaceSnapshot& surface) {
  CurveSkeleton result;
  if (surface.component_count != 1) return result;
  const CgalMesh mesh = to_cgal(surface);
  Flow::Skeleton skeleton;
  Flow flow(mesh);
  flow.contract_until_convergence();
  flow.convert_to_skeleton(skeleton);
  for (const auto v : CGAL::make_range(vertices(skeleton))) {
    const Point& p = skeleton[v].point;
    result.nodes.emplace_back();
    result.nodes.back().position = Vector3(p.x(), p.y(), p.z());
  }
  for (const auto e : CGAL::make_range(edges(skeleton))) {
    const auto a = static_cast<Index>(source(e, skeleton)), b = static_cast<Index>(target(e, skeleton));
    result.edges.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(result.edges.begin(), result.edges.end());
  return result;
}

}  // namespace mspskel::experiments
