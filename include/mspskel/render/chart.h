// Line and scatter charts, enough for the thesis's distribution charts (figures 3.8, 3.9).
#pragma once

#include <string>
#include <vector>

#include "mspskel/render/image.h"

namespace mspskel {

struct ChartSeries {
  std::string name;       // for the legend; empty: left out
  std::vector<double> x;  // empty: 0, 1, 2, ...
  std::vector<double> y;  // points with a coordinate that is not finite are left out and part the line
  Color color{30, 70, 190};
  bool scatter = false;  // dots instead of a line
};

struct ChartOptions {
  int width = 900;   // pixels, 200 to 8192
  int height = 420;  // pixels, 150 to 8192
  std::string title, x_label, y_label;
  double y_min = 0.0, y_max = 0.0;  // equal: from the data, zero included if it is near
  double line_width = 1.5;          // pixels, 0.5 to 20; dots are three times as wide
};

// Throws UsageError if options do not fit, or a series has x and y of different lengths. No points give empty
// axes.
Image chart(const std::vector<ChartSeries>& series, const ChartOptions& options = {});

}  // namespace mspskel
