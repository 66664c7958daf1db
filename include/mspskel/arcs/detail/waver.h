// Whether a line turns to and fro.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

// How far a line turns to and fro about point i, radians: all its turns within `reach` points to each side,
// less the turn from end to end. 0 for a line that bends one way, as a corner does.
inline double waver(const std::vector<Vector3>& line, std::size_t i, double reach) {
  constexpr int kSide = 3;  // stretches of the line on each side
  const auto angle = [](const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
  };
  const auto last = static_cast<std::ptrdiff_t>(line.size()) - 1;
  Vector3 from = Vector3::Zero(), first = Vector3::Zero(), before = Vector3::Zero();
  double turns = 0;
  for (int k = -kSide; k <= kSide; ++k) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) + std::lround(k * reach / kSide);
    const Vector3& to = line[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at, 0, last))];
    const Vector3 along = to - from;
    from = to;
    if (k == -kSide || along.isZero()) continue;
    if (first.isZero()) first = along;
    if (!before.isZero()) turns += angle(before, along);
    before = along;
  }
  return first.isZero() ? 0.0 : turns - angle(first, before);
}

}  // namespace detail
}  // namespace mspskel
