// Closed meshes of shapes with known geometry: every vertex lies on the named surface.
#pragma once

#include <cstdint>
#include <functional>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel {

// How finely a smooth shape is cut into triangles, and how far its vertices stray on the surface.
struct Tessellation {
  double edge = 0.1;  // wanted edge length, model units, > 0
  double irregularity =
      0.15;  // vertices move on the surface by up to this share of an edge, [0, 0.3]; breaks exact ties
  std::uint64_t seed = 1;  // of the irregularity
};

// The edge length at which equilateral triangles of that area have about `vertices` vertices.
double edge_for_vertices(double area, Index vertices);

// All are closed, manifold, oriented outward and free of self-intersections; lengths > 0, or UsageError.
// Cost: linear in the number of vertices.

// Sphere round the origin.
PolygonSoup make_sphere(double radius, const Tessellation& tessellation);

// Cylinder from z = -length/2 to length/2 with half spheres at its ends.
PolygonSoup make_capsule(double radius, double length, const Tessellation& tessellation);

// Cylinder from z = -length/2 to length/2 with flat ends.
PolygonSoup make_tube(double radius, double length, const Tessellation& tessellation);

// Torus round the z axis: the tube's centre circle has radius `major`, the tube `minor` < major.
PolygonSoup make_torus(double major, double minor, const Tessellation& tessellation);

// Right prism over a regular polygon with `sides` >= 3 corners at distance `radius` from the z axis. Every
// corner line is a line of mesh edges, so each slice across has the perimeter 2 · sides · radius · sin(π /
// sides) exactly.
PolygonSoup make_prism(Index sides, double radius, double height, const Tessellation& tessellation);

// Half a spherical shell of the given wall thickness < radius, its rim rounded; opens toward +z.
PolygonSoup make_bowl(double radius, double wall, const Tessellation& tessellation);

// Tube of constant radius round a closed curve, t in [0, 1). Precondition: the radius is below the curve's
// radius of curvature and half the distance between its strands.
PolygonSoup make_closed_tube(const std::function<Vector3(double)>& curve, double radius,
                             const Tessellation& tessellation);

// The 7-vertex torus: 7 vertices, 21 edges, 14 faces, no diagonals, embedded (Császár 1949).
PolygonSoup make_csaszar_torus();

// Appends `other` to `soup` as further components.
void append(PolygonSoup& soup, const PolygonSoup& other);

// Turns and moves every point: x -> turn · x + shift. Precondition: `turn` is a rotation.
PolygonSoup moved(PolygonSoup soup, const Eigen::Matrix3d& turn, const Vector3& shift);

// Models that stand on a floor are built with z upward and handed out with y upward.
PolygonSoup y_upward(PolygonSoup soup);

// Turns the surface inside out: cavities have inward pointing boundaries.
void reverse_orientation(PolygonSoup& soup);

}  // namespace mspskel
