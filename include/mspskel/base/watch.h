// Long work on one thread asks now and then whether to stop.
#pragma once

#include "mspskel/base/progress.h"

namespace mspskel::detail {

class Watch {
 public:
  // The callback has to outlive it; the stage is a literal.
  Watch(const ProgressCallback& progress, const char* stage) : progress_(progress), stage_(stage) {}

  // Throws Cancelled.
  void ask(double share = 0.0) const { report_progress(progress_, stage_, share); }
  // In a loop whose steps take microseconds.
  void step() {
    constexpr unsigned kSteps = 1024;
    if (++steps_ % kSteps == 0) ask();
  }

 private:
  const ProgressCallback& progress_;
  const char* stage_;
  unsigned steps_ = 0;
};

}  // namespace mspskel::detail
