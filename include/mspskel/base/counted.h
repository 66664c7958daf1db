// Numbers of things in messages: "1 cycle", "2 cycles".
#pragma once

#include <string>

namespace mspskel {

// `plural` where it is not the noun with an s.
inline std::string counted(long long count, const std::string& noun, const std::string& plural = "") {
  return std::to_string(count) + " " + (count == 1 ? noun : plural.empty() ? noun + "s" : plural);
}

}  // namespace mspskel
