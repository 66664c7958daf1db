// How fine the surfaces have to be for the thinnest limbs of a shape.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "mspskel/base/even_directions.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

struct LimbWidth {
  double half = 0.0;   // 0 where there is no chord
  bool bounds = true;  // whether the solid lies behind the vertex
};

// Half of the limb's width at a vertex. In the middle of the chord inward, a fan of rays across the chord: in
// a tube those along its axis are long and most others are about as long as half the chord, in a plate all
// are long. So the third shortest of eight is the half width of what is thin in two directions.
inline LimbWidth limb_half_width(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                 Index v) {
  const auto chord = inward_chord(surface, solid, v);
  if (!chord) return {0.0, false};
  const Vector3 inward = -surface.normal[v].normalized();
  // Along an edge, so that the rays turn with the model.
  const Vector3 edge = surface.position[surface.target(surface.vertex_halfedge[v])] - surface.position[v];
  Vector3 u = edge - edge.dot(inward) * inward;
  if (!(u.norm() > 0)) u = inward.unitOrthogonal();
  u.normalize();
  const Vector3 w = inward.cross(u), middle = chord->start + 0.5 * chord->length * inward;
  std::array<double, 3> shortest;  // ascending
  shortest.fill(std::numeric_limits<double>::infinity());
  for (const Vector2& d : even_directions(8)) {
    const auto hit = solid.first_hit(middle, d.x() * u + d.y() * w, shortest[2]);
    if (!hit) continue;
    shortest[2] = hit->distance;
    std::sort(shortest.begin(), shortest.end());
  }
  return {std::max(0.5 * chord->length, shortest[2]), chord->at_place};
}

// The second thinnest of a hundred, about: the mean of the logarithms of those round it, since a single one
// moves with noise and with the triangles.
inline double thinnest_of(std::vector<double> widths) {
  constexpr double kFirst = 0.01, kLast = 0.04;
  std::sort(widths.begin(), widths.end());
  const auto count = static_cast<double>(widths.size());
  const auto first = static_cast<std::size_t>(kFirst * count), last = static_cast<std::size_t>(kLast * count);
  double logarithms = 0;
  for (std::size_t i = first; i <= last; ++i) logarithms += std::log(widths[i]);
  return std::exp(logarithms / static_cast<double>(last - first + 1));
}

struct WidthDemand {
  double vertices = 0;  // of a surface whose edges are everywhere 0.85 as long as the limb is wide by half
  double thinnest = 0;  // half width of the thinnest limbs
};

// From places at equal steps of the area. Those below the thinnest of the result, where walls touch, count no
// more than it. About ten vertices go round a tube. A surface that crosses itself all over bounds no limbs
// whose widths would count: where the solid does not lie behind more than a tenth of the places, nothing is
// asked for. Cost: O(vertices) and 600 fans.
inline WidthDemand demand_of_width(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                   const Execution& execution) {
  constexpr int kPlaces = 600;
  constexpr double kEdge = 0.85, kMostAstray = 0.1;
  const double total = std::accumulate(surface.vertex_area.begin(), surface.vertex_area.end(), 0.0);
  std::vector<Index> places;
  double passed = 0;
  int taken = 0;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    passed += surface.vertex_area[v];
    if (passed * kPlaces < total * (taken + 0.5)) continue;
    taken = static_cast<int>(std::floor(passed * kPlaces / total + 0.5));
    places.push_back(v);
  }
  std::vector<LimbWidth> measured(places.size());
  parallel_for(
      static_cast<Index>(places.size()), "coarsening", execution, [] { return 0; },
      [&](Index i, int) { measured[i] = limb_half_width(surface, solid, places[i]); });
  std::vector<double> widths;
  std::size_t astray = 0;
  for (const LimbWidth& width : measured) {
    if (!width.bounds) ++astray;
    if (width.half > 0) widths.push_back(width.half);
  }
  WidthDemand demand;
  if (widths.empty() || static_cast<double>(astray) > kMostAstray * static_cast<double>(places.size()))
    return demand;
  demand.thinnest = thinnest_of(widths);
  double sum = 0;
  for (const double width : widths) sum += 1 / std::pow(std::max(width, demand.thinnest), 2);
  // A vertex stands for two equilateral triangles.
  demand.vertices = total * sum / static_cast<double>(widths.size()) / (0.5 * std::sqrt(3.0) * kEdge * kEdge);
  return demand;
}

// The options for a surface whose limbs are too thin for the number of vertices that they name: more
// vertices, in steps of √2 so that no single place decides, and no feature is noise that is as large as the
// thinnest limbs are wide by half.
inline ExtractOptions following_width(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                      ExtractOptions options) {
  const WidthDemand demand = demand_of_width(surface, solid, options.execution);
  const double least = options.coarsening.vertices;
  const double steps = std::ceil(2 * std::log2(demand.vertices / least));
  if (!(steps > 0)) return options;
  const double wanted = std::min<double>(least * std::pow(2, 0.5 * steps), surface.vertex_count());
  options.coarsening.vertices = static_cast<Index>(std::lround(wanted));
  options.limb_vertices = std::max(options.limb_vertices, options.coarsening.vertices);
  LimbOptions& limbs = options.refinement.limbs;
  limbs.smallest = std::min(limbs.smallest, demand.thinnest);
  return options;
}

}  // namespace detail
}  // namespace mspskel
