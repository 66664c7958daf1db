// Random closed meshes: skins of random graphs, roughened and remeshed at random.
#pragma once

#include <algorithm>
#include <vector>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/mesh/self_intersection.h"
#include "mspskel/samples/skin_graph.h"
#include "support/meshes.h"

namespace mspskel::test {

struct RandomSolidOptions {
  Index most_genus = 6;
  Index least_vertices = 500, most_vertices = 2000;
  double roughness = 0.15;  // largest displacement along the normals, mean edge lengths
};

namespace detail {

struct EditableTraits : DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using EditableMesh = OpenMesh::TriMesh_ArrayKernelT<EditableTraits>;

// A tree that joins each node to the nearest earlier one, and then the shortest chords.
inline BallGraph random_graph(Index loops, Random& random) {
  BallGraph graph;
  const Index count = std::max<Index>(2, loops) + 2 + random.below(4);
  while (static_cast<Index>(graph.nodes.size()) < count) {
    const Vector3 p = 2.2 * random.in_ball();
    const bool far = std::all_of(graph.nodes.begin(), graph.nodes.end(),
                                 [&](const BallNode& node) { return (node.position - p).norm() > 0.85; });
    if (far) graph.nodes.push_back({p, random.uniform(0.17, 0.32)});
  }
  graph.blend = random.uniform(0, 0.15);
  const auto distance = [&](Index i, Index j) {
    return (graph.nodes[i].position - graph.nodes[j].position).norm();
  };
  std::vector<std::pair<Index, Index>> chords;
  for (Index i = 1; i < count; ++i) {
    Index nearest = 0;
    for (Index j = 1; j < i; ++j)
      if (distance(i, j) < distance(i, nearest)) nearest = j;
    graph.edges.emplace_back(nearest, i);
    for (Index j = 0; j < i; ++j)
      if (j != nearest) chords.emplace_back(j, i);
  }
  std::sort(chords.begin(), chords.end(), [&](const auto& a, const auto& b) {
    return distance(a.first, a.second) < distance(b.first, b.second);
  });
  chords.resize(std::min(chords.size(), static_cast<std::size_t>(loops)));
  graph.edges.insert(graph.edges.end(), chords.begin(), chords.end());
  return graph;
}

// Skin area of the graph without what is hidden at the nodes.
inline double skin_area(const BallGraph& graph) {
  double area = 0;
  for (const auto& [i, j] : graph.edges)
    area += kPi * (graph.nodes[i].radius + graph.nodes[j].radius) *
            (graph.nodes[i].position - graph.nodes[j].position).norm();
  return area;
}

inline bool folds(const EditableMesh::Point& before, const EditableMesh::Point& after) {
  return (before | after) < 0.8 * before.norm() * after.norm();
}

// Flips and collapses of random edges where no face turns by more than about 37 degrees.
inline void remesh_at_random(EditableMesh& mesh, Index steps, double collapse_share, Random& random) {
  const auto normal = [](const auto& a, const auto& b, const auto& c) { return (b - a) % (c - a); };
  for (Index step = 0; step < steps; ++step) {
    const OpenMesh::EdgeHandle e(random.below(static_cast<Index>(mesh.n_edges())));
    if (mesh.status(e).deleted()) continue;
    const auto h = mesh.halfedge_handle(e, 0), o = mesh.halfedge_handle(e, 1);
    const auto va = mesh.from_vertex_handle(h), vb = mesh.to_vertex_handle(h);
    const auto a = mesh.point(va), b = mesh.point(vb);
    if (random.uniform() < collapse_share) {
      bool legal = mesh.is_collapse_ok(h);
      for (auto it = mesh.cvoh_iter(va); legal && it.is_valid(); ++it) {
        const auto to = mesh.to_vertex_handle(*it),
                   apex = mesh.to_vertex_handle(mesh.next_halfedge_handle(*it));
        if (to == vb || apex == vb) continue;
        legal =
            !folds(normal(a, mesh.point(to), mesh.point(apex)), normal(b, mesh.point(to), mesh.point(apex)));
      }
      if (legal) mesh.collapse(h);
    } else if (mesh.is_flip_ok(e)) {
      const auto c = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h)));
      const auto d = mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(o)));
      const auto old = normal(a, b, c) + normal(b, a, d);
      if (!folds(old, normal(a, d, c)) && !folds(old, normal(b, c, d)) &&
          !folds(normal(a, b, c), normal(b, a, d)))
        mesh.flip(e);
    }
  }
  mesh.garbage_collection();
}

inline bool intersects_itself(const DefaultMesh& mesh) {
  const SurfaceSnapshot snapshot = make_snapshot(mesh);
  Execution one_thread;
  one_thread.threads = 1;
  return count_self_intersections(snapshot, BoundingVolumeHierarchy(snapshot), 1, one_thread) > 0;
}

template <class Result, class Mesh>
Result copied(const Mesh& mesh) {
  Result result;
  for (const auto v : mesh.vertices()) result.add_vertex(mesh.point(v));
  for (const auto f : mesh.faces()) {
    auto v = mesh.cfv_iter(f);
    const OpenMesh::VertexHandle a = *v++, b = *v++, c = *v;
    result.add_face(a, b, c);
  }
  return result;
}

}  // namespace detail

// A random connected solid without cavities: a closed mesh whose genus is about uniform in [0, most_genus]
// (limbs that touch may add handles; count them by Euler's formula). One mesh in four comes straight from
// marching tetrahedra, slivers and all; the others are even, then roughened, then flipped and thinned at
// random. Self-intersections are rare, not excluded. The same seed gives the same mesh. Cost: 15 ms,
// rarely 50.
inline DefaultMesh random_solid(std::uint64_t seed, const RandomSolidOptions& options = {}) {
  for (Random random(seed);;) {
    const BallGraph graph = detail::random_graph(random.below(options.most_genus + 1), random);
    const ImplicitSolid solid = skin_solid(graph);
    const double area = detail::skin_area(graph);
    const bool raw = random.below(4) == 0;
    const Index vertices =
        options.least_vertices + random.below(options.most_vertices - options.least_vertices + 1);
    // Marching tetrahedra make about 2.6 vertices per squared cell.
    const double cell = std::min(0.29, std::sqrt(2.6 * area / (raw ? vertices : 2 * vertices)));
    PolygonSoup soup = march_tetrahedra(solid, cell);
    if (!raw) soup = remesh(soup, solid, {edge_for_vertices(area, vertices), 3});
    DefaultMesh mesh;
    try {
      mesh = build_mesh(soup);
    } catch (const MeshError&) {  // pinched, where two limbs just touch
      continue;
    }
    if (make_snapshot(mesh).component_count != 1) continue;  // a cavity, or a limb too thin for the cell
    if (raw && static_cast<Index>(mesh.n_vertices()) > options.most_vertices) continue;
    if (raw) return mesh;
    mesh.request_face_normals();
    mesh.request_vertex_normals();
    mesh.update_normals();
    const double reach = options.roughness * random.uniform() * edge_for_vertices(area, vertices);
    for (const auto v : mesh.vertices())
      mesh.set_point(v, mesh.point(v) + reach * random.uniform(-1, 1) * mesh.normal(v));
    auto editable = detail::copied<detail::EditableMesh>(mesh);
    detail::remesh_at_random(editable, random.below(static_cast<Index>(mesh.n_edges())),
                             0.5 * random.uniform(), random);
    mesh = detail::copied<DefaultMesh>(editable);
    if (!detail::intersects_itself(mesh)) return mesh;
  }
}

}  // namespace mspskel::test
