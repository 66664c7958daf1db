// From what a band sees to colours.
#pragma once

#include "rasterise.h"

namespace mspskel::render_detail {

// Everything that colours depend on and all bands share.
struct Shading {
  const RenderScene& scene;
  const RenderOptions& options;
  const DrawSurface& surface;
  bool ghost = false;
};

// Colour of the sample (x, row), channels 0 to 1.
Eigen::Vector3f shade_sample(const Shading& shading, const View& view, const Band& band, int x, int row);

}  // namespace mspskel::render_detail
