// A closed triangle mesh as flat arrays in a normalised frame: what every stage walks on.
#pragma once

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <cmath>
#include <string>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/types.h"
#include "mspskel/mesh/default_mesh.h"

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

// Copies any OpenMesh triangle mesh. Cost: O(faces).
// Throws MeshError if the mesh is empty, not closed, has a vertex where two fans meet, or a coordinate that
// is not finite.
template <class Mesh>
SurfaceSnapshot make_snapshot(const Mesh& mesh);

}  // namespace mspskel

#include "mspskel/mesh/detail/surface_snapshot_impl.h"
