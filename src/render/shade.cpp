#include "shade.h"

#include <algorithm>
#include <cmath>

namespace mspskel::render_detail {
namespace {

using Rgb = Eigen::Vector3f;

Rgb to_rgb(Color c) { return Rgb(c.red, c.green, c.blue) / 255.0f; }
Rgb mix(const Rgb& under, const Rgb& over, float share) { return under + share * (over - under); }

std::array<const Vector3*, 3> projected(const Shading& shading, const View& view, Index triangle) {
  const auto& t = shading.surface.triangles[triangle];
  return {&view.points[t[0]], &view.points[t[1]], &view.points[t[2]]};
}

Rgb albedo(const Shading& shading, Index triangle, const std::array<double, 3>& weight) {
  if (shading.scene.vertex_color.empty()) return to_rgb(shading.options.surface_color);
  Rgb sum = Rgb::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const Index v = shading.surface.triangles[triangle][k];
    sum += static_cast<float>(weight[k]) * to_rgb(shading.scene.vertex_color[v]);
  }
  return sum.cwiseMax(0.0f).cwiseMin(1.0f);
}

// A key light from the upper left, a fill light from the right, and light from all sides.
Rgb lit(const Rgb& base, const Eigen::Vector3f& n, float shine) {
  static const Eigen::Vector3f key = Eigen::Vector3f(-0.45f, 0.6f, 0.66f).normalized();
  static const Eigen::Vector3f fill = Eigen::Vector3f(0.7f, -0.1f, 0.7f).normalized();
  static const Eigen::Vector3f half = (key + Eigen::Vector3f::UnitZ()).normalized();
  const float light = 0.38f + 0.58f * std::max(0.0f, n.dot(key)) + 0.20f * std::max(0.0f, n.dot(fill));
  const float glint = shine * std::pow(std::max(0.0f, n.dot(half)), 40.0f);
  return (base * light + Rgb::Constant(glint)).cwiseMin(1.0f);
}

// How much darker the tube's rim is, so that tubes that cross stand apart.
Rgb tube_color(const View& view, const Band& band, std::size_t s) {
  const Eigen::Vector3f& n = band.tube_normal[s];
  const float rim = std::clamp((n.z() - 0.15f) / 0.45f, 0.35f, 1.0f);
  return lit(to_rgb(view.tubes[band.tube[s]].color) * rim, n, 0.35f * rim);
}

// Is there a step in depth next to the sample, seen from the nearer side? The border of the model counts as
// one.
bool on_outline(const View& view, const Band& band, int x, int row) {
  const std::size_t s = band.index(x, row);
  if (band.triangle[s] == kNone) return false;
  const int d = view.margin;
  const float step = 0.02f * static_cast<float>(band.width);
  const auto depth = [&](int u, int v) {
    const bool off = u < 0 || u >= band.width || v < band.row_begin || v >= band.row_end;
    return off ? band.depth[s] : std::min(band.depth[band.index(u, v)], band.depth[s] + 1e6f);
  };
  return depth(x - d, row) + depth(x + d, row) - 2 * band.depth[s] > step ||
         depth(x, row - d) + depth(x, row + d) - 2 * band.depth[s] > step;
}

bool on_triangle_edge(const Shading& shading, const std::array<const Vector3*, 3>& p, double area,
                      const std::array<double, 3>& weight) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = (p[(k + 1) % 3]->head<2>() - p[(k + 2) % 3]->head<2>()).norm();
    if (weight[k] * std::abs(area) < 0.45 * shading.options.samples * side) return true;
  }
  return false;
}

// Colour and opacity of the nearest face.
struct Layer {
  Rgb color;
  float opacity;
};
Layer nearest_layer(const Shading& shading, const View& view, const Band& band, int x, int row) {
  const std::size_t s = band.index(x, row);
  const Index t = band.triangle[s];
  const auto p = projected(shading, view, t);
  const double area = twice_area(p);
  const auto weight = barycentric(p, area, x + 0.5, row + 0.5);
  Layer layer{lit(albedo(shading, t, weight), band.normal[s], shading.ghost ? 0.0f : 0.06f), 1.0f};
  if (shading.ghost) {
    const auto base = static_cast<float>(shading.options.ghost_opacity);
    layer.opacity = base + (1.0f - base) * 0.45f * rim_of(band.normal[s].z());
  }
  if (shading.options.wireframe && on_triangle_edge(shading, p, area, weight)) {
    layer = {mix(layer.color, Rgb(0.1f, 0.12f, 0.18f), 0.75f), std::max(layer.opacity, 0.5f)};
  }
  return layer;
}

}  // namespace

Rgb shade_sample(const Shading& shading, const View& view, const Band& band, int x, int row) {
  static const Rgb outline_color(0.22f, 0.25f, 0.32f);
  const std::size_t s = band.index(x, row);
  Rgb color = to_rgb(shading.options.background);
  const bool face = band.triangle[s] != kNone, tube = band.tube[s] != kNone;
  if (!face && !tube) return color;
  const bool outline = on_outline(view, band, x, row);
  if (face && shading.ghost) {
    // Faces behind the nearest one, as a veil that is denser where they are edge-on: the far limbs stay
    // visible.
    const float hidden = std::max(0.0f, band.rim[s] - rim_of(band.normal[s].z()));
    const auto base = static_cast<float>(shading.options.ghost_opacity);
    color = mix(color, to_rgb(shading.options.surface_color) * 0.8f, std::min(0.8f, base + 0.5f * hidden));
  }
  const bool covered = face && band.depth[s] < band.tube_depth[s];
  if (tube && covered) color = tube_color(view, band, s);
  if (face) {
    Layer layer = nearest_layer(shading, view, band, x, row);
    if (tube && shading.ghost)
      layer.opacity *= 0.4f + 0.6f * static_cast<float>(shading.options.ghost_opacity);
    if (outline)
      layer = {mix(layer.color, outline_color, 0.8f), shading.ghost ? (tube ? 0.35f : 0.7f) : 1.0f};
    color = mix(color, layer.color, layer.opacity);
  }
  return tube && !covered ? tube_color(view, band, s) : color;
}

}  // namespace mspskel::render_detail
