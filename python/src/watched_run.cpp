#include "watched_run.h"

#include <cstdint>

#include "mspskel/base/error.h"

namespace mspskel::python {
namespace {

constexpr std::chrono::milliseconds kPause{50};

}  // namespace

WatchedRun::WatchedRun(nanobind::object callback, double time_limit_seconds)
    : callback_(std::move(callback)), last_asked_(Clock::now()) {
  if (time_limit_seconds > 0)
    deadline_ = last_asked_ + std::chrono::microseconds(static_cast<std::int64_t>(time_limit_seconds * 1e6));
}

ProgressCallback WatchedRun::progress() {
  return [this](const char* stage, double fraction) { return goes_on(stage, fraction); };
}

bool WatchedRun::goes_on(const char* stage, double fraction) {
  if (timed_out_ || raised_) return false;
  const auto now = Clock::now();
  if (deadline_ && now >= *deadline_) {
    timed_out_ = true;
    return false;
  }
  const bool tells = !callback_.is_none() && stage != last_stage_;
  if (!tells && now - last_asked_ < kPause) return true;
  last_asked_ = now;
  last_stage_ = stage;
  return asks_python(stage, fraction);
}

bool WatchedRun::asks_python(const char* stage, double fraction) {
  const nanobind::gil_scoped_acquire locked;
  try {
    if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
    if (callback_.is_none()) return true;
    return !callback_(stage, fraction).is(nanobind::handle(Py_False));
  } catch (nanobind::python_error& error) {
    raised_.emplace(std::move(error));
    return false;
  }
}

void WatchedRun::explain() {
  if (raised_) throw nanobind::python_error(std::move(*raised_));
  if (timed_out_) throw Error(ErrorKind::kCancelled, "the time limit is over");
}

}  // namespace mspskel::python
