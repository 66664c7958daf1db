#include "page_scene.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>

#include "mspskel/mesh/self_intersection.h"
#include "mspskel/render/render.h"
#include "mspskel/rig/make_rig.h"

namespace mspskel::cli {
namespace {

std::vector<double> in_model_units(const VertexSlices& slices, double unit) {
  std::vector<double> values = slices.perimeter;
  for (std::size_t v = 0; v < values.size(); ++v)
    values[v] = slices.valid[v] ? unit * values[v] : std::numeric_limits<double>::quiet_NaN();
  return values;
}

std::vector<double> errors(const VertexSlices& slices) {
  std::vector<double> values = slices.error;
  for (std::size_t v = 0; v < values.size(); ++v)
    if (!slices.valid[v]) values[v] = std::numeric_limits<double>::quiet_NaN();
  return values;
}

ViewerPlaces vertices_without_slice(const ExtractResult& result) {
  ViewerPlaces places{"no slice bounds the solid here", {}};
  const SurfaceSnapshot& surface = result.surface;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (!result.slices.valid[v] && surface.vertex_halfedge[v] != kNone)
      places.positions.push_back(surface.frame.to_model(surface.position[v]));
  return places;
}

ViewerPlaces faces_without_area(const SurfaceSnapshot& surface) {
  ViewerPlaces places{"faces without area", {}};
  for (Index f = 0; f < surface.face_count(); ++f)
    if (surface.face_normal_times_twice_area(f).isZero(0.0))
      places.positions.push_back(surface.frame.to_model(surface.position[surface.origin[3 * f]]));
  return places;
}

// One place for all faces that hang together.
ViewerPlaces crossings(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                       const Execution& execution) {
  ViewerPlaces places{"the surface crosses itself", {}};
  std::vector<char> waiting(static_cast<std::size_t>(surface.face_count()), 0);
  const std::vector<Index> faces = find_self_intersecting_faces(surface, solid, execution);
  for (const Index f : faces) waiting[f] = 1;
  for (const Index first : faces) {
    if (!waiting[first]) continue;
    places.positions.push_back(surface.frame.to_model(surface.position[surface.origin[3 * first]]));
    std::vector<Index> stack{first};
    waiting[first] = 0;
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index g = surface.twin[h] / 3;
        if (!waiting[g]) continue;
        waiting[g] = 0;
        stack.push_back(g);
      }
    }
  }
  return places;
}

ViewerPlaces parts_without_arc(const std::vector<UncoveredPart>& parts) {
  ViewerPlaces places{"a part has no arc", {}};
  for (const UncoveredPart& part : parts) places.positions.push_back(part.position);
  return places;
}

// The part of a vertex is that of one of its faces.
void add_parts(const SurfaceSnapshot& surface, const Segmentation& parts, ViewerScene& scene) {
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Index h = surface.vertex_halfedge[v];
    scene.part_of_vertex.push_back(h == kNone ? kNone : parts.part_of_face[h / 3]);
  }
  scene.part_of_node = parts.part_of_node;
}

void add_rig(const Rig& rig, ViewerScene& scene) {
  for (const RigJoint& joint : rig.joints) {
    scene.rig.names.push_back(joint.name);
    scene.rig.parents.push_back(joint.parent);
    scene.rig.nodes.push_back(joint.node);
    scene.rig.positions.push_back(joint.position);
  }
  for (const auto& influences : rig.influences)
    for (const Influence& influence : influences) {
      scene.rig.joints.push_back(influence.joint);
      scene.rig.weights.push_back(influence.weight);
    }
}

}  // namespace

bool is_page(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".html" || extension == ".htm";
}

ViewerScene make_page_scene(const std::string& input, const CheckedExtraction& made, const Json& report,
                            const Segmentation* parts, const Rig* rig, const Execution& execution) {
  const ExtractResult& result = made.result;
  const NormalisedFrame& frame = result.surface.frame;
  ViewerScene scene;
  scene.title = input == "-" ? "standard input" : std::filesystem::path(input).filename().string();
  scene.surface = to_polygon_soup(result.surface);
  scene.skeleton = result.skeleton;
  for (const Vector3& x : result.skeleton_mesh.position) scene.skeleton_mesh.push_back(frame.to_model(x));
  scene.msp = in_model_units(result.slices, frame.scale);
  scene.slice_error = errors(result.slices);
  if (std::count(result.slices.refined.begin(), result.slices.refined.end(), 1) > 0) {
    scene.initial_msp = in_model_units(result.initial_slices, frame.scale);
    scene.initial_slice_error = errors(result.initial_slices);
  }
  scene.slice_normal = result.slices.normal;
  if (!result.skeleton.nodes.empty()) {
    add_parts(result.surface,
              parts ? *parts
                    : segment_surface(result.surface, result.skeleton, {},
                                      result.coarse ? &*result.coarse : nullptr, execution.progress),
              scene);
    add_rig(rig ? *rig : make_rig(result.surface, result.skeleton, {}, execution.progress), scene);
  }
  scene.places = {parts_without_arc(made.uncovered), vertices_without_slice(result),
                  faces_without_area(result.surface)};
  if (made.certificate.self_intersecting)
    scene.places.push_back(crossings(result.surface, *result.solid, execution));
  scene.report = report_text(report);
  return scene;
}

}  // namespace mspskel::cli
