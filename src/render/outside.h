#pragma once

#include <vector>

#include "mspskel/render/render.h"
#include "surface.h"

namespace mspskel::render_detail {

// For every point: is it inside the solid that the surface bounds? All are if there are no faces.
std::vector<bool> inside_solid(const DrawSurface& surface, const std::vector<Vector3>& points);

// As the public function, for a surface made ready before. Precondition: the skeleton's edges are in range.
std::vector<SkeletonPiece> outside_pieces(const RenderScene& scene, const DrawSurface& surface);

}  // namespace mspskel::render_detail
