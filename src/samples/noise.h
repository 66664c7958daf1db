// Deterministic noise for samples: the same on every platform and in every order of evaluation.
#pragma once

#include <cstdint>

namespace mspskel::detail {

// One step of SplitMix64 (Steele, Lea, Flood 2014).
inline std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// Uniform in [-1, 1), a function of its arguments alone.
inline double noise(std::uint64_t seed, std::uint64_t i, std::uint64_t j = 0) {
  return static_cast<double>(mix(mix(mix(seed) ^ i) ^ j) >> 11) * 0x1.0p-52 - 1.0;
}

}  // namespace mspskel::detail
