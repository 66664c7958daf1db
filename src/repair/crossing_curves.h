// The curves along which shells pass through each other.
#pragma once

#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mspskel/base/watch.h"
#include "shifted_shells.h"

namespace mspskel::detail {

// Where an edge, named by the lesser of its half-edges, passes through a face of another shell.
struct EdgePassage {
  Index edge, face, point;
  double share;  // of the edge, from the lesser of its vertices
};

// What two faces have in common: from point to point, and the points where third faces meet it, in order.
struct CurveSegment {
  std::array<Index, 2> face, end;
  std::vector<Index> between{};
};

struct CrossingCurves {
  std::vector<EdgePassage> passages;
  std::vector<CurveSegment> segments;                     // ascending by faces
  std::unordered_map<Index, std::vector<Index>> on_face;  // segments of each face that has any
  std::vector<Index> faces;                               // those, ascending

  // Pairs of shells that have a curve.
  std::size_t crossings(const ShiftedShells& shells) const;
};

// Adds the curves' points to the shells. Nothing where a shell crosses itself beside another, or rounding
// gets in the way. Throws Cancelled. Cost: O(pairs of faces that meet), and the square of those of one face.
std::optional<CrossingCurves> find_crossing_curves(ShiftedShells& shells, const Execution& execution,
                                                   Watch& watch);

}  // namespace mspskel::detail
