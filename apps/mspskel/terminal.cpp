#include "terminal.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace mspskel::cli {
namespace {

bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return (no_colour == nullptr || *no_colour == '\0') && term != nullptr && std::strcmp(term, "dumb") != 0;
}

}  // namespace

Terminal::Terminal(Verbosity verbosity)
    : verbosity_(verbosity),
      is_terminal_(isatty(STDERR_FILENO) == 1),
      coloured_(is_terminal_ && wants_colour()) {}

void Terminal::line(const char* label, const char* colour, const std::string& message) {
  clear_progress();
  const char *begin = coloured_ ? colour : "", *end = coloured_ && *colour != '\0' ? "\033[0m" : "";
  std::fprintf(stderr, "mspskel: %s%s%s%s\n", begin, label, end, message.c_str());
}

void Terminal::error(const std::string& message) { line("error: ", "\033[1;31m", message); }

void Terminal::warning(const std::string& message) {
  if (verbosity_ != Verbosity::kQuiet) line("warning: ", "\033[1;33m", message);
}

void Terminal::note(const std::string& message) {
  if (verbosity_ == Verbosity::kVerbose) line("", "", message);
}

void Terminal::progress(const char* stage, double fraction) {
  if (!is_terminal_ || verbosity_ == Verbosity::kQuiet) return;
  const auto time = std::chrono::steady_clock::now();
  if (progress_shown_ && time - last_progress_ < std::chrono::milliseconds(100)) return;
  last_progress_ = time;
  progress_shown_ = true;
  std::fprintf(stderr, "\r%3d %% %s\033[K", static_cast<int>(100 * fraction), stage);
  std::fflush(stderr);
}

void Terminal::clear_progress() {
  if (!progress_shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  progress_shown_ = false;
}

}  // namespace mspskel::cli
