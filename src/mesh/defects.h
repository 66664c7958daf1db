#pragma once

#include <string>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Counts elements and remembers the names of the first few.
class NamedCount {
 public:
  void add(const std::string& name) {
    if (++count_ <= kShown) names_ += (count_ == 1 ? "" : ", ") + name;
  }
  // Cheap where most elements are beyond the few that are shown.
  bool shows_next() const { return count_ < kShown; }
  void add_unnamed() { ++count_; }
  bool any() const { return count_ > 0; }
  // "12 boundary edges"
  std::string count(const std::string& singular, const std::string& plural) const {
    return std::to_string(count_) + " " + (count_ == 1 ? singular : plural);
  }
  // "3-17, 17-20, ..."
  std::string names() const { return names_ + (count_ > kShown ? ", ..." : ""); }

 private:
  static constexpr Index kShown = 5;
  Index count_ = 0;
  std::string names_;
};

inline std::string edge_name(Index a, Index b) {
  return a < b ? std::to_string(a) + "-" + std::to_string(b) : std::to_string(b) + "-" + std::to_string(a);
}

}  // namespace mspskel::detail
