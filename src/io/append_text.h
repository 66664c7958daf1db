#pragma once

#include <charconv>
#include <string>
#include <string_view>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// The shortest decimal that reads back as the same double; independent of the locale.
inline void append(std::string& out, double value) {
  char digits[32];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}
// The same of a float: at most nine digits.
inline void append(std::string& out, float value) {
  char digits[24];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}
inline void append(std::string& out, Index value) {
  char digits[16];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}
inline void append(std::string& out, std::size_t value) {
  char digits[24];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}
inline void append(std::string& out, std::string_view text) { out.append(text); }
inline void append(std::string& out, const char* text) { out.append(text); }
inline void append(std::string& out, char c) { out += c; }
// "x y z"
inline void append(std::string& out, const Vector3& p) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) out += ' ';
    append(out, p[k]);
  }
}

template <class... Parts>
void append_all(std::string& out, const Parts&... parts) {
  (append(out, parts), ...);
}

}  // namespace mspskel::detail
