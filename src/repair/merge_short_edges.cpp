#include "merge_short_edges.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "../mesh/edge_table.h"
#include "mspskel/mesh/detail/collapsing_surface.h"

namespace mspskel::detail {
namespace {

SurfaceSnapshot snapshot_of(const PolygonSoup& soup) {
  SurfaceSnapshot surface;
  surface.position = soup.points;
  surface.origin = soup.corners;
  surface.twin.assign(soup.corners.size(), kNone);
  surface.vertex_halfedge.assign(soup.points.size(), kNone);
  for (Index h = 0; h < surface.halfedge_count(); ++h) surface.vertex_halfedge[surface.origin[h]] = h;
  const EdgeTable edges(surface.vertex_count(), surface.origin);
  edges.each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd*) {
    surface.twin[first[0].halfedge] = first[1].halfedge;
    surface.twin[first[1].halfedge] = first[0].halfedge;
  });
  normalise(surface);
  complete_snapshot(surface);
  return surface;
}

}  // namespace

PolygonSoup without_short_edges(const PolygonSoup& soup, double length, Watch& watch) {
  watch.ask();
  const SurfaceSnapshot surface = snapshot_of(soup);
  watch.ask();
  CoarseningOptions options;
  options.component_vertices = 4;
  options.least_shape = 0;  // what is cut into slivers keeps some until the last short edge is merged
  CollapsingSurface mesh(surface, options);
  std::vector<std::pair<double, Index>> edges;
  const double longest = length / surface.frame.scale;
  for (Index last = kNone; last != mesh.vertex_count();) {
    last = mesh.vertex_count();
    edges.clear();
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
      if (mesh.is_edge(h) && mesh.edge_length(h) < longest) edges.emplace_back(mesh.edge_length(h), h);
    std::sort(edges.begin(), edges.end());
    watch.ask();
    mesh.start_pass();
    for (const auto& [shortest, h] : edges) {
      watch.step();
      if (mesh.is_edge(h) && !mesh.moved(h)) mesh.collapse(h);
    }
    if (mesh.sparse()) mesh.compact();
  }
  watch.ask();
  CoarseSurface merged;
  mesh.finish(merged);
  PolygonSoup result;
  for (const Vector3& p : merged.surface.position) result.points.push_back(surface.frame.to_model(p));
  result.corners = std::move(merged.surface.origin);
  for (std::size_t end = 3; end <= result.corners.size(); end += 3)
    result.begin.push_back(static_cast<Index>(end));
  return result;
}

}  // namespace mspskel::detail
