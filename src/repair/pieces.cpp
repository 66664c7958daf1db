#include "pieces.h"

#include <algorithm>
#include <cmath>

#include "disjoint_sets.h"

namespace mspskel::detail {

std::vector<Index> pieces_of_faces(const FaceSet& faces, const std::vector<Index>& twin) {
  DisjointSets sets(faces.count());
  for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
    if (twin[h] != kNone) sets.unite(h / 3, twin[h] / 3);
  std::vector<Index> piece_of(faces.count());
  for (Index f = 0; f < faces.count(); ++f) piece_of[f] = sets.root(f);
  return piece_of;
}

std::vector<Piece> measure_pieces(const std::vector<Vector3>& points, const FaceSet& faces,
                                  const std::vector<Index>& piece_of) {
  std::vector<Piece> pieces(faces.count());
  for (Index f = 0; f < faces.count(); ++f) {
    Piece& piece = pieces[piece_of[f]];
    if (piece.faces++ == 0) piece.first_corner = faces.corners[3 * f];
    const Vector3& base = points[piece.first_corner];
    const Vector3 doubled = area_vector(points, faces, f);
    const double area = doubled.norm() / 2;
    (faces.polygon[f] != kNone ? piece.wall : piece.caps) += area;
    piece.volume += doubled.dot(points[faces.corners[3 * f]] - base);
    for (int k = 0; k < 3; ++k) piece.centre += area * (points[faces.corners[3 * f + k]] - base) / 3;
  }
  for (Piece& piece : pieces)
    if (piece.area() > 0) piece.centre /= piece.area();
  for (std::size_t h = 0; h < faces.corners.size(); ++h) {
    Piece& piece = pieces[piece_of[h / 3]];
    const Vector3 place = points[faces.corners[h]] - points[piece.first_corner];
    piece.extent = std::max(piece.extent, 2 * (place - piece.centre).norm());
  }
  return pieces;
}

bool has_volume(const Piece& piece) {
  constexpr double kFlat = 1e-8, kSheet = 0.95, kLidded = 0.3, kWavy = 1e-3;
  if (piece.caps > kSheet * piece.wall) return false;
  const double volume = piece.volume / 6, least = piece.caps > kLidded * piece.wall ? kWavy : kFlat;
  return 36 * kPi * volume * volume > least * std::pow(piece.area(), 3);
}

}  // namespace mspskel::detail
