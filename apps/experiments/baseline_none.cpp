#include "baseline.h"

namespace mspskel::experiments {

bool has_baseline() { return false; }

CurveSkeleton baseline_skeleton(const SurfaceSnapshot&) { return {}; }

}  // namespace mspskel::experiments
