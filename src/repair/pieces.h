// What hangs together over matched half-edges.
#pragma once

#include <vector>

#include "face_set.h"

namespace mspskel::detail {

struct Piece {
  Index faces = 0;
  Index first_corner = kNone;
  double volume = 0;  // signed, six times
  double wall = 0, caps = 0;
  Vector3 centre = Vector3::Zero();  // weighted by area, relative to the first corner
  double extent = 0;                 // twice the largest distance from the centre
  double area() const { return wall + caps; }
};

// Per triangle its piece, named by the first triangle of it.
std::vector<Index> pieces_of_faces(const FaceSet& faces, const std::vector<Index>& twin);

// Indexed by piece; of no faces where no piece has that name. Caps are of no polygon of the input.
std::vector<Piece> measure_pieces(const std::vector<Vector3>& points, const FaceSet& faces,
                                  const std::vector<Index>& piece_of);

// False for what is flat (its volume is nothing beside its area: a sphere's is 36 pi V² / A³ = 1, such a
// piece's is below 1e-8) and for a sheet: caps make up almost half of it, or they are at least 0.3 of the
// wall and what they close is below 1e-3, as where a lid lies across the hills and valleys of a terrain. A
// dish a twentieth as deep as wide and its lid have 0.04.
bool has_volume(const Piece& piece);

}  // namespace mspskel::detail
