// What is given to draw, checked and brought to a size at which no square overflows.
#pragma once

#include "mspskel/render/render.h"

namespace mspskel::render_detail {

// Throws UsageError or MeshError, see render().
void validate_scene(const RenderScene& scene);

// The scene moved and scaled so that its bounding box is about the origin and its longest side is 1.
// Throws MeshError if the scene is too large for its extent to be a number.
struct NormalisedScene {
  RenderScene scene;
  NormalisedFrame frame;
};
NormalisedScene normalise(const RenderScene& scene);

}  // namespace mspskel::render_detail
