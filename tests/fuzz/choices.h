// Where a fuzzed input comes from: the bytes that a fuzzer mutates, then numbers that follow from them.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "support/meshes.h"

namespace mspskel::fuzz {

// Each choice takes a byte while there are any, so a changed byte changes one choice. After the last one the
// choices go on from a generator whose seed is all of the bytes: every input is whole, and the same bytes, or
// the same seed, give the same input everywhere.
class Choices {
 public:
  explicit Choices(std::uint64_t seed) : random_(seed) {}
  Choices(const std::uint8_t* data, std::size_t size) : bytes_(data, data + size), random_(hash(bytes_)) {}

  // [0, count), 0 < count.
  Index below(Index count) {
    if (at_ == bytes_.size()) return random_.below(count);
    return static_cast<Index>(bytes_[at_++]) % count;
  }
  bool one_in(Index count) { return below(count) == 0; }
  // [low, high]: even, or with even orders of magnitude (0 < low).
  double uniform(double low, double high) {
    const double share = at_ == bytes_.size() ? random_.uniform() : bytes_[at_++] / 255.0;
    return low + (high - low) * share;
  }
  double magnitude(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  template <class Value>
  Value of(std::initializer_list<Value> values) {
    return values.begin()[below(static_cast<Index>(values.size()))];
  }
  // Numbers for a shape as a whole, where single ones mean nothing.
  test::Random numbers() { return test::Random(random_.next() + static_cast<std::uint64_t>(below(256))); }

 private:
  static std::uint64_t hash(const std::vector<std::uint8_t>& bytes) {
    std::uint64_t h = 0xcbf29ce484222325ULL;  // FNV-1a
    for (const std::uint8_t b : bytes) h = (h ^ b) * 0x100000001b3ULL;
    return h;
  }

  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
  test::Random random_;
};

}  // namespace mspskel::fuzz
