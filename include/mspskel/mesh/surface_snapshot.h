// A closed triangle mesh as flat arrays in a normalised frame: what every stage walks on.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/types.h"
#include "mspskel/mesh/default_mesh_fwd.h"

namespace mspskel {

// x_model = origin + scale · x_normalised. Moving or scaling the model changes only this frame.
struct NormalisedFrame {
  Vector3 origin = Vector3::Zero();
  double scale = 1.0;

  Vector3 to_model(const Vector3& x) const { return origin + scale * x; }
  Vector3 to_normalised(const Vector3& x) const { return (x - origin) / scale; }
};

// Half-edges 3f, 3f+1, 3f+2 run round face f counter-clockwise as seen from outside, so `next` is arithmetic.
//
//            c = apex(h)
//           / \.
//   prev(h)/ f \next(h)
//         /  h  \.
//        a ----> b        a = origin(h), b = target(h); twin(h) runs from b to a in the other face
//
// Lengths are in the normalised frame: the area-weighted centroid is the origin, the model's extent is 1.
struct SurfaceSnapshot {
  NormalisedFrame frame;
  std::vector<Vector3> position;  // per vertex
  std::vector<Vector3> normal;    // per vertex, unit, outward, weighted by angle
  std::vector<double>
      vertex_area;            // per vertex: a third of the incident face areas; sums to the surface's area
  std::vector<Index> origin;  // per half-edge
  std::vector<Index> twin;    // per half-edge
  std::vector<Index> vertex_halfedge;  // per vertex: one outgoing half-edge; kNone for an isolated vertex
  std::vector<Index> component;        // per vertex: connected component, numbered by first vertex
  Index component_count = 0;

  Index vertex_count() const { return static_cast<Index>(position.size()); }
  Index halfedge_count() const { return static_cast<Index>(origin.size()); }
  Index face_count() const { return halfedge_count() / 3; }

  static Index face(Index h) { return h / 3; }
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
  Index target(Index h) const { return origin[next(h)]; }
  Index apex(Index h) const { return origin[prev(h)]; }
  double edge_length(Index h) const { return (position[target(h)] - position[origin[h]]).norm(); }
  // The outgoing half-edge that follows h counter-clockwise round its origin.
  Index next_outgoing(Index h) const { return twin[prev(h)]; }

  Vector3 face_normal_times_twice_area(Index f) const {
    const Vector3 &a = position[origin[3 * f]], &b = position[origin[3 * f + 1]],
                  &c = position[origin[3 * f + 2]];
    return (b - a).cross(c - a);
  }
  double face_area(Index f) const { return 0.5 * face_normal_times_twice_area(f).norm(); }
  Vector3 face_centroid(Index f) const {
    return (position[origin[3 * f]] + position[origin[3 * f + 1]] + position[origin[3 * f + 2]]) / 3;
  }
};

// Calls visit(w) for the neighbours w of v, in the order of the half-edges round v; none for an isolated
// vertex.
template <class Visit>
void for_each_neighbour(const SurfaceSnapshot& surface, Index v, Visit&& visit) {
  const Index first = surface.vertex_halfedge[v];
  if (first == kNone) return;
  Index h = first;
  do {
    visit(surface.target(h));
    h = surface.next_outgoing(h);
  } while (h != first);
}

// 2V − F of each component, twice its Euler characteristic, since a closed triangle mesh has 3F = 2E: 4 for a
// sphere, 4 less for every handle. O(faces).
std::vector<Index> twice_euler_characteristics(const SurfaceSnapshot& surface);

// The genus of each component. O(faces).
std::vector<Index> handles_of_components(const SurfaceSnapshot& surface);

// Copies any OpenMesh triangle mesh. Cost: O(faces).
// Throws MeshError if the mesh is empty, not closed, has a vertex where two fans meet, or a coordinate that
// is not finite.
template <class Mesh>
SurfaceSnapshot make_snapshot(const Mesh& mesh);

namespace detail {
// Throws MeshError where two fans meet at a vertex.
void check_vertex_fans(const SurfaceSnapshot& surface);
// From the model's positions to the frame and the positions in it. Throws MeshError.
void normalise(SurfaceSnapshot& surface);
// What follows from the half-edges and the normalised positions.
void complete_snapshot(SurfaceSnapshot& surface);
}  // namespace detail

template <class Mesh>
SurfaceSnapshot make_snapshot(const Mesh& mesh) {
  SurfaceSnapshot s;
  if (mesh.n_faces() == 0) throw MeshError("the mesh has no faces");
  if (mesh.n_faces() > static_cast<std::size_t>(700'000'000))
    throw MeshError("the mesh has more than 700 million faces");
  s.position.resize(mesh.n_vertices());
  for (const auto v : mesh.vertices())
    s.position[static_cast<std::size_t>(v.idx())] = to_vector3(mesh.point(v));
  s.origin.resize(3 * mesh.n_faces());
  s.twin.assign(3 * mesh.n_faces(), kNone);
  s.vertex_halfedge.assign(mesh.n_vertices(), kNone);

  std::vector<Index> flat(mesh.n_halfedges(), kNone);  // OpenMesh half-edge -> flat half-edge
  for (const auto f : mesh.faces()) {
    Index h = 3 * static_cast<Index>(f.idx());
    for (auto it = mesh.cfh_iter(f); it.is_valid(); ++it, ++h) {
      flat[static_cast<std::size_t>(it->idx())] = h;
      s.origin[h] = static_cast<Index>(mesh.from_vertex_handle(*it).idx());
      if (s.vertex_halfedge[s.origin[h]] == kNone) s.vertex_halfedge[s.origin[h]] = h;
    }
  }
  for (const auto e : mesh.edges()) {
    const auto h0 = mesh.halfedge_handle(e, 0), h1 = mesh.halfedge_handle(e, 1);
    const Index a = flat[static_cast<std::size_t>(h0.idx())], b = flat[static_cast<std::size_t>(h1.idx())];
    if (a == kNone || b == kNone)
      throw MeshError("the mesh is not closed: edge " + std::to_string(mesh.from_vertex_handle(h0).idx()) +
                      "-" + std::to_string(mesh.to_vertex_handle(h0).idx()) + " has fewer than two faces");
    s.twin[a] = b;
    s.twin[b] = a;
  }
  detail::check_vertex_fans(s);
  detail::normalise(s);
  detail::complete_snapshot(s);
  return s;
}

}  // namespace mspskel

#ifdef MSPSKEL_COMPILED
namespace mspskel {
extern template SurfaceSnapshot make_snapshot<DefaultMesh>(const DefaultMesh&);
}
#else
#include "mspskel/mesh/detail/surface_snapshot_impl.h"
#endif
