// Directions evenly round the unit circle, as fans of rays need them again and again.
#pragma once

#include <cmath>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {

// {cos, sin} of 2πk / count for k = 0 … count − 1; count ≥ 1. Each thread keeps those that it has asked for,
// so the reference is good until the thread asks for another count.
inline const std::vector<Vector2>& even_directions(int count) {
  thread_local std::vector<std::vector<Vector2>> known;
  const auto n = static_cast<std::size_t>(count);
  if (known.size() <= n) known.resize(n + 1);
  std::vector<Vector2>& directions = known[n];
  for (int k = static_cast<int>(directions.size()); k < count; ++k) {
    const double angle = 2 * kPi * k / count;
    directions.emplace_back(std::cos(angle), std::sin(angle));
  }
  return directions;
}

}  // namespace mspskel
