// Boxes with four children each, stored so that one query tests four at once.
#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

// Slots of a leaf, as many as a node has children.
inline constexpr Index kBoxLeafSize = 4;

// Four numbers at once, for local use: stored as plain arrays, so that no public type has an alignment that
// depends on compiler flags.
using Lanes = float __attribute__((vector_size(16), may_alias));
inline Lanes load(const float* four) { return *reinterpret_cast<const Lanes*>(four); }
inline void store(const Lanes& lanes, float* four) { *reinterpret_cast<Lanes*>(four) = lanes; }
inline Lanes all(float x) { return Lanes{x, x, x, x}; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
inline Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

// Bit k is set where lane k of a is at most that of b.
inline unsigned at_most(const Lanes& a, const Lanes& b) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(_mm_cmple_ps(a, b)));
#else
  unsigned mask = 0;
  for (int k = 0; k < 4; ++k) mask |= static_cast<unsigned>(a[k] <= b[k]) << k;
  return mask;
#endif
}

// Both corners are read as four numbers, the last of which means nothing.
struct alignas(16) PrimitiveBox {
  float low[4], high[3];
  Index primitive;
};

// Children side by side, so that one query tests four boxes at once. A lane without a child has an inverted
// box.
struct alignas(64) BoxNode {
  float low[3][4], high[3][4];
  Index child[4];  // a node, or the first slot of a leaf
  Index count[4];  // 0: child is a node; else the number of slots in the leaf
};

}  // namespace detail
}  // namespace mspskel
