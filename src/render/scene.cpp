#include "scene.h"

#include <cmath>
#include <string>

namespace mspskel::render_detail {
namespace {

void validate_skeleton(const CurveSkeleton& skeleton) {
  const auto node_count = static_cast<Index>(skeleton.nodes.size());
  for (Index i = 0; i < node_count; ++i) {
    if (!skeleton.nodes[i].position.allFinite()) {
      throw MeshError("skeleton node " + std::to_string(i) + " is not finite");
    }
  }
  for (const auto& edge : skeleton.edges) {
    for (const Index node : edge) {
      if (node < 0 || node >= node_count) {
        throw MeshError("a skeleton edge has the node " + std::to_string(node) + ", but there are " +
                        std::to_string(node_count) + " nodes");
      }
    }
  }
}

void validate_surface(const PolygonSoup& surface) {
  const auto count = static_cast<Index>(surface.points.size());
  for (Index v = 0; v < count; ++v) {
    if (!surface.points[v].allFinite()) throw MeshError("vertex " + std::to_string(v) + " is not finite");
  }
  for (std::size_t f = 0; f < surface.polygon_count(); ++f) {
    for (Index i = surface.begin[f]; i < surface.begin[f + 1]; ++i) {
      if (surface.corners[i] < 0 || surface.corners[i] >= count) {
        throw MeshError("face " + std::to_string(f) + " has the corner " +
                        std::to_string(surface.corners[i]) + ", but there are " + std::to_string(count) +
                        " vertices");
      }
    }
  }
}

template <class Visit>
void for_each_point(RenderScene& scene, Visit visit) {
  for (Vector3& p : scene.surface.points) visit(p);
  for (SkeletonNode& node : scene.skeleton.nodes) visit(node.position);
  for (Polyline& line : scene.lines) {
    for (Vector3& p : line.points) visit(p);
  }
}

}  // namespace

void validate_scene(const RenderScene& scene) {
  if (!scene.vertex_color.empty() && scene.vertex_color.size() != scene.surface.points.size()) {
    throw UsageError("render: " + std::to_string(scene.vertex_color.size()) + " vertex colours for " +
                     std::to_string(scene.surface.points.size()) + " vertices");
  }
  validate_surface(scene.surface);
  validate_skeleton(scene.skeleton);
  bool empty = scene.surface.points.empty() && scene.skeleton.nodes.empty();
  for (const Polyline& line : scene.lines) {
    for (const Vector3& p : line.points) {
      if (!p.allFinite()) throw MeshError("a line of the scene has a point that is not finite");
      empty = false;
    }
  }
  if (empty) throw UsageError("render: the scene is empty");
}

NormalisedScene normalise(const RenderScene& scene) {
  NormalisedScene result{scene, {}};
  Eigen::AlignedBox3d box;
  for_each_point(result.scene, [&](Vector3& p) { box.extend(p); });
  const double extent = box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
  if (!std::isfinite(extent)) throw MeshError("the coordinates are too large to be drawn");
  if (!box.isEmpty()) result.frame.origin = box.min() + 0.5 * box.sizes();
  if (extent > 1e-300) result.frame.scale = extent;
  for_each_point(result.scene, [&](Vector3& p) { p = result.frame.to_normalised(p); });
  return result;
}

}  // namespace mspskel::render_detail
