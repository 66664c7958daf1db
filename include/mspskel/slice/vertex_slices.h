// One slice a vertex: what the slice stages fill in and every later stage reads.
#pragma once

#include <cstdint>
#include <vector>

#include "mspskel/base/types.h"
#include "mspskel/slice/trace_contour.h"

namespace mspskel {

// Structure of arrays, one entry a vertex, lengths in the normalised frame. A vertex without any valid slice
// has valid = 0, perimeter 0, normal and centre zero, error 1: weight 0 wherever slices are averaged.
struct VertexSlices {
  std::vector<double> perimeter;      // MSP(v)
  std::vector<Vector3> normal;        // N_S(v), unit, of either sign
  std::vector<Index> start;           // half-edge on which the contour's walk starts
  std::vector<Vector3> centre;        // of the contour, by arc length; filled in with the errors
  std::vector<double> area;           // that the contour encloses; filled in with the errors
  std::vector<double> half_width;     // of the region in the contour, see detail/region_moments.h; as above
  std::vector<double> error;          // E_s(v), normalised to [0, 1] (Eq. 3.2, 4.3)
  std::vector<Index> contour_points;  // crossings on the contour; filled in with the errors
  std::vector<std::uint8_t> valid;
  std::vector<std::uint8_t> refined;  // the cone refinement looked for a better slice here

  // Work done, summed over vertices: planes tried, edges crossed.
  std::int64_t slices = 0;
  std::int64_t steps = 0;

  void resize(Index n) {
    perimeter.assign(n, 0.0);
    normal.assign(n, Vector3::Zero());
    start.assign(n, kNone);
    centre.assign(n, Vector3::Zero());
    area.assign(n, 0.0);
    half_width.assign(n, 0.0);
    error.assign(n, 1.0);
    contour_points.assign(n, 0);
    valid.assign(n, 0);
    refined.assign(n, 0);
  }
};

// The entries of `source` in the order of `index`; kNone gives `missing`.
template <class Value>
std::vector<Value> carried_over(const std::vector<Value>& source, const std::vector<Index>& index,
                                const Value& missing) {
  std::vector<Value> values;
  values.reserve(index.size());
  for (const Index i : index) values.push_back(i == kNone ? missing : source[i]);
  return values;
}

// The slices of a coarser surface for every vertex of the finer one that merged into one of its vertices. The
// finer surface does not know their contours: no start.
inline VertexSlices carried_over(const VertexSlices& coarse, const std::vector<Index>& coarse_vertex) {
  VertexSlices s;
  s.perimeter = carried_over(coarse.perimeter, coarse_vertex, 0.0);
  s.normal = carried_over(coarse.normal, coarse_vertex, Vector3(Vector3::Zero()));
  s.start.assign(coarse_vertex.size(), kNone);
  s.centre = carried_over(coarse.centre, coarse_vertex, Vector3(Vector3::Zero()));
  s.area = carried_over(coarse.area, coarse_vertex, 0.0);
  s.half_width = carried_over(coarse.half_width, coarse_vertex, 0.0);
  s.error = carried_over(coarse.error, coarse_vertex, 1.0);
  s.contour_points = carried_over(coarse.contour_points, coarse_vertex, Index{0});
  s.valid = carried_over(coarse.valid, coarse_vertex, std::uint8_t{0});
  s.refined = carried_over(coarse.refined, coarse_vertex, std::uint8_t{0});
  s.slices = coarse.slices;
  s.steps = coarse.steps;
  return s;
}

// The contour of v's slice, on the surface that was sliced; false if v has none. Cost: one trace.
inline bool slice_contour(const SliceTracer& tracer, const VertexSlices& slices, Index v, Contour& contour) {
  if (!slices.valid[v]) return false;
  const Vector3& n = slices.normal[v];
  if (slices.start[v] == kNone) {
    std::int64_t steps = 0;
    return tracer.shortest_contour(v, n, contour, steps);
  }
  tracer.trace(slices.start[v], Plane{n, n.dot(tracer.surface().position[v])}, v, contour);
  return true;
}

}  // namespace mspskel
