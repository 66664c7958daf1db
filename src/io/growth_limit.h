#pragma once

#include <cstdint>
#include <string>

#include "mspskel/base/error.h"

namespace mspskel::detail {

// Bounds what a file becomes in memory where parts of it are compressed, or used many times over: a mesh
// compresses to a tenth, a regular one to a fiftieth, and an assembly repeats its parts some hundred times.
// What grows more is made to fill the memory.
class GrowthLimit {
 public:
  explicit GrowthLimit(std::uint64_t file_bytes) : left_(kFloor + kGrowth * file_bytes) {}
  // Throws ReadError once the bytes are more than the limit altogether.
  void spend(std::uint64_t bytes) {
    if (bytes > left_)
      throw ReadError("its compressed or repeated parts grow to more than " + std::to_string(kGrowth) +
                      " times the file");
    left_ -= bytes;
  }

 private:
  static constexpr std::uint64_t kGrowth = 200, kFloor = std::uint64_t{1} << 26;
  std::uint64_t left_;
};

}  // namespace mspskel::detail
