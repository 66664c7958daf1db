#include "pictures.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "mspskel/io/atomic_file.h"
#include "mspskel/render/chart.h"
#include "mspskel/render/render.h"
#include "mspskel/render/tile.h"

namespace mspskel::experiments {
namespace {

constexpr Color kBefore{200, 60, 20}, kAfter{30, 70, 190};

void write_png(const std::string& folder, const std::string& file, const Image& image) {
  write_file_atomically((std::filesystem::path(folder) / file).string(), encode_png(image));
}

// What all pictures of a study share.
class Painter {
 public:
  Painter(const Study& study, const Execution& execution) : study_(study), execution_(execution) {
    surface_ = to_polygon_soup(study.thesis.surface);
    // The ends of limbs have slices far longer than all others and would leave one colour for the rest.
    std::vector<double> msp = study.planes.back().perimeter;
    const auto rank = msp.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(msp.size()));
    std::nth_element(msp.begin(), rank, msp.end());
    top_msp_ = *rank;
    low_msp_ = *std::min_element(msp.begin(), msp.end());
  }

  Image coloured(const std::vector<double>& values, double low, double high) const {
    RenderScene scene;
    scene.surface = surface_;
    for (const double value : values) scene.vertex_color.push_back(blue_to_red((value - low) / (high - low)));
    return draw(scene, 1, 1.0);
  }
  Image msp(const std::vector<double>& values) const { return coloured(values, low_msp_, top_msp_); }

  // The moved mesh as lines, each edge in the colour of its ends' slice error, in the ghost of the surface.
  Image skeleton_mesh(const SkeletonMesh& mesh) const {
    const SurfaceSnapshot& surface = study_.thesis.surface;
    RenderScene scene;
    scene.surface = surface_;
    for (Index h = 0; h < surface.halfedge_count(); ++h) {
      const Index a = surface.origin[h], b = surface.target(h);
      if (surface.twin[h] < h) continue;
      scene.lines.push_back(
          {{surface.frame.to_model(mesh.position[a]), surface.frame.to_model(mesh.position[b])},
           false,
           blue_to_red((mesh.error[a] + mesh.error[b]) / 2)});
    }
    return draw(scene, 1, 1.2);
  }

  Image skeleton(const CurveSkeleton& skeleton, int views) const {
    RenderScene scene;
    scene.surface = surface_;
    scene.skeleton = skeleton;
    return draw(scene, views, 4.0);
  }

 private:
  Image draw(const RenderScene& scene, int views, double line_width) const {
    RenderOptions options;
    options.width = 320;
    options.height = 280;
    options.view_count = views;
    options.line_width = line_width;
    options.ghost_opacity = 0.2;
    return render(scene, options, execution_);
  }

