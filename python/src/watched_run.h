// Long work without the interpreter's lock, which Ctrl-C, a time limit or the user's callback may end.
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <optional>
#include <utility>

#include "mspskel/base/progress.h"

namespace mspskel::python {

// One run: made and destroyed while the lock is held.
class WatchedRun {
 public:
  // `callback` is None or is called with the stage's name and the share done, at most some ten times a second
  // within a stage; to return False cancels. 0: no time limit.
  WatchedRun(nanobind::object callback, double time_limit_seconds);

  // For the stages' Execution.
  ProgressCallback progress();

  // Calls work() without the lock. Throws what the callback raised, KeyboardInterrupt, Cancelled.
  template <class Work>
  auto run(Work work) {
    try {
      const nanobind::gil_scoped_release unlocked;
      return work();
    } catch (const Cancelled&) {
      explain();
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  bool goes_on(const char* stage, double fraction);
  bool asks_python(const char* stage, double fraction);
  void explain();

  nanobind::object callback_;
  std::optional<Clock::time_point> deadline_;
  Clock::time_point last_asked_;
  const char* last_stage_ = nullptr;
  bool timed_out_ = false;
  std::optional<nanobind::python_error> raised_;
};

}  // namespace mspskel::python
