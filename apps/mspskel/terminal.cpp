#include "terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace mspskel::cli {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRewriteEvery(100), kLineEvery(3000);

bool understands_escapes() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && term != nullptr && std::strcmp(term, "dumb") != 0;
}

bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return no_colour == nullptr || *no_colour == '\0';
}

// Letters that fit on a line of the terminal.
std::size_t columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col - 1u : 79u;
}

}  // namespace

Terminal::Terminal(Verbosity verbosity)
    : verbosity_(verbosity), rewrites_(understands_escapes()), coloured_(rewrites_ && wants_colour()) {
  if (rewrites_) last_progress_ -= kRewriteEvery;  // the first one at once
}

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
  if (verbosity_ == Verbosity::kQuiet) return;
  const double share = estimate_.share(stage, fraction);
  const Clock::time_point time = Clock::now();
  if (time - last_progress_ < (rewrites_ ? kRewriteEvery : kLineEvery)) return;
  last_progress_ = time;
  const std::string percent = std::to_string(static_cast<int>(100 * share)) + " %";
  const std::string left = time_left(std::chrono::duration<double>(time - begin_).count(), share);
  const std::string text = percent + ", " + stage + (left.empty() ? "" : ", " + left);
  if (rewrites_)
    write_over(text);
  else
    std::fprintf(stderr, "mspskel: %s\n", text.c_str());
  std::fflush(stderr);
}

void Terminal::write_over(const std::string& text) {
  progress_shown_ = true;
  std::fprintf(stderr, "\r%s\033[K", text.substr(0, columns()).c_str());
}

void Terminal::clear_progress() {
  if (!progress_shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  progress_shown_ = false;
}

}  // namespace mspskel::cli
