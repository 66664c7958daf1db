// Pieces of a skeleton that say nothing of their component: stubs across a wall, single points, arcs in the
// surface itself.
#pragma once

#include <vector>

#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel {

// A piece shorter than this share of its component's extent is a stub.
inline constexpr double kLeastPieceLength = 0.1;

struct UselessPieces {
  Index stubs = 0;       // components whose piece is shorter than kLeastPieceLength of their extent
  Index on_surface = 0;  // nodes that lie on the surface, within rounding of their component's extent
};

// A piece belongs to the component whose vertices map to its nodes. O(vertices + nodes).
UselessPieces find_useless_pieces(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/skeleton/detail/useless_pieces_impl.h"
#endif
