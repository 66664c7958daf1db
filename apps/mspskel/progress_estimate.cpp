#include "progress_estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mspskel/pipeline/component_order.h"

namespace mspskel::cli {
namespace {

// A component is begun by what comes before its skeletal points, and ended by what comes after.
constexpr const char* kMiddle = "skeletal points";

}  // namespace

ProgressEstimate::ProgressEstimate() { expect_stages(default_options(), false); }

// Shares of the work, measured on meshes of 15,000 to 75,000 faces. What follows the last stage is checking
// and writing.
void ProgressEstimate::expect_stages(const ExtractOptions& options, bool fine) {
  const bool coarsens = options.coarsen && fine;
  const bool samples = options.slices == SliceMethod::kSampling;
  const bool sampled_force = options.points.point.method == SkeletalPointMethod::kSampledForce;
  stages_ = {{"coarsening", coarsens ? 3.0 : 0.0}};
  if (samples) {
    stages_.push_back({"slices", 1.1});
    if (options.cone.enabled) stages_.push_back({"cone refinement", 2.7});
  } else {
    stages_.push_back({"slice search", coarsens ? 1.1 : 5.7});
  }
  stages_.push_back({"slice error", coarsens ? 0.2 : 1.2});
  stages_.push_back({kMiddle, sampled_force ? 5.8 : coarsens ? 0.5 : 1.2});
  stages_.push_back({"cocycles", 0.3});
  stages_.push_back({"collapse", 0.3});
  if (options.refinement.enabled) {
    stages_.push_back({"arcs", coarsens ? 1.9 : 0.6});
    stages_.push_back({"digits", 0.4});
    stages_.push_back({"surface map", 0.4});
  }
  double all = 0;
  for (const Stage& stage : stages_) all += stage.work;
  for (Stage& stage : stages_) stage.work /= all;
}

void ProgressEstimate::expect_components(const std::vector<std::size_t>& faces,
                                         const ExtractOptions& options) {
  if (faces.size() < 2) return;
  const double working_faces = most_working_faces(options.coarsen, options.coarsening.vertices);
  const int threads = thread_count(options.execution);
  const ComponentOrder order = order_components(faces, working_faces, threads);
  pieces_.clear();
  double beside = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double work = component_work(faces[order.components[i]], working_faces);
    if (i < order.alone)
      pieces_.push_back(work);
    else
      beside += work / threads;
  }
  if (beside > 0) pieces_.push_back(beside);
  const double all = std::accumulate(pieces_.begin(), pieces_.end(), 0.0);
  for (double& piece : pieces_) piece /= all;
}

int ProgressEstimate::place_of(const std::string& stage) const {
  const auto found =
      std::find_if(stages_.begin(), stages_.end(), [&stage](const Stage& s) { return s.name == stage; });
  return found == stages_.end() ? -1 : static_cast<int>(found - stages_.begin());
}

double ProgressEstimate::share(const std::string& stage, double fraction) {
  const int place = place_of(stage), middle = place_of(kMiddle);
  double done = 0;
  if (stage == kSideBySideStage) {
    piece_ = pieces_.size() - 1;
    before_ = 1 - pieces_.back();
    done = fraction;
  } else if (place >= 0) {
    if (place < middle && last_stage_ > middle && piece_ + 1 < pieces_.size()) before_ += pieces_[piece_++];
    last_stage_ = place;
    for (int i = 0; i < place; ++i) done += stages_[i].work;
    done += stages_[place].work * fraction;
  }
  share_ = std::clamp(before_ + pieces_[piece_] * done, share_, 0.99);
  return share_;
}

std::string time_left(double seconds, double share) {
  if (seconds < 1 || share < 0.05) return {};
  const double left = seconds * (1 - share) / share;
  if (left < 90) return "about " + std::to_string(std::max(1L, std::lround(left))) + " s left";
  if (left < 90 * 60) return "about " + std::to_string(std::lround(left / 60)) + " min left";
  return "about " + std::to_string(std::lround(left / 3600)) + " h left";
}

}  // namespace mspskel::cli
