#pragma once

#include <array>
#include <memory>
#include <vector>

#include "mspskel/base/even_directions.h"
#include "mspskel/base/linkage.h"
#include "mspskel/mesh/component_areas.h"

namespace mspskel {
namespace detail::slice_centre {

constexpr int kProbeRays = 8;

struct VertexPoint {
  SkeletalPoint point;
  bool holed = false;
  Index hole_points = 0;  // on the contours of all holes
};

// Asks the slices of a mesh for their skeletal points.
class SlicePoints {
 public:
  SlicePoints(const SliceTracer& tracer, const VertexSlices& slices, const SkeletonMeshOptions& options)
      : tracer_(tracer), slices_(slices), options_(options) {
    if (options.holes == HoleSearch::kIgnore) return;
    of_a_handle_ = areas_per_handle(tracer.surface());
    if (!options.solid) own_ = std::make_unique<BoundingVolumeHierarchy>(tracer.surface());
    solid_ = options.solid ? options.solid : own_.get();
  }

  // v's slice and its region, without holes; false if there is no contour.
  bool load(Index v, SliceRegion& slice) const {
    slice.plane = {slices_.normal[v], slices_.normal[v].dot(tracer_.surface().position[v])};
    slice.through = v;
    if (!slice_contour(tracer_, slices_, v, slice.contour)) return false;
    flatten_slice(tracer_.surface(), slice);
    return true;
  }

  // The skeletal point, with the holes that are seen at the first glance.
  VertexPoint find(SliceRegion& slice) const {
    constexpr int kGlance = 2;  // rays
    VertexPoint result;
    if (options_.holes == HoleSearch::kAll && slice.region.valid() && find_with_holes(slice, result))
      return result;
    result.point = find_skeletal_point(slice.region, options_.point);
    if (options_.holes == HoleSearch::kProbe) probe(slice, kGlance, result);
    return result;
  }

  // Looks for holes from the point found without any, which gives way to another if there are some.
  void probe(SliceRegion& slice, int rays, VertexPoint& result) const {
    if (!slice.region.valid() || !may_have_holes(slice, *solid_, result.point.position, rays)) return;
    if (!is_of_sponge(slice.through) || !find_in_sight(slice, result)) find_with_holes(slice, result);
  }

 private:
  bool is_of_sponge(Index v) const {
    return slices_.half_width[v] * slices_.half_width[v] > of_a_handle_[tracer_.surface().component[v]];
  }

  // The point of what is seen of the slice's region from the middle of the chord at its vertex. In a sponge
  // the region goes on and on round its holes, and as many of them as its size is squared would be looked
  // for. False where there is no such chord, the point is not seen from it, or the method asks for more than
  // what is near.
  bool find_in_sight(const SliceRegion& slice, VertexPoint& result) const {
    constexpr int kRays = 16;
    constexpr double kSkin = 1e-9;  // perimeters
    if (options_.method_with_holes != SkeletalPointMethod::kNearestValley) return false;
    const double unit = slice.region.perimeter();
    const PlanarRegion::Sample sample = slice.region.sample(0, 1).front();
    const Vector2 from = sample.point + kSkin * unit * sample.inward;
    const auto in_space = [&](const Vector2& d) { return d.x() * slice.frame.u + d.y() * slice.frame.v; };
    const Vector3 inward = in_space(sample.inward);
    const auto opposite = solid_->first_hit(slice.frame.to_space(from), inward, unit);
    if (!opposite) return false;
    const Vector2 middle = from + 0.5 * opposite->distance * sample.inward;
    const Vector2 back = -sample.inward, aside = turn_left(back);  // so that the vertex is seen first
    std::array<double, kRays> distance;
    solid_->ray_fan(slice.frame.to_space(middle), in_space(back), in_space(aside), kRays, distance.data());
    std::vector<Vector2> seen;
    const std::vector<Vector2>& direction = even_directions(kRays);
    for (int k = 0; k < kRays; ++k) {
      if (!(distance[k] < unit)) return false;
      seen.push_back(middle + distance[k] * (direction[k].x() * back + direction[k].y() * aside));
    }
    const PlanarRegion sight(seen);
    if (!sight.valid()) return false;
    SkeletalPointOptions nearest = options_.point;
    nearest.method = options_.method_with_holes;
    SkeletalPoint point = find_skeletal_point(sight, nearest);
    // Between two rays there may be a hole.
    if (solid_->segment_crosses(slice.frame.to_space(middle), slice.frame.to_space(point.position)))
      return false;
    point.iterations += result.point.iterations;
    result.point = point;
    result.holed = true;
    return true;
  }

