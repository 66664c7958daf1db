// Walks over text in memory. Lines are counted only when an error needs one, so the way there costs nothing.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "mspskel/base/error.h"

namespace mspskel::detail {

// What ends a word beside white space: nothing; a comment from '#' to the end of the line; that and OBJ's
// backslash.
enum class Syntax { kPlain, kHashComments, kObj };

class TextScanner {
 public:
  TextScanner(std::string_view bytes, Syntax syntax)
      : begin_(bytes.data()), end_(bytes.data() + bytes.size()), at_(begin_), syntax_(syntax) {
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;  // byte order mark
  }

  const char* position() const { return at_; }
  void seek(const char* position) { at_ = position; }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  // An upper bound for the count of things that take at least `bytes_each` bytes, the last separator being
  // optional.
  std::uint64_t room_for(std::uint64_t bytes_each) const { return (bytes_left() + 1) / bytes_each; }

  // Moves to the next word, across lines and comments; false at the end of the file.
  bool skip_blank() {
    for (; at_ != end_; ++at_) {
      if (static_cast<unsigned char>(*at_) > ' ') {
        if (!is_comment(*at_)) return true;
        skip_line();
        if (at_ == end_) return false;
      }
    }
    return false;
  }
  // Moves to the next word of this line; false at its end. A comment ends the line.
  bool skip_spaces() {
    while (at_ != end_ && is_blank(*at_) && !is_line_end(*at_)) ++at_;
    return at_ != end_ && !is_line_end(*at_) && !is_comment(*at_);
  }
  // Moves to the end of this line, before its line break.
  void skip_line() {
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
  }

  // The characters up to the next separator; empty at the end of the file.
  std::string_view word() {
    const char* start = at_;
    while (at_ != end_ && !is_separator(*at_)) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
  }

  std::int64_t integer(const char* what) {
    skip_blank();
    return integer_here(what);
  }
  // An integer that starts here and ends at a separator.
  std::int64_t integer_here(const char* what) {
    const char* start = at_;
    std::int64_t value = 0;
    const char* p = at_;
    // Up to nine digits cannot overflow, and that is nearly every number in a file.
    for (; p != end_ && p - start < 9 && static_cast<unsigned>(*p - '0') < 10; ++p)
      value = 10 * value + (*p - '0');
    if (p != start && (p == end_ || is_separator(*p))) {
      at_ = p;
      return value;
    }
    return any_integer(what);
  }

  double coordinate(const char* what) {
    skip_blank();
    return coordinate_here(what);
  }
  // A finite number that starts here and ends at a separator.
  double coordinate_here(const char* what) {
    double value = 0;
    const auto [next, error] = std::from_chars(at_, end_, value);
    if (error != std::errc() || (next != end_ && !is_separator(*next))) return any_number(what);
    if (!std::isfinite(value)) fail(at_, std::string(what) + " is not finite: " + quoted(at_));
    at_ = next;
    return value;
  }

  // Throws ReadError for the line that holds `at`.
  // The message with the number of the line.
  std::string located(const char* at, const std::string& message) const;
  [[noreturn]] void fail(const char* at, const std::string& message) const;
  // "expected WHAT, found WORD", for the word at the scanner's position.
  [[noreturn]] void fail_expected(const std::string& what) const;
  // The word at `at` in quotes, cut to a readable length.
  std::string quoted(const char* at) const;

 private:
  static bool is_blank(char c) { return static_cast<unsigned char>(c) <= ' '; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
  bool is_comment(char c) const { return c == '#' && syntax_ != Syntax::kPlain; }
  bool is_separator(char c) const {
    return is_blank(c) || is_comment(c) || (c == '\\' && syntax_ == Syntax::kObj);
  }
  std::int64_t any_integer(const char* what);
  double any_number(const char* what);

  const char* begin_;
  const char* end_;
  const char* at_;
  Syntax syntax_;
};

}  // namespace mspskel::detail
