// How much of a run is done, from what the stages report of themselves.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mspskel/extract_skeleton.h"

namespace mspskel::cli {

// Stages come in a known order and with usual shares of the work, component by component; the estimate adds
// them up. It is as good as these shares are, never falls, and is below 1 until the run is over.
class ProgressEstimate {
 public:
  ProgressEstimate();
  // Those that the options ask for; `fine`: the mesh has more vertices than what it is coarsened to.
  void expect_stages(const ExtractOptions& options, bool fine);
  // Faces of each component; without, there is one.
  void expect_components(const std::vector<std::size_t>& faces, const ExtractOptions& options);
  // The share of the whole that is done, 0 to 1, when a stage has done this share of itself.
  double share(const std::string& stage, double fraction);

 private:
  struct Stage {
    std::string name;
    double work;  // of a component, as a share
  };

  int place_of(const std::string& stage) const;  // -1 if it is none of them

  std::vector<Stage> stages_;
  std::vector<double> pieces_{1.0};  // work of each, as a share; components side by side are the last
  std::size_t piece_ = 0;            // that is under way
  double before_ = 0;                // work of the pieces before it
  int last_stage_ = -1;
  double share_ = 0;
};

// "about 12 s left" from the seconds so far and the share done; empty while that says little.
std::string time_left(double seconds, double share);

}  // namespace mspskel::cli
