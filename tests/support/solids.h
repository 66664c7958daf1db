// Solids with their slices, and samples to make them of.
#pragma once

#include <string>
#include <utility>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"
#include "mspskel/slice/plane_search.h"
#include "mspskel/slice/slice_error.h"
#include "support/meshes.h"

namespace mspskel::test {

struct Solid {
  SurfaceSnapshot surface;
  BoundingVolumeHierarchy hierarchy;
  explicit Solid(SurfaceSnapshot given) : surface(std::move(given)), hierarchy(surface) {}
  explicit Solid(const DefaultMesh& mesh) : Solid(make_snapshot(mesh)) {}

  Vector3 at(const Vector3& x) const { return surface.frame.to_normalised(x); }
  Vector3 model(const Vector3& x) const { return surface.frame.to_model(x); }
  VertexSlices slices() const {
    const SliceTracer tracer(surface);
    VertexSlices result = search_minimum_slice_perimeters(tracer, {});
    compute_slice_errors(tracer, {}, result);
    return result;
  }
  VertexSlices no_slices() const {
    VertexSlices none;
    none.resize(surface.vertex_count());
    return none;
  }
};

inline DefaultMesh sample(const std::string& name, Index vertices, Index count = 0) {
  SampleOptions options;
  options.resolution = vertices;
  if (count > 0) options.count = count;
  return to_mesh(make_sample(name, options));
}

inline BallGraph tripod() {
  BallGraph graph;
  graph.blend = 0.1;
  graph.nodes = {{{0, 0, 0}, 0.5}, {{0, 0, 3}, 0.4}, {{2.6, 0, -1.5}, 0.4}, {{-2.6, 0.2, -1.5}, 0.4}};
  graph.edges = {{0, 1}, {0, 2}, {0, 3}};
  return graph;
}

}  // namespace mspskel::test
