// Triangles with half-edges matched and turned consistently: the checks between a soup and a mesh.
#pragma once

#include <vector>

#include "mspskel/mesh/polygon_soup.h"
#include "triangulate.h"

namespace mspskel::detail {

// Half-edges 3f, 3f+1, 3f+2 run round triangle f: half-edge h from corners[h] to corners[next(h)].
struct OrientedSurface {
  std::vector<Index> corners;
  std::vector<Index> twin;
  std::vector<Index> component;  // per triangle
  Index component_count = 0;
  Index reoriented_faces = 0;

  Index face_count() const { return static_cast<Index>(corners.size() / 3); }
  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static Index prev(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
};

// Throws MeshError if the triangles are no closed, manifold, orientable surface.
OrientedSurface orient_surface(Index vertex_count, const Triangulation& triangulation);

// Turns every triangle f with turn[f] over; each component as a whole or not at all.
void turn_faces(OrientedSurface& surface, const std::vector<char>& turn);

}  // namespace mspskel::detail
