// The models that the benchmarks run on.
#pragma once

#include <string>
#include <vector>

#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel::bench {

struct Model {
  std::string name;
  std::string bytes;  // of its OFF file
  PolygonSoup soup;
  SurfaceSnapshot surface;
};

// Two samples, then horse, hand and armadillo as far as they are in the folder models/ of the environment's
// MSPSKEL_MESHES or of ../shared/meshes beside the sources. Loaded once.
const std::vector<Model>& models();

}  // namespace mspskel::bench
