// Apart from the writers, which need no colour map.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mspskel/io/write_mesh.h"
#include "mspskel/render/image.h"

namespace mspskel {

std::vector<VertexColor> color_by_value(const std::vector<double>& values, double low, double high) {
  if (!(low < high)) {
    low = std::numeric_limits<double>::infinity();
    high = -low;
    for (const double x : values) {
      if (!std::isfinite(x)) continue;
      low = std::min(low, x);
      high = std::max(high, x);
    }
  }
  std::vector<VertexColor> colors;
  colors.reserve(values.size());
  for (const double x : values) {
    // Halves, since high - low may overflow. Equal values are all blue.
    const double range = high / 2 - low / 2;
    const Color c = blue_to_red(range > 0 || std::isnan(x) ? (x / 2 - low / 2) / range : 0.0);
    colors.push_back({c.red, c.green, c.blue});
  }
  return colors;
}

}  // namespace mspskel
