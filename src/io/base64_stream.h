// Base64 text, decoded as far as it is read.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mspskel::detail {

// White space between digits is skipped, and text may follow padding, as where a header and its data were
// encoded one after the other.
class Base64Stream {
 public:
  explicit Base64Stream(std::string_view text) : text_(text) {}

  // The next bytes. Throws ReadError if the text has fewer, or other characters than digits.
  std::string read(std::size_t count);
  // An upper bound.
  std::size_t bytes_left() const { return decoded_.size() + (text_.size() - at_) / 4 * 3 + 3; }
  // All that is left.
  std::string rest();

 private:
  bool decode_group();

  std::string_view text_;
  std::size_t at_ = 0;
  std::string decoded_;  // and not yet read
};

}  // namespace mspskel::detail
