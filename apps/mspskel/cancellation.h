// Why a run ends early: an interrupt from the keyboard, or its time limit.
#pragma once

#include <chrono>

namespace mspskel::cli {

// While one lives, SIGINT and SIGTERM set a flag; the same signal a second time ends the process at once.
class Cancellation {
 public:
  // 0: no limit.
  explicit Cancellation(double time_limit_seconds = 0);

  bool requested() const { return interrupted() || timed_out(); }
  void throw_if_requested() const;  // Cancelled
  const char* reason() const { return interrupted() ? "interrupted" : "the time limit is over"; }

 private:
  static bool interrupted();
  bool timed_out() const;

  bool limited_;
  std::chrono::steady_clock::time_point deadline_;
};

}  // namespace mspskel::cli
