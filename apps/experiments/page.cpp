#include "page.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "baseline.h"
#include "pictures.h"

namespace mspskel::experiments {
namespace {

// Tables 5.2 and 5.3: 25 planes, 15 directions, one Core 2 Duo E8400.
struct ThesisTimes {
  const char* model;
  int vertices;
  int msp, cone, error, points;  // seconds
};
constexpr ThesisTimes kThesisTimes[] = {
    {"horse", 2502, 4, 24, 1, 3},           {"dog", 4070, 8, 57, 1, 5},
    {"camel", 5000, 12, 67, 1, 11},         {"octopus", 5262, 7, 16, 1, 5},
    {"raptor", 8904, 26, 109, 1, 11},       {"fertility", 9499, 49, 335, 1, 31},
    {"neptune", 11218, 43, 311, 2, 18},     {"dancing_children", 12487, 74, 729, 2, 52},
    {"armadillo", 14595, 116, 921, 4, 185},
};

const ThesisTimes* thesis_times(const std::string& model) {
  for (const ThesisTimes& times : kThesisTimes)
    if (model == times.model) return &times;
  return nullptr;
}

std::string number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}
std::string percent(double share) { return number(100 * share, 0) + " %"; }
std::string seconds_text(double seconds) { return number(seconds, seconds < 10 ? 2 : 1); }

Table models_table(const std::vector<Study>& studies) {
  Table table{{"model", "vertices", "faces", "genus", "vertices in the thesis"}, {}};
  for (const Study& study : studies) {
    const ThesisTimes* thesis = thesis_times(study.name);
    table.rows.push_back({study.name, std::to_string(study.thesis.surface.vertex_count()),
                          std::to_string(study.thesis.surface.face_count()), std::to_string(study.genus),
                          thesis ? std::to_string(thesis->vertices) : "–"});
  }
  return table;
}

Table planes_table(const std::vector<Study>& studies) {
  Table table{{"model"}, {}};
  for (const int planes : kPlanes) table.header.push_back(std::to_string(planes) + " slices, s");
  for (std::size_t i = 0; i + 1 < kPlanes.size(); ++i)
    table.header.push_back("excess with " + std::to_string(kPlanes[i]));
  for (const Study& study : studies) {
    std::vector<std::string> row{study.name};
    for (const PlaneRun& run : study.planes) row.push_back(seconds_text(run.seconds));
    for (std::size_t i = 0; i + 1 < study.planes.size(); ++i)
      row.push_back(number(100 * study.planes[i].excess, 1) + " %");
    table.rows.push_back(row);
  }
  return table;
}

// Ours, the thesis's, and the thesis's as it would be at our resolution.
Table times_table(const std::vector<Study>& studies) {
  Table table{{"model", "MSP, s", "thesis", "at our size", "cone, s", "thesis", "at our size",
               "slice error, s", "thesis", "skeletal points, s", "thesis"},
              {}};
  for (const Study& study : studies) {
    const ThesisTimes* thesis = thesis_times(study.name);
    const double growth =
        thesis ? std::pow(static_cast<double>(study.thesis.surface.vertex_count()) / thesis->vertices, 1.5)
               : 0;
    const auto theirs = [&](int seconds) { return thesis ? std::to_string(seconds) : "–"; };
    const auto grown = [&](int seconds) { return thesis ? number(growth * seconds, 0) : "–"; };
    const ThesisTimes t = thesis ? *thesis : ThesisTimes{};
    table.rows.push_back({study.name, seconds_text(study.seconds("slices")), theirs(t.msp), grown(t.msp),
                          seconds_text(study.seconds("cone_refinement")), theirs(t.cone), grown(t.cone),
                          seconds_text(study.seconds("slice_error")), theirs(t.error),
                          seconds_text(study.seconds("skeletal_points")), theirs(t.points)});
  }
  return table;
}

Table refinement_table(const std::vector<Study>& studies) {
  Table table{
      {"model", "refined", "by the thesis's seconds", "error before", "after", "MSP jump before", "after"},
      {}};
  for (const Study& study : studies) {
    const ThesisTimes* thesis = thesis_times(study.name);
    table.rows.push_back({study.name, percent(study.refined_share),
                          thesis ? percent(thesis->cone / (15.0 * thesis->msp)) : "–",
                          number(study.error.before, 1) + "°", number(study.error.after, 1) + "°",
                          number(100 * study.jump.before, 1) + " %",
                          number(100 * study.jump.after, 1) + " %"});
  }
  return table;
}

Table skeleton_mesh_table(const std::vector<Study>& studies) {
  Table table{{"model", "centres of MSP slices", "of refined slices", "repulsive force"}, {}};
  for (const Study& study : studies) {
    std::vector<std::string> row{study.name};
    for (std::size_t i = 0; i < study.area_share.size(); ++i)
      row.push_back(percent(study.area_share[i]) + ", " + number(100 * study.volume_share[i], 1) + " %");
    table.rows.push_back(row);
  }
  return table;
}

std::vector<std::string> graph_cells(const SkeletonChecks& checks) {
  return {std::to_string(checks.nodes), std::to_string(checks.leaves), std::to_string(checks.joints),
          std::to_string(checks.b0) + ", " + std::to_string(checks.b1), checks.topology ? "yes" : "no"};
}

Table skeletons_table(const std::vector<Study>& studies) {
  Table table{{"model", "method", "s", "nodes", "leaves", "joints", "pieces, cycles", "topology right",
               "inside", "off centre", "longest edge"},
              {}};
  for (const Study& study : studies) {
    for (const SkeletonRun& run : study.skeletons) {
      std::vector<std::string> row{study.name, run.name, seconds_text(run.seconds)};
      for (const std::string& cell : graph_cells(run.checks)) row.push_back(cell);
      row.push_back(number(100 * run.checks.inside, 1) + " %");
      row.push_back(number(run.checks.off_centre_mean, 3));
      row.push_back(number(run.checks.longest_edge, 3));
      table.rows.push_back(row);
    }
  }
  return table;
}

Table sweep_table(const std::vector<Study>& studies) {
  Table table{{"model", "threshold", "nodes", "leaves", "joints", "pieces, cycles", "topology right"}, {}};
  for (const Study& study : studies) {
    for (std::size_t i = 0; i < study.sweep.size(); ++i) {
      char threshold[32];
      std::snprintf(threshold, sizeof threshold, "%g", kThresholds[i]);
      std::vector<std::string> row{study.name, threshold};
      for (const std::string& cell : graph_cells(study.sweep[i].checks)) row.push_back(cell);
      table.rows.push_back(row);
    }
  }
  return table;
}

// The pictures of these kinds, model by model.
void add_figures(Document& page, const std::vector<Study>& studies, const std::vector<std::string>& words) {
  for (const Study& study : studies)
    for (const Picture& picture : pictures())
      for (const std::string& word : words)
        if (picture.word == word)
          page.figure(picture_file(study.name, word), study.name + ": " + picture.caption);
}

}  // namespace

