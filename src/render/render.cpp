#include "mspskel/render/render.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "outside.h"
#include "scene.h"
#include "shade.h"

namespace mspskel {
namespace {

using namespace render_detail;

void require_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  const auto text = [](double x) {
    const std::string s = std::to_string(x);
    return s.substr(0, s.find_last_not_of(".0") == std::string::npos ? 1 : s.find('.') + 3);
  };
  throw UsageError(std::string("render option ") + name + " is " + text(value) + ", but must be " +
                   text(low) + " to " + text(high));
}

std::vector<Vector3> points_beside_surface(const RenderScene& scene) {
  std::vector<Vector3> points;
  for (const SkeletonNode& node : scene.skeleton.nodes) points.push_back(node.position);
  for (const Polyline& line : scene.lines)
    points.insert(points.end(), line.points.begin(), line.points.end());
  return points;
}

void add_skeleton(const RenderScene& scene, const RenderOptions& options,
                  const std::vector<SkeletonPiece>& pieces, const std::vector<bool>& node_inside,
                  View& view) {
  const double radius = 0.5 * options.line_width * options.samples;
  for (std::size_t i = 0; i < pieces.size();) {
    std::size_t last = i;  // of a run of pieces of one edge and one colour: one tube without seams
    while (last + 1 < pieces.size() && pieces[last + 1].edge == pieces[i].edge &&
           pieces[last + 1].outside == pieces[i].outside) {
      ++last;
    }
    view.tubes.push_back({view.camera.project(pieces[i].begin), view.camera.project(pieces[last].end), radius,
                          pieces[i].outside ? options.outside_color : options.edge_color});
    i = last + 1;
  }
  const auto neighbours = adjacency(scene.skeleton);
  for (std::size_t i = 0; i < scene.skeleton.nodes.size(); ++i) {
    const std::size_t degree = neighbours[i].size();
    if (degree == 2) continue;
    const Vector3 at = view.camera.project(scene.skeleton.nodes[i].position);
    const Color color = !node_inside[i] ? options.outside_color
                        : degree > 2    ? options.joint_color
                                        : options.leaf_color;
    view.tubes.push_back({at, at, (degree > 2 ? 2.1 : 2.3) * radius, color});
  }
}

void add_lines(const RenderScene& scene, const RenderOptions& options, View& view) {
  const double radius = 0.3 * options.line_width * options.samples;
  for (const Polyline& line : scene.lines) {
    for (std::size_t i = 0; i + 1 < line.points.size() + (line.closed ? 1 : 0); ++i) {
      view.tubes.push_back({view.camera.project(line.points[i]),
                            view.camera.project(line.points[(i + 1) % line.points.size()]), radius,
                            line.color});
    }
  }
}

// Draws rows [begin, end) of pixels of one view; cell: its top left pixel in the image.
void draw_band(const Shading& shading, const View& view, int number, int begin, int end,
               std::array<int, 2> cell, Band& band, Image& image) {
  const int n = shading.options.samples;
  band.clear(n * shading.options.width, n * begin - view.margin, n * end + view.margin);
  draw_triangles(shading.surface, view, number, band);
  draw_tubes(view, band);
  const float share = 1.0f / static_cast<float>(n * n);
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < shading.options.width; ++x) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (int v = 0; v < n; ++v) {
        for (int u = 0; u < n; ++u) sum += shade_sample(shading, view, band, n * x + u, n * y + v);
      }
      const Eigen::Vector3f c = 255.0f * share * sum;
      const auto byte = [](float value) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
      };
      image.set(cell[0] + x, cell[1] + y, {byte(c[0]), byte(c[1]), byte(c[2])});
    }
  }
}

std::vector<View> make_views(const RenderScene& scene, const RenderOptions& options,
                             const DrawSurface& surface, int band_height, int band_count) {
  const std::vector<Vector3> other = points_beside_surface(scene);
  const auto cameras = make_cameras(make_model_frame(surface, other), {&surface.points, &other}, options);
  const std::vector<SkeletonPiece> pieces = outside_pieces(scene, surface);
  std::vector<Vector3> nodes;
  for (const SkeletonNode& node : scene.skeleton.nodes) nodes.push_back(node.position);
  const std::vector<bool> node_inside = inside_solid(surface, nodes);
  std::vector<View> views;
  for (const Camera& camera : cameras) {
    views.push_back(
        make_view(surface, camera, band_height * options.samples, (options.samples + 1) / 2, band_count));
    add_skeleton(scene, options, pieces, node_inside, views.back());
    add_lines(scene, options, views.back());
  }
  return views;
}

}  // namespace

void validate(const RenderOptions& options) {
  require_range("width", options.width, 16, 8192);
  require_range("height", options.height, 16, 8192);
  require_range("view_count", options.view_count, 1, 16);
  require_range("azimuth", options.azimuth, -360, 360);
  require_range("elevation", options.elevation, -90, 90);
  require_range("samples", options.samples, 1, 4);
  require_range("ghost_opacity", options.ghost_opacity, 0, 1);
  require_range("line_width", options.line_width, 0.5, 100);
}

std::vector<SkeletonPiece> outside_pieces(const RenderScene& scene) {
  validate_scene(scene);
  const NormalisedScene normalised = normalise(scene);
  std::vector<SkeletonPiece> pieces =
      outside_pieces(normalised.scene, make_draw_surface(normalised.scene.surface));
  for (SkeletonPiece& piece : pieces) {
    piece.begin = normalised.frame.to_model(piece.begin);
    piece.end = normalised.frame.to_model(piece.end);
  }
  return pieces;
}

Image render(const RenderScene& model, const RenderOptions& options, const Execution& execution) {
  validate(options);
  validate_scene(model);
  const RenderScene scene = normalise(model).scene;
  constexpr int kBandHeight = 4;  // pixels
  const int band_count = (options.height + kBandHeight - 1) / kBandHeight;
  const int columns = options.view_count <= 4
                          ? options.view_count
                          : static_cast<int>(std::ceil(std::sqrt(double(options.view_count))));
  const int rows = (options.view_count + columns - 1) / columns;
  Image image(columns * options.width, rows * options.height, options.background);
  const DrawSurface surface = make_draw_surface(scene.surface);
  const Shading shading{scene, options, surface, !scene.skeleton.nodes.empty() || !scene.lines.empty()};
  const std::vector<View> views = make_views(scene, options, surface, kBandHeight, band_count);
  parallel_for(
      options.view_count * band_count, "render", execution, [] { return Band(); },
      [&](Index i, Band& band) {
        const int v = i / band_count, b = i % band_count;
        const int end = std::min((b + 1) * kBandHeight, options.height);
        draw_band(shading, views[v], b, b * kBandHeight, end,
                  {v % columns * options.width, v / columns * options.height}, band, image);
      });
  return image;
}

}  // namespace mspskel
