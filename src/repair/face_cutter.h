// A triangle with points on its sides and within, and segments between them: triangles that keep the
// segments.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// A constrained triangulation by insertion and flips (Lawson 1977; Sloan 1993, "A fast algorithm for
// generating constrained Delaunay triangulations") in double precision: what rounding makes contradictory is
// told, not mended. Points are numbered in the order in which they come; the first three are the corners,
// counter-clockwise.
class FaceCutter {
 public:
  using Point = std::array<double, 2>;
  struct Part {
    std::array<Index, 3> corner, beside;  // side k runs from corner k to the next one; kNone: the outline
    std::array<char, 3> kept;             // sides that are segments
  };

  FaceCutter(const Point& a, const Point& b, const Point& c);

  // Twice the area of the triangle, positive where it is counter-clockwise.
  static double turn(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  // On the side that ends in corner k + 1, beyond the points that are on it already.
  void add_on_side(int side, const Point& p);
  void add_within(const Point& p);
  // False if the segment cannot be kept: it passes through a point or another segment.
  bool keep(Index from, Index to);

  const std::vector<Part>& parts() const { return parts_; }

 private:
  double turn(Index a, Index b, Index c) const { return turn(point_[a], point_[b], point_[c]); }
  Index add(const Point& p);
  std::pair<Index, int> find_side(Index from, Index to) const;
  Index part_with(const Point& p) const;
  void set(Index part, const std::array<Index, 3>& corner, const std::array<Index, 3>& beside,
           const std::array<char, 3>& kept);
  void point_back(Index part, Index old_part, Index new_part);
  void split_side(Index part, int side, Index p);
  bool can_flip(Index part, int side) const;
  void flip(Index part, int side);
  void improve(std::vector<std::pair<Index, Index>> sides);
  bool is_thin(Index part, int side) const;
  template <class Visit>
  void each_part_at(Index v, Visit visit) const;

  std::vector<Point> point_;
  std::vector<Part> parts_;
  std::vector<Index> part_at_;          // per point: one that has it
  std::array<Index, 3> last_{0, 1, 2};  // per side: the point that its outline ends with, before the corner
  mutable Index found_ = 0;
};

}  // namespace mspskel::detail
