// What a person sees on stderr: messages, and how far the run is.
#pragma once

#include <chrono>
#include <string>

#include "progress_estimate.h"

namespace mspskel::cli {

enum class Verbosity { kQuiet, kNormal, kVerbose };

// Colours where stderr is a terminal that has them and NO_COLOR is not set. Progress is one line that is
// written over on a terminal, and elsewhere a plain line every few seconds, so that short runs write none.
class Terminal {
 public:
  explicit Terminal(Verbosity verbosity = Verbosity::kNormal);
  ~Terminal() { clear_progress(); }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void error(const std::string& message);    // always
  void warning(const std::string& message);  // not with --quiet
  void note(const std::string& message);     // with --verbose only
  void progress(const char* stage, double fraction);
  void clear_progress();
  // What the share of the whole is reckoned with.
  ProgressEstimate& estimate() { return estimate_; }

 private:
  using Clock = std::chrono::steady_clock;

  void line(const char* label, const char* colour, const std::string& message);
  void write_over(const std::string& text);

  Verbosity verbosity_;
  bool rewrites_;  // a line can be written over
  bool coloured_;
  bool progress_shown_ = false;
  Clock::time_point begin_ = Clock::now(), last_progress_ = begin_;
  ProgressEstimate estimate_;
};

}  // namespace mspskel::cli
