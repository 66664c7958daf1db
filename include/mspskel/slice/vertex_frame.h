// The local frame in which the planes through a vertex are counted.
#pragma once

#include <cmath>

#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// Orthonormal and right-handed. The zero direction of angles comes from the mesh's geometry, never from world
// axes or storage order, so the planes turn with the model.
struct VertexFrame {
  Vector3 normal;  // n_p
  Vector3 u;       // the longest edge at p, projected across n_p
  Vector3 v;       // n_p x u
};

// Cost: O(valence). Where every edge at p is parallel to n_p (a degenerate fan) any direction across n_p
// serves.
inline VertexFrame make_vertex_frame(const SurfaceSnapshot& surface, Index p) {
  VertexFrame frame;
  frame.normal = surface.normal[p];
  Vector3 longest = Vector3::Zero();
  double best = -1;
  const Index first = surface.vertex_halfedge[p];
  Index h = first;
  do {
    const Vector3 edge = surface.position[surface.target(h)] - surface.position[p];
    // Of edges equal up to rounding the first: the one that does not depend on how the surface lies.
    if (edge.squaredNorm() > best * (1 + 1e-9)) {
      best = edge.squaredNorm();
      longest = edge;
    }
    h = surface.next_outgoing(h);
  } while (h != first);
  const Vector3 across = longest - longest.dot(frame.normal) * frame.normal;
  frame.u =
      across.squaredNorm() > 1e-24 * best ? Vector3(across.normalized()) : frame.normal.unitOrthogonal();
  frame.v = frame.normal.cross(frame.u);
  return frame;
}

// Normal of the plane at angle theta among those that contain the line p + s·axis (Eq. 3.1); u, v span the
// plane across the axis.
inline Vector3 plane_normal(const Vector3& u, const Vector3& v, double theta) {
  return std::cos(theta) * u + std::sin(theta) * v;
}

}  // namespace mspskel
