// A slice's region in its own plane: one outer polygon, any hole polygons, and their geometry in 2-D.
#pragma once

#include <vector>

#include "mspskel/base/types.h"
#include "mspskel/center/detail/segment_strips.h"
#include "mspskel/slice/contour.h"

namespace mspskel {

inline double cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }
inline Vector2 turn_left(const Vector2& a) { return {-a.y(), a.x()}; }

// In-plane coordinates: x_space = origin + u · x + v · y, with u × v = the plane's normal.
struct PlaneFrame {
  Vector3 origin = Vector3::Zero();
  Vector3 u = Vector3::UnitX();
  Vector3 v = Vector3::UnitY();

  Vector2 to_plane(const Vector3& x) const { return {u.dot(x - origin), v.dot(x - origin)}; }
  Vector3 to_space(const Vector2& x) const { return origin + x.x() * u + x.y() * v; }
};

// The frame of a closed polyline in a plane: origin at the mean of its points, u toward its first point, so
// that the coordinates turn and move with the model. Precondition: at least one point; `normal` is unit.
PlaneFrame make_plane_frame(const std::vector<Vector3>& points, const Vector3& normal);

// The region between an outer polygon and its holes. Polygons may come in either orientation: the outer one
// is stored counter-clockwise, the holes clockwise, so the material is always on the left of a segment.
// Repeated points are fine. Flat arrays for vectorised loops: each ring's points are followed by copies of
// its first point, at least one, until its number of segments is a multiple of kBlock; the segments between
// copies have length 0 and add nothing to any sum.
class PlanarRegion {
 public:
  static constexpr Index kBlock = 8;
  struct Ring {
    Index begin = 0;     // its first point
    Index segments = 0;  // padded: segment i runs from point begin + i to begin + i + 1
    Index points = 0;    // real ones
    double perimeter = 0.0;
    double area = 0.0;  // signed: negative for holes
  };

  PlanarRegion() = default;
  explicit PlanarRegion(const std::vector<Vector2>& outer,
                        const std::vector<std::vector<Vector2>>& holes = {});

  // Replace the region by one polygon, keeping the memory; then add holes, which the caller knows to lie
  // inside it.
  void set_outer(const std::vector<Vector2>& polygon);
  void add_hole(const std::vector<Vector2>& polygon);

  const std::vector<Ring>& rings() const { return rings_; }  // the outer one first
  Vector2 point(Index i) const { return {x_[i], y_[i]}; }
  // Flat arrays, kBlock more than the points: point coordinates; per segment its length and unit tangent (0
  // if length 0).
  const double* x() const { return x_.data(); }
  const double* y() const { return y_.data(); }
  const double* length() const { return length_.data(); }
  const double* tangent_x() const { return tx_.data(); }
  const double* tangent_y() const { return ty_.data(); }

  // False if there is no outer polygon or it has no perimeter or no area worth the name (below 1e-12 of
  // perimeter²).
  bool valid() const;
  double perimeter() const { return rings_.empty() ? 0.0 : rings_[0].perimeter; }  // of the outer polygon
  double area() const;                                                             // holes taken off
  Vector2 centroid() const;          // of the region's area; the outer contour's where there is no area
  Vector2 contour_centroid() const;  // of the outer polygon's points, weighted by arc length
  double roundness() const;          // 4π·area / perimeter², area of the outer polygon alone: 1 for a disc

  double mean_width() const;  // 2 · area / length of all rings: a strip's width, a disc's radius

  // By parity over all rings. Cost: that of for_each_segment_at.
  bool contains(const Vector2& p) const;
  // Calls visit(i) once for every segment with one end above the level y and one not above it, and for a few
  // others: over all levels in the mean about as many as a level meets, in regions of 64 segments or more.
  template <class Visit>
  void for_each_segment_at(double y, Visit visit) const;
  double distance(const Vector2& p) const;  // to the nearest point of all rings
  // The least t in (0, 1] for which p + t·d lies on a ring; 2 if there is none.
  double first_hit(const Vector2& p, const Vector2& d) const;

  // A point of a ring and the unit normal toward the material there.
  struct Sample {
    Vector2 point;
    Vector2 inward;
  };
  // `count` samples of a ring at arc lengths i · perimeter / count from its first point: the same set
  // whichever way the polygon was given. Cost: O(points + count).
  std::vector<Sample> sample(Index ring, Index count) const;

  // The same region with every ring of more than `max_segments` segments replaced by that many samples of it,
  // even in arc length: for screening, since thin parts may come out thinner or crossed.
  PlanarRegion resampled(Index max_segments) const;

 private:
  void add_ring(const std::vector<Vector2>& polygon, double sign);

  std::vector<Ring> rings_;
  std::vector<double> x_, y_, length_, tx_, ty_;
  detail::slice_centre::SegmentStrips strips_;
};

template <class Visit>
void PlanarRegion::for_each_segment_at(double y, Visit visit) const {
  if (!strips_.empty()) {
    strips_.for_each_at(y, visit);
    return;
  }
  for (const Ring& ring : rings_)
    for (Index i = ring.begin; i < ring.begin + ring.segments; ++i) visit(i);
}

// The polygon of a contour in a frame of its plane.
std::vector<Vector2> flatten(const std::vector<Vector3>& points, const PlaneFrame& frame);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/center/detail/planar_region_impl.h"
#endif
