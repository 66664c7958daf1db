// The scene's surface made ready to draw: triangles with a normal at every corner.
#pragma once

#include <array>
#include <vector>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::render_detail {

struct DrawSurface {
  std::vector<Vector3> points;
  std::vector<std::array<Index, 3>> triangles;
  // Three per triangle, unit. Faces that meet at less than the crease angle are shaded as one smooth surface.
  std::vector<Eigen::Vector3f> corner_normals;
};

// Precondition: points are finite and corners in range.
DrawSurface make_draw_surface(const PolygonSoup& soup);

}  // namespace mspskel::render_detail