  bool find_with_holes(SliceRegion& slice, VertexPoint& result) const {
    result.holed = add_hole_contours(tracer_, *solid_, slice) > 0;
    if (!result.holed) return false;
    const std::vector<PlanarRegion::Ring>& rings = slice.region.rings();
    for (std::size_t r = 1; r < rings.size(); ++r) result.hole_points += rings[r].points;
    SkeletalPointOptions holed = options_.point;
    holed.method = options_.method_with_holes;
    const Index before = result.point.iterations;
    result.point = find_skeletal_point(slice.region, holed);
    result.point.iterations += before;
    return true;
  }

  const SliceTracer& tracer_;
  const VertexSlices& slices_;
  const SkeletonMeshOptions& options_;
  std::unique_ptr<BoundingVolumeHierarchy> own_;
  const BoundingVolumeHierarchy* solid_ = nullptr;
  std::vector<double> of_a_handle_;  // per component, areas_per_handle
};

// Neighbours of `from` that have a slice and have not been asked; they count as asked after that.
inline std::vector<Index> unasked_neighbours(const SurfaceSnapshot& surface, const std::vector<Index>& from,
                                             std::vector<std::uint8_t>& asked) {
  std::vector<Index> result;
  for (const Index v : from)
    for_each_neighbour(surface, v, [&](Index w) {
      if (asked[w]) return;
      asked[w] = 1;
      result.push_back(w);
    });
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

MSPSKEL_INLINE SkeletonMesh make_skeleton_mesh(const SliceTracer& tracer, const VertexSlices& slices,
                                               const SkeletonMeshOptions& options,
                                               const Execution& execution) {
  validate(options);
  const SurfaceSnapshot& surface = tracer.surface();
  SkeletonMesh mesh;
  mesh.position = surface.position;
  mesh.perimeter = slices.perimeter;
  mesh.normal = slices.normal;
  mesh.error = slices.error;
  mesh.area = surface.vertex_area;
  mesh.valid = slices.valid;
  const detail::slice_centre::SlicePoints points(tracer, slices, options);
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
        if (!points.load(v, slice)) {
          mesh.position[v] = slices.centre[v];
          return;
        }
        found[v] = points.find(slice);
        mesh.position[v] = slice.frame.to_space(found[v].point.position);
      });
  if (options.holes == HoleSearch::kProbe && options.point.method != SkeletalPointMethod::kCentre) {
    std::vector<std::uint8_t> asked(surface.position.size(), 0);
    std::vector<Index> holed;
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      asked[v] = found[v].holed || !slices.valid[v];
      if (found[v].holed) holed.push_back(v);
    }
    while (!holed.empty()) {
      const std::vector<Index> next = detail::slice_centre::unasked_neighbours(surface, holed, asked);
      parallel_for(
          static_cast<Index>(next.size()), "skeletal points", execution, [] { return SliceRegion(); },
          [&](Index i, SliceRegion& slice) {
            const Index v = next[i];
            if (!points.load(v, slice)) return;
            points.probe(slice, detail::slice_centre::kProbeRays, found[v]);
            mesh.position[v] = slice.frame.to_space(found[v].point.position);
          });
      holed.clear();
      for (const Index v : next)
        if (found[v].holed) holed.push_back(v);
    }
  }
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (!slices.valid[v]) {
      ++mesh.without_slice;
      continue;
    }
    ++mesh.stops[static_cast<std::size_t>(found[v].point.stop)];
    mesh.with_holes += found[v].holed ? 1 : 0;
    mesh.hole_points += found[v].hole_points;
    mesh.iterations += found[v].point.iterations;
  }
  detail::slice_centre::fill_in_points(surface, mesh);
  return mesh;
}

}  // namespace mspskel
