#include "coarse_parts.h"

#include <algorithm>
#include <array>
#include <limits>

#include "mspskel/base/clones.h"
#include "mspskel/mesh/detail/triangle_queries.h"

namespace mspskel::detail {
namespace {

Triangle triangle_of(const SurfaceSnapshot& s, Index f) {
  return {s.position[s.origin[3 * f]], s.position[s.origin[3 * f + 1]], s.position[s.origin[3 * f + 2]]};
}

// Of the faces round some vertices the one nearest to x.
Index nearest_face(const SurfaceSnapshot& surface, const std::array<Index, 3>& vertices, const Vector3& x) {
  double least = std::numeric_limits<double>::infinity();
  Index nearest = kNone;
  for (int k = 0; k < 3; ++k) {
    if (std::find(vertices.begin(), vertices.begin() + k, vertices[k]) != vertices.begin() + k) continue;
    // Those that have an earlier vertex, too, were measured there.
    const auto is_measured = [&](Index f) {
      for (int i = 0; i < k; ++i)
        for (Index corner = 3 * f; corner < 3 * f + 3; ++corner)
          if (surface.origin[corner] == vertices[i]) return true;
      return false;
    };
    const Index first = surface.vertex_halfedge[vertices[k]];
    Index h = first;
    do {
      const Index f = h / 3;
      h = surface.next_outgoing(h);
      if (is_measured(f)) continue;
      const double square = (closest_on_triangle(x, triangle_of(surface, f)) - x).squaredNorm();
      if (square >= least) continue;
      least = square;
      nearest = f;
    } while (h != first);
  }
  return nearest;
}

}  // namespace

CurveSkeleton on_coarse_surface(const SurfaceSnapshot& surface, const CoarseSurface& coarse,
                                const CurveSkeleton& skeleton) {
  const Index count = coarse.surface.vertex_count();
  std::vector<double> least(count, std::numeric_limits<double>::infinity());
  CurveSkeleton carried{skeleton.nodes, skeleton.edges, std::vector<Index>(count, kNone)};
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Index c = coarse.coarse_vertex[v];
    if (c == kNone) continue;
    const double square = (surface.position[v] - coarse.surface.position[c]).squaredNorm();
    if (square >= least[c]) continue;
    least[c] = square;
    carried.node_of_vertex[c] = skeleton.node_of_vertex[v];
  }
  return carried;
}

MSPSKEL_AVX_CLONES CarriedParts carried_to_input(const SurfaceSnapshot& surface, const CoarseSurface& coarse,
                                                 const std::vector<Index>& part_of_coarse_face) {
  const SurfaceSnapshot& from = coarse.surface;
  // Within a part all faces round a vertex have it, so nothing has to be measured there.
  std::vector<Index> around(from.vertex_count(), kNone);
  std::vector<char> mixed(from.vertex_count(), 0);
  for (Index h = 0; h < from.halfedge_count(); ++h) {
    const Index v = from.origin[h], part = part_of_coarse_face[h / 3];
    if (around[v] == kNone) around[v] = part;
    if (around[v] != part) mixed[v] = 1;
  }
  CarriedParts carried{std::vector<Index>(surface.face_count()), std::vector<char>(surface.face_count(), 0)};
  for (Index f = 0; f < surface.face_count(); ++f) {
    std::array<Index, 3> merged{};
    for (int k = 0; k < 3; ++k) merged[k] = coarse.coarse_vertex[surface.origin[3 * f + k]];
    carried.part_of_face[f] = around[merged[0]];
    if (std::all_of(merged.begin(), merged.end(),
                    [&](Index c) { return !mixed[c] && around[c] == around[merged[0]]; }))
      continue;
    carried.near_border[f] = 1;
    carried.part_of_face[f] = part_of_coarse_face[nearest_face(from, merged, surface.face_centroid(f))];
  }
  return carried;
}

}  // namespace mspskel::detail
