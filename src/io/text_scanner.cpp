#include "text_scanner.h"

#include <algorithm>

namespace mspskel::detail {

std::string TextScanner::located(const char* at, const std::string& message) const {
  std::uint64_t line = 1;
  for (const char* p = begin_; p != at; ++p)
    if (*p == '\n' || (*p == '\r' && (p + 1 == end_ || p[1] != '\n'))) ++line;
  return "line " + std::to_string(line) + ": " + message;
}

void TextScanner::fail(const char* at, const std::string& message) const {
  throw ReadError(located(at, message));
}

void TextScanner::fail_expected(const std::string& what) const {
  const bool ended = at_ == end_ || is_separator(*at_);
  const char* const found = at_ == end_ ? "the end of the file" : "the end of the line";
  fail(at_, "expected " + what + ", found " + (ended ? found : quoted(at_)));
}

std::string TextScanner::quoted(const char* at) const {
  constexpr std::size_t kLongest = 24;
  std::string text;
  for (; at != end_ && !is_separator(*at); ++at) {
    if (text.size() == kLongest) return "'" + text + "...'";
    text += *at > ' ' && *at <= '~' ? *at : '?';
  }
  return "'" + text + "'";
}

std::int64_t TextScanner::any_integer(const char* what) {
  const char* from = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
  std::int64_t value = 0;
  const auto [next, error] = std::from_chars(from, end_, value);
  if (error == std::errc::result_out_of_range)
    fail(at_, std::string(what) + " is out of range: " + quoted(at_));
  if (error != std::errc() || (next != end_ && !is_separator(*next)) || (from != at_ && *from == '-'))
    fail_expected(what);
  at_ = next;
  return value;
}

double TextScanner::any_number(const char* what) {
  const char* last = at_;
  while (last != end_ && !is_separator(*last)) ++last;
  const char* from = at_ != last && *at_ == '+' ? at_ + 1 : at_;
  if (from != at_ && from != last && *from == '-') fail_expected(what);
  // A number below the range of double is zero or nearly so; one above it is an error. long double tells
  // which. It gets a terminated copy, since libstdc++ 12 reads past the end of the range to the next zero
  // byte.
  const std::string text(from, last);
  long double wide = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), wide);
  if (error == std::errc::invalid_argument || next != text.data() + text.size()) fail_expected(what);
  const double value = static_cast<double>(wide);
  if (error != std::errc() || !std::isfinite(value))
    fail(at_, std::string(what) + " is not finite: " + quoted(at_));
  at_ = last;
  return value;
}

}  // namespace mspskel::detail
