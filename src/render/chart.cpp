#include "mspskel/render/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "mspskel/base/error.h"
#include "mspskel/render/text.h"

namespace mspskel {
namespace {

constexpr Color kGrid{225, 228, 233}, kInk{40, 44, 52};
constexpr int kText = 2, kGlyphHeight = 7 * kText;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return high - low; }
};

struct Plot {
  int left, top, right, bottom;  // pixels of the frame
  Range x, y;
  double column(double value) const { return left + (value - x.low) / x.size() * (right - left); }
  double row(double value) const { return bottom - (value - y.low) / y.size() * (bottom - top); }
};

double x_of(const ChartSeries& series, std::size_t i) {
  return series.x.empty() ? static_cast<double>(i) : series.x[i];
}
bool finite_point(const ChartSeries& series, std::size_t i) {
  return std::isfinite(x_of(series, i)) && std::isfinite(series.y[i]);
}

// 1, 2 or 5 times a power of ten, for about `count` steps.
double nice_step(double size, int count) {
  const double raw = size / count, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

std::string number(double value, double step) {
  if (std::abs(value) < 1e-9 * step) value = 0.0;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", std::round(value / step * 1e6) * 1e-6 * step);
  return text.data();
}

void widen_if_flat(Range& range) {
  if (!(range.low <= range.high)) range = {0.0, 1.0};
  if (range.size() <= 1e-12 * std::max(std::abs(range.low), std::abs(range.high))) {
    const double pad = range.high == 0.0 ? 1.0 : 0.5 * std::abs(range.high);
    range = {range.low - pad, range.high + pad};
  }
}

void set_ranges(const std::vector<ChartSeries>& series, const ChartOptions& options, Plot& plot) {
  for (const ChartSeries& s : series) {
    for (std::size_t i = 0; i < s.y.size(); ++i) {
      if (!finite_point(s, i)) continue;
      plot.x.add(x_of(s, i));
      plot.y.add(s.y[i]);
    }
  }
  widen_if_flat(plot.x);
  widen_if_flat(plot.y);
  if (plot.y.low > 0 && plot.y.low < 0.4 * plot.y.high) plot.y.low = 0;
  const double step = nice_step(plot.y.size(), 6);
  plot.y = {std::floor(plot.y.low / step) * step, std::ceil(plot.y.high / step) * step};
  if (options.y_min < options.y_max) plot.y = {options.y_min, options.y_max};
}

// A straight stroke with round ends, cut to the frame; begin = end gives a dot.
void stroke(Image& image, const Plot& plot, std::array<double, 2> a, std::array<double, 2> b, double width,
            Color color) {
  const double r = 0.5 * width + 0.5, dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const auto pixel = [](double v, int low, int high) {
    return static_cast<int>(std::clamp<double>(v, low, high));
  };
  const int y1 = pixel(std::max(a[1], b[1]) + r + 1, plot.top, plot.bottom);
  for (int y = pixel(std::min(a[1], b[1]) - r - 1, plot.top, plot.bottom); y <= y1; ++y) {
    // Only the part of the stroke near this row: a long steep line touches few pixels of its box.
    double t0 = 0.0, t1 = 1.0;
    if (std::abs(dy) > 1e-9) {
      const double u = (y + 0.5 - r - a[1]) / dy, v = (y + 0.5 + r - a[1]) / dy;
      t0 = std::clamp(std::min(u, v), 0.0, 1.0);
      t1 = std::clamp(std::max(u, v), 0.0, 1.0);
    }
    const double xa = a[0] + t0 * dx, xb = a[0] + t1 * dx;
    const int x1 = pixel(std::max(xa, xb) + r + 1, plot.left, plot.right);
    for (int x = pixel(std::min(xa, xb) - r - 1, plot.left, plot.right); x <= x1; ++x) {
      const double px = x + 0.5 - a[0], py = y + 0.5 - a[1];
      const double t = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0.0;
      const double cover = std::clamp(r - std::hypot(px - t * dx, py - t * dy), 0.0, 1.0);
      if (cover > 0) image.set(x, y, blend(image.at(x, y), color, cover));
    }
  }
}

void fill(Image& image, int x0, int y0, int x1, int y1, Color color) {
  for (int y = std::max(y0, 0); y <= std::min(y1, image.height - 1); ++y) {
    for (int x = std::max(x0, 0); x <= std::min(x1, image.width - 1); ++x) image.set(x, y, color);
  }
}

void draw_axes(Image& image, const Plot& plot, const ChartOptions& options) {
  const TextStyle style{kText, kInk, false};
  const double ystep = nice_step(plot.y.size(), std::max(2, (plot.bottom - plot.top) / 50));
  for (double v = std::ceil(plot.y.low / ystep - 1e-9) * ystep; v <= plot.y.high + 1e-9 * ystep; v += ystep) {
    const int y = static_cast<int>(std::lround(plot.row(v)));
    fill(image, plot.left, y, plot.right, y, kGrid);
    const std::string text = number(v, ystep);
    draw_text(image, plot.left - 6 - text_length(text, kText), y - kGlyphHeight / 2, text, style);
  }
  const double xstep = nice_step(plot.x.size(), std::max(2, (plot.right - plot.left) / 110));
  for (double v = std::ceil(plot.x.low / xstep - 1e-9) * xstep; v <= plot.x.high + 1e-9 * xstep; v += xstep) {
    const int x = static_cast<int>(std::lround(plot.column(v)));
    fill(image, x, plot.top, x, plot.bottom, kGrid);
    const std::string text = number(v, xstep);
    const int length = text_length(text, kText);
    draw_text(image, std::min(x - length / 2, image.width - length - 2), plot.bottom + 7, text, style);
  }
  fill(image, plot.left, plot.bottom, plot.right, plot.bottom, kInk);
  fill(image, plot.left, plot.top, plot.left, plot.bottom, kInk);
  const auto middle = [](int low, int high, const std::string& text) {
    return (low + high - text_length(text, kText)) / 2;
  };
  draw_text(image, middle(0, image.width, options.title), 8, options.title, style);
  draw_text(image, middle(plot.left, plot.right, options.x_label), image.height - kGlyphHeight - 8,
            options.x_label, style);
  draw_text(image, 6, middle(plot.top, plot.bottom, options.y_label), options.y_label, {kText, kInk, true});
}

void draw_series(Image& image, const Plot& plot, const ChartSeries& series, const ChartOptions& options) {
  const auto at = [&](std::size_t i) {
    return std::array<double, 2>{plot.column(x_of(series, i)) + 0.5, plot.row(series.y[i]) + 0.5};
  };
  for (std::size_t i = 0; i < series.y.size(); ++i) {
    if (!finite_point(series, i)) continue;
    if (series.scatter) {
      stroke(image, plot, at(i), at(i), 3 * options.line_width, series.color);
    } else if (i > 0 && finite_point(series, i - 1)) {
      stroke(image, plot, at(i - 1), at(i), options.line_width, series.color);
    } else if (i + 1 == series.y.size() || !finite_point(series, i + 1)) {
      stroke(image, plot, at(i), at(i), options.line_width, series.color);
    }
  }
}

void draw_legend(Image& image, const Plot& plot, const std::vector<ChartSeries>& series) {
  int row = plot.top + 6;
  for (const ChartSeries& s : series) {
    if (s.name.empty()) continue;
    const int x = plot.right - 8 - text_length(s.name, kText);
    fill(image, x - 30, row - 3, plot.right - 2, row + kGlyphHeight + 2, kWhite);
    fill(image, x - 26, row + kGlyphHeight / 2 - 2, x - 8, row + kGlyphHeight / 2 + 1, s.color);
    draw_text(image, x, row, s.name, {kText, kInk, false});
    row += kGlyphHeight + 6;
  }
}

void validate_chart(const std::vector<ChartSeries>& series, const ChartOptions& options) {
  if (options.width < 200 || options.width > 8192) throw UsageError("chart option width must be 200 to 8192");
  if (options.height < 150 || options.height > 8192)
    throw UsageError("chart option height must be 150 to 8192");
  if (!(options.line_width >= 0.5 && options.line_width <= 20)) {
    throw UsageError("chart option line_width must be 0.5 to 20");
  }
  if (!std::isfinite(options.y_min) || !std::isfinite(options.y_max) || options.y_min > options.y_max) {
    throw UsageError("chart options y_min and y_max must be finite and in order");
  }
  for (const ChartSeries& s : series) {
    if (!s.x.empty() && s.x.size() != s.y.size()) {
      throw UsageError("chart series '" + s.name + "' has " + std::to_string(s.x.size()) + " x for " +
                       std::to_string(s.y.size()) + " y");
    }
  }
}

}  // namespace

Image chart(const std::vector<ChartSeries>& series, const ChartOptions& options) {
  validate_chart(series, options);
  Image image(options.width, options.height);
  Plot plot{options.y_label.empty() ? 90 : 112,
            options.title.empty() ? 20 : 36,
            options.width - 24,
            options.height - (options.x_label.empty() ? 34 : 60),
            {},
            {}};
  set_ranges(series, options, plot);
  draw_axes(image, plot, options);
  for (const ChartSeries& s : series) draw_series(image, plot, s, options);
  draw_legend(image, plot, series);
  return image;
}

}  // namespace mspskel