Document make_page(const std::vector<Study>& studies, int threads) {
  Document page("Experiments of chapter 5");
  page.paragraph(
      "Thesis mode on " + std::to_string(studies.size()) + " models, " +
      (threads == 0 ? "all threads" : std::to_string(threads) + (threads == 1 ? " thread" : " threads")) +
      ". The thesis's seconds are those of a Core 2 Duo E8400, on meshes of other resolutions.");
  page.table(models_table(studies));

  page.heading("MSP and the number of slices (Table 5.1, Fig. 5.1)");
  page.paragraph("Seconds, and how much longer the shortest slice is on average than with 25.");
  page.table(planes_table(studies));
  page.figure("time-over-planes.png", "Time over the number of slices (Table 5.1)");
  add_figures(page, studies, {"planes"});

  page.heading("Preprocessing time (Tables 5.2, 5.3)");
  page.paragraph(
      "At our size: the thesis's seconds times (our vertices / its vertices)^1.5, since a slice crosses "
      "about "
      "as many edges as the square root of their number.");
  page.table(times_table(studies));

  page.heading("Cone refinement (Fig. 3.5 to 3.9, 5.2, 5.3)");
  page.paragraph(
      "Share of vertices refined, beside the share that the thesis's seconds give (cone over MSP over 15 "
      "directions); mean angle between a slice and the slices of its points; mean difference of MSP along an "
      "edge.");
  page.table(refinement_table(studies));
  add_figures(page, studies, {"refinement", "charts"});

  page.heading("Skeleton meshes (Fig. 5.4 to 5.11)");
  page.paragraph(
      "Area and enclosed volume of the moved mesh, over the surface's. A curve has neither, a medial sheet "
      "has "
      "area; triangles stretched from branch to branch count too.");
  page.table(skeleton_mesh_table(studies));
  add_figures(page, studies, {"skeleton-meshes"});

  page.heading("Skeletons (Fig. 5.12 to 5.22)");
  page.paragraph(
      std::string("Lengths are shares of the bounding box's diagonal; off centre is 0 in the middle and 1 "
                  "at the wall. ") +
      (has_baseline() ? "Contraction is CGAL's mean curvature flow, for Au et al. of the thesis."
                      : "Built without CGAL, so without the contraction baseline."));
  page.table(skeletons_table(studies));
  add_figures(page, studies, {"skeletons"});

  page.heading("Saturation threshold (Fig. 5.23 to 5.25)");
  page.table(sweep_table(studies));
  add_figures(page, studies, {"saturation"});
  return page;
}

}  // namespace mspskel::experiments
