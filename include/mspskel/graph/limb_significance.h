// When a part of the shape is a limb that deserves an arc.
#pragma once

#include <algorithm>
#include <vector>

#include "mspskel/base/error.h"

namespace mspskel {

struct PruningOptions {
  // A leaf arc stays if its significance exceeds this; 0 to 100. Larger keeps fewer features.
  double significance = 2.0;
  // ... and if its surface reaches beyond the balls of the rest of the skeleton by more than this share of
  // the model's extent; 0 to 1. Below it everything counts as noise.
  double smallest = 0.01;
};

inline void validate(const PruningOptions& o) {
  if (!(o.significance >= 0 && o.significance <= 100))
    throw UsageError("branch significance must be from 0 to 100");
  if (!(o.smallest >= 0 && o.smallest <= 1))
    throw UsageError("smallest feature must be from 0 to 1 of the extent");
}

// What a leaf arc or a limb stands for, in the manner of the saturation of Eq. 4.5 lifted from nodes to
// branches: how far its part of the surface protrudes, in its own half widths, times how much smaller its
// slices are than those of the part that it leaves. Fingers and ears are long for their width and much
// smaller than what carries them; the corners of a sheet are no longer than wide, noise does not protrude.
struct LeafSignificance {
  double depth = 0.0;       // how far the limb's surface reaches beyond the rest
  double half_width = 0.0;  // median along the limb
  double msp_ratio = 1.0;   // MSP of the part that it leaves / MSP of the limb, at least 1

  double value() const;
};

namespace detail {

// The value at the given share of the sorted list; 0 if that is empty.
inline double value_at_rank(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace detail

inline double LeafSignificance::value() const {
  return half_width > 0 ? depth / half_width * std::min(msp_ratio, 9.0) : 0.0;
}

}  // namespace mspskel
