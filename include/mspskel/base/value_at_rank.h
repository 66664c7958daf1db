// Medians and other quantiles of a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mspskel {
namespace detail {

// The value at the given share of the sorted list; 0 if that is empty.
inline double value_at_rank(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace detail
}  // namespace mspskel
