// Faces cut along the curves where shells cross.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "crossing_curves.h"

namespace mspskel::detail {

struct CutPiece {
  std::array<Index, 3> corner;  // points of the shells
  Index face;
  std::array<char, 3> cut;  // sides along which another shell passes
};

// All faces of the group: those without a curve, then the pieces of the others. Nothing where rounding gets
// in the way. Throws Cancelled. Cost: as find_crossing_curves.
std::optional<std::vector<CutPiece>> cut_along_curves(const ShiftedShells& shells,
                                                      const CrossingCurves& curves, Watch& watch);

}  // namespace mspskel::detail