  const Study& study_;
  Execution execution_;
  PolygonSoup surface_;
  double low_msp_ = 0.0, top_msp_ = 1.0;
};

Image row(const std::vector<Image>& images, const std::vector<std::string>& labels, int columns) {
  TileOptions options;
  options.columns = columns;
  return tile(images, labels, options);
}

Image planes_picture(const Study& study, const Painter& painter) {
  std::vector<Image> images;
  std::vector<std::string> labels;
  for (const PlaneRun& run : study.planes) {
    images.push_back(painter.msp(run.perimeter));
    labels.push_back(std::to_string(run.planes) + " slices");
  }
  return row(images, labels, static_cast<int>(kPlanes.size()));
}

// One quantity of all vertices, before or after the refinement.
Image vertex_chart(const Study& study, const std::vector<double>& values, const std::string& title,
                   double high, Color color) {
  ChartSeries series;
  for (const Index v : study.walk) series.y.push_back(values[v]);
  series.color = color;
  series.scatter = true;
  ChartOptions options;
  options.width = 640;
  options.height = 240;
  options.title = title;
  options.x_label = "vertices along the skeleton's arcs";
  options.y_max = high;
  options.line_width = 0.6;
  return chart({series}, options);
}

Image charts_picture(const Study& study) {
  const double scale = study.thesis.surface.frame.scale;
  std::vector<double> msp = study.thesis.initial_slices.perimeter, refined = study.thesis.slices.perimeter;
  for (double& value : msp) value *= scale;
  for (double& value : refined) value *= scale;
  const double longest = *std::max_element(msp.begin(), msp.end());
  return row({vertex_chart(study, msp, "MSP", longest, kBefore),
              vertex_chart(study, study.thesis.initial_slices.error, "slice error", 1, kBefore),
              vertex_chart(study, refined, "MSP, refined", longest, kAfter),
              vertex_chart(study, study.thesis.slices.error, "slice error, refined", 1, kAfter)},
             {}, 2);
}

Image refinement_picture(const Study& study, const Painter& painter) {
  const VertexSlices &before = study.thesis.initial_slices, &after = study.thesis.slices;
  return row({painter.msp(before.perimeter), painter.msp(after.perimeter),
              painter.coloured(before.error, 0, 1), painter.coloured(after.error, 0, 1)},
             {"MSP", "MSP, refined", "slice error", "slice error, refined"}, 4);
}

Image skeleton_meshes_picture(const Study& study, const Painter& painter) {
  std::vector<Image> images;
  for (const SkeletonMesh& mesh : study.skeleton_meshes) images.push_back(painter.skeleton_mesh(mesh));
  return row(images, {"centres, MSP slices", "centres, refined", "repulsive force"}, 3);
}

Image skeletons_picture(const Study& study, const Painter& painter) {
  std::vector<Image> images;
  std::vector<std::string> labels;
  for (const SkeletonRun& run : study.skeletons) {
    images.push_back(painter.skeleton(run.skeleton, 2));
    labels.push_back(run.name);
  }
  return row(images, labels, 3);
}

Image sweep_picture(const Study& study, const Painter& painter) {
  std::vector<Image> images;
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < study.sweep.size(); ++i) {
    images.push_back(painter.skeleton(study.sweep[i].skeleton, 1));
    char text[32];
    std::snprintf(text, sizeof text, "saturation %g", kThresholds[i]);
    labels.emplace_back(text);
  }
  return row(images, labels, static_cast<int>(kThresholds.size()));
}

}  // namespace

const std::vector<Picture>& pictures() {
  static const std::vector<Picture> all{
      {"planes", "MSP by the number of slices at a vertex (Fig. 3.2, 5.1), blue short to red long"},
      {"refinement",
       "MSP and slice error before and after cone refinement (Fig. 3.5, 3.7, 5.2, 5.3), blue low to red "
       "high"},
      {"charts", "MSP and normalised slice error of the vertices (Fig. 3.8, 3.9)"},
      {"skeleton-meshes", "the three skeleton meshes (Fig. 5.4 to 5.11), coloured by slice error (Fig. 4.6)"},
      {"skeletons", "skeletons (Fig. 5.12 to 5.22); what leaves the solid is red"},
      {"saturation", "thesis mode by saturation threshold (Fig. 5.23 to 5.25)"}};
  return all;
}

std::string picture_file(const std::string& study, const std::string& word) {
  return study + "-" + word + ".png";
}

void write_pictures(const Study& study, const std::string& folder, const Execution& execution) {
  const Painter painter(study, execution);
  const Image images[] = {planes_picture(study, painter),
                          refinement_picture(study, painter),
                          charts_picture(study),
                          skeleton_meshes_picture(study, painter),
                          skeletons_picture(study, painter),
                          sweep_picture(study, painter)};
  for (std::size_t i = 0; i < pictures().size(); ++i)
    write_png(folder, picture_file(study.name, pictures()[i].word), images[i]);
}

void write_time_chart(const std::vector<Study>& studies, const std::string& folder) {
  std::vector<ChartSeries> all;
  double highest = 0;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    ChartSeries series;
    series.name = studies[i].name;
    series.color = blue_to_red(
        studies.size() > 1 ? static_cast<double>(i) / static_cast<double>(studies.size() - 1) : 0);
    for (const PlaneRun& run : studies[i].planes) {
      series.x.push_back(run.planes);
      series.y.push_back(1e6 * run.seconds / studies[i].thesis.surface.vertex_count());
      highest = std::max(highest, series.y.back());
    }
    all.push_back(std::move(series));
  }
  ChartOptions options;
  options.title = "Time over the number of slices";
  options.x_label = "slices at a vertex";
  options.y_label = "microseconds a vertex";
  options.y_max = 1.7 * highest;  // room for the legend
  write_png(folder, "time-over-planes.png", chart(all, options));
}

}  // namespace mspskel::experiments
