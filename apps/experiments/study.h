// Chapter 5 of the thesis on one model: every stage run and timed, and what lies between kept for pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mspskel/extract_skeleton.h"
#include "mspskel/skeleton/check_skeleton.h"

namespace mspskel::experiments {

// Planes a vertex, as in Fig. 5.1; the last is the thesis's own choice.
inline constexpr std::array<int, 4> kPlanes{2, 5, 15, 25};
// Fig. 5.23 to 5.25 do not say which thresholds they show.
inline constexpr std::array<double, 5> kThresholds{0.001, 0.01, 0.05, 0.1, 1.0};

// Slices with a number of planes a vertex, before refinement.
struct PlaneRun {
  int planes = 0;
  double seconds = 0.0;
  double excess = 0.0;  // mean of MSP over MSP with the last of kPlanes, less 1
  std::vector<double> perimeter;
};

struct SkeletonRun {
  std::string name;
  double seconds = 0.0;  // 0: not timed
  CurveSkeleton skeleton;
  SkeletonChecks checks;
};

// A quantity before and after the cone refinement.
struct BeforeAfter {
  double before = 0.0, after = 0.0;
};

struct Study {
  std::string name;
  Index genus = 0;
  std::vector<PlaneRun> planes;  // by kPlanes
  ExtractResult thesis;
  double refined_share = 0.0;
  BeforeAfter error;  // mean slice error, degrees
  BeforeAfter jump;   // mean |MSP(u) − MSP(v)| / mean of both, over the edges
  // Centres of MSP slices, of refined slices, and minima of the repulsive force (Fig. 5.4 to 5.11).
  std::array<SkeletonMesh, 3> skeleton_meshes;
  // Area and enclosed volume of each over the surface's; both 0 for a curve, the volume for a sheet.
  std::array<double, 3> area_share{}, volume_share{};
  std::vector<SkeletonRun> sweep;      // thesis mode by kThresholds
  std::vector<SkeletonRun> skeletons;  // thesis mode, default mode, and the baseline where it can run
  std::vector<Index> walk;             // vertices along the default skeleton's arcs, for charts

  // Seconds of the first lap of a stage in thesis mode; 0 if it did not run.
  double seconds(const std::string& stage) const;
};

// Runs all of it. Throws what extract_skeleton throws.
Study run_study(const std::string& name, const SurfaceSnapshot& surface, const Execution& execution);

// Frees what only pictures need.
void drop_bulk(Study& study);

}  // namespace mspskel::experiments
