// Deterministic noise for samples: the same on every platform and in every order of evaluation.
#pragma once

#include <cstdint>

#include "mspskel/base/random.h"

namespace mspskel::detail {

// Uniform in [-1, 1), a function of its arguments alone.
inline double noise(std::uint64_t seed, std::uint64_t i, std::uint64_t j = 0) {
  return 2 * Random(Random(Random(seed).next() ^ i).next() ^ j).uniform() - 1;
}

}  // namespace mspskel::detail
