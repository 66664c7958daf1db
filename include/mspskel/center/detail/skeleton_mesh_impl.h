#pragma once

#include <memory>
#include <vector>

namespace mspskel {
namespace detail::slice_centre {

struct VertexPoint {
  SkeletalPoint point;
  bool holed = false;
};

// The skeletal point of the slice, with its holes if they are asked for.
inline VertexPoint point_of_slice(const SliceTracer& tracer, const SkeletonMeshOptions& options,
                                  const BoundingVolumeHierarchy* solid, SliceRegion& slice) {
  VertexPoint result;
  flatten_slice(tracer.surface(), slice);
  const auto find_with_holes = [&] {
    result.holed = add_hole_contours(tracer, *solid, slice) > 0;
    if (!result.holed) return;
    SkeletalPointOptions holed = options.point;
    holed.method = options.method_with_holes;
    const Index before = result.point.iterations;
    result.point = find_skeletal_point(slice.region, holed);
    result.point.iterations += before;
  };
  if (options.holes == HoleSearch::kAll && slice.region.valid()) find_with_holes();
  if (result.holed) return result;
  result.point = find_skeletal_point(slice.region, options.point);
  if (options.holes == HoleSearch::kProbe && slice.region.valid() &&
      may_have_holes(slice, *solid, result.point.position))
    find_with_holes();
  return result;
}

// Breadth-first from the vertices that have a point: each layer takes the mean over its neighbours in layers
// before.
inline void fill_in_points(const SurfaceSnapshot& surface, SkeletonMesh& mesh) {
  std::vector<std::uint8_t> known = mesh.valid;
  std::vector<Index> layer, next;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!known[v]) next.push_back(v);
  while (!next.empty()) {
    layer.clear();
    std::vector<Index> rest;
    for (const Index v : next) {
      Vector3 sum = Vector3::Zero();
      Index count = 0;
      for_each_neighbour(surface, v, [&](Index w) {
        if (known[w]) sum += mesh.position[w], ++count;
      });
      if (count > 0) mesh.position[v] = sum / count;
      (count > 0 ? layer : rest).push_back(v);
    }
    if (layer.empty()) return;
    for (const Index v : layer) known[v] = 1;
    next.swap(rest);
  }
}

}  // namespace detail::slice_centre

inline SkeletonMesh make_skeleton_mesh(const SliceTracer& tracer, const VertexSlices& slices,
                                       const SkeletonMeshOptions& options, const Execution& execution) {
  validate(options);
  const SurfaceSnapshot& surface = tracer.surface();
  SkeletonMesh mesh;
  mesh.position = surface.position;
  mesh.perimeter = slices.perimeter;
  mesh.normal = slices.normal;
  mesh.error = slices.error;
  mesh.area = surface.vertex_area;
  mesh.valid = slices.valid;
  std::unique_ptr<BoundingVolumeHierarchy> own;
  if (options.holes != HoleSearch::kIgnore && !options.solid)
    own = std::make_unique<BoundingVolumeHierarchy>(surface);
  const BoundingVolumeHierarchy* solid = options.solid ? options.solid : own.get();

  std::vector<detail::slice_centre::VertexPoint> found(surface.position.size());
  parallel_for(
      surface.vertex_count(), "skeletal points", execution, [] { return SliceRegion(); },
      [&](Index v, SliceRegion& slice) {
        if (!slices.valid[v]) return;
        if (options.point.method == SkeletalPointMethod::kCentre) {
          mesh.position[v] = slices.centre[v];
          found[v].point.stop = SkeletalPointStop::kConverged;
          return;
        }
        slice.plane = {slices.normal[v], slices.normal[v].dot(surface.position[v])};
        slice.through = v;
        if (!slice_contour(tracer, slices, v, slice.contour)) {
          mesh.position[v] = slices.centre[v];
          return;
        }
        found[v] = detail::slice_centre::point_of_slice(tracer, options, solid, slice);
        mesh.position[v] = slice.frame.to_space(found[v].point.position);
      });
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (!slices.valid[v]) {
      ++mesh.without_slice;
      continue;
    }
    ++mesh.stops[static_cast<std::size_t>(found[v].point.stop)];
    mesh.with_holes += found[v].holed ? 1 : 0;
    mesh.iterations += found[v].point.iterations;
  }
  detail::slice_centre::fill_in_points(surface, mesh);
  return mesh;
}

}  // namespace mspskel
