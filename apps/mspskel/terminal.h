// What a person sees on stderr: messages, and a line of progress where stderr is a terminal.
#pragma once

#include <chrono>
#include <string>

namespace mspskel::cli {

enum class Verbosity { kQuiet, kNormal, kVerbose };

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

 private:
  void line(const char* label, const char* colour, const std::string& message);

  Verbosity verbosity_;
  bool is_terminal_;
  bool coloured_;
  bool progress_shown_ = false;
  std::chrono::steady_clock::time_point last_progress_{};
};

}  // namespace mspskel::cli
