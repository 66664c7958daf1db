// A flat region in tiles, so that whether a point lies in it is told by the outlines near the point.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {
namespace detail {

using Polygon2 = std::vector<Eigen::Vector2d>;

// A rectangle and the pieces of a region's outlines in it.
class RegionTile {
 public:
  // All of the region that the closed polygons bound by parity. Cost: O(points).
  explicit RegionTile(const std::vector<Polygon2>& outlines) {
    for (const Polygon2& outline : outlines)
      for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
        pieces_.push_back({outline[j], outline[i]});
        box_.extend(outline[i]);
      }
    // No outline passes beyond the box.
    middle_ = box_.center();
    middle_inside_ = parity(middle_, {box_.max().x() + 1, box_.max().y() + 1});
  }

  const Eigen::AlignedBox2d& box() const { return box_; }
  // Whether no outline comes by: the tile lies inside the region or outside as a whole.
  bool is_even() const { return pieces_.empty(); }
  // Whether the point is one of the tile's. Tiles that parted share none.
  bool holds(const Eigen::Vector2d& x) const {
    return (box_.min().array() <= x.array()).all() && (x.array() < box_.max().array()).all();
  }
  // Whether a point of the tile lies in the region. Cost: O(outline in the tile).
  bool inside(const Eigen::Vector2d& x) const {
    return pieces_.empty() ? middle_inside_ : middle_inside_ != parity(x, middle_);
  }

  // Halves, across the longer side.
  std::array<RegionTile, 2> parted() const {
    const Eigen::Index k = box_.sizes().x() >= box_.sizes().y() ? 0 : 1;
    Eigen::AlignedBox2d low = box_, high = box_;
    low.max()[k] = high.min()[k] = middle_[k];
    return {part(low), part(high)};
  }

 private:
  using Piece = std::array<Eigen::Vector2d, 2>;

  RegionTile() = default;

  RegionTile part(const Eigen::AlignedBox2d& box) const {
    RegionTile tile;
    tile.box_ = box;
    tile.middle_ = box.center();
    tile.middle_inside_ = inside(tile.middle_);
    for (const Piece& piece : pieces_)
      if (box.intersects(Eigen::AlignedBox2d(piece[0].cwiseMin(piece[1]), piece[0].cwiseMax(piece[1]))))
        tile.pieces_.push_back(piece);
    return tile;
  }

  // Whether a point lies to the left of a piece that is looked along upward, or rightward where it is level.
  // On the piece it lies as if it were moved a little to the right, and by much less upward.
  static bool is_left(const Piece& piece, const Eigen::Vector2d& x) {
    const bool turned =
        piece[0].y() != piece[1].y() ? piece[0].y() > piece[1].y() : piece[0].x() > piece[1].x();
    const Eigen::Vector2d &from = piece[turned ? 1 : 0], way = piece[turned ? 0 : 1] - from, to_x = x - from;
    const double turn = way.x() * to_x.y() - way.y() * to_x.x();
    return turn > 0 || (turn == 0 && way.y() == 0);
  }

  // Whether the way from x along the first axis and on along the second one to y meets outlines an odd number
  // of times. Pieces hold one of their ends, as points on them lie, so that none counts twice.
  bool parity(const Eigen::Vector2d& x, const Eigen::Vector2d& y) const {
    const Eigen::Vector2d corner(y.x(), x.y());
    const auto spans = [](const Piece& piece, Eigen::Index across, double at) {
      return (piece[0][across] > at) != (piece[1][across] > at);
    };
    bool odd = false;
    for (const Piece& piece : pieces_) {
      if (spans(piece, 1, x.y()) && is_left(piece, x) != is_left(piece, corner)) odd = !odd;
      if (spans(piece, 0, y.x()) && is_left(piece, corner) != is_left(piece, y)) odd = !odd;
    }
    return odd;
  }

  Eigen::AlignedBox2d box_;
  std::vector<Piece> pieces_;  // all that meet the box
  Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
  bool middle_inside_ = false;
};

// Calls visit(tile) for tiles of the region, which have no point in common; what they leave out lies outside.
// Their number is at most about that of the outlines' points: a round region gets a fifth of that, a long one
// fewer. Cost: O(points log points) where outlines are as even as slices are.
template <class Visit>
void tile_region(const std::vector<Polygon2>& outlines, Visit visit) {
  double length = 0;
  std::size_t points = 0;
  for (const Polygon2& outline : outlines) {
    points += outline.size();
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++)
      length += (outline[i] - outline[j]).norm();
  }
  if (points == 0) return;
  const double longest = length / std::sqrt(3.0 * static_cast<double>(points));
  std::vector<RegionTile> open{RegionTile(outlines)};
  while (!open.empty()) {
    RegionTile tile = std::move(open.back());
    open.pop_back();
    if (tile.is_even() && !tile.inside(tile.box().center())) continue;
    if (!(tile.box().sizes().maxCoeff() > longest)) {
      visit(std::move(tile));
      continue;
    }
    std::array<RegionTile, 2> halves = tile.parted();
    for (RegionTile& half : halves) open.push_back(std::move(half));
  }
}

}  // namespace detail
}  // namespace mspskel
