// Slice tracing by face propagation: the closed contours in which a plane through a vertex cuts the surface.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/contour.h"

namespace mspskel {

// Walks contours on a snapshot (thesis 3.1, "face propagation"). Holds one 16-byte record a half-edge and one
// 32-byte position a vertex, since the walk waits for memory more than for arithmetic. The snapshot must
// outlive the tracer.
//
// A vertex lies on the positive side if its signed distance is >= 0, and the vertex that the plane goes
// through is put there by definition; so each triangle is crossed zero times or once and every contour is
// closed and simple.
//
//          c            h runs from the negative to the positive side and the walk enters its face:
//         / \.          c positive: leave across the edge c-a;  c negative: leave across the edge b-c
//        /   \.
//   a(-) --h--> b(+)
//
// const and safe to share between threads.
class SliceTracer {
 public:
  explicit SliceTracer(const SurfaceSnapshot& surface);

  const SurfaceSnapshot& surface() const { return surface_; }

  struct Shortest {
    double perimeter = std::numeric_limits<double>::infinity();  // infinity: no valid contour below the bound
    Index start = kNone;                                         // half-edge on which its walk starts
  };

  // The shortest contour through vertex v in the plane with the given unit normal that bounds material, if it
  // is shorter than `bound`: tracing stops as soon as the length so far plus the chord back reaches the bound
  // (exact). At a saddle several contours start at v and all are tried. `steps` is increased by the edges
  // crossed. Cost: O(edges crossed).
  Shortest shortest_through(Index v, const Vector3& normal, double bound, std::int64_t& steps) const;

  // The whole contour that starts at half-edge `start` (from negative to positive) of the plane; `through` is
  // the vertex that counts as positive, or kNone. Overwrites `contour`.
  void trace(Index start, const Plane& plane, Index through, Contour& contour) const;

  // shortest_through and trace together; false if there is no valid contour.
  bool shortest_contour(Index v, const Vector3& normal, Contour& contour, std::int64_t& steps) const;

 private:
  struct Step {
    Index apex;
    Index exit[2];  // by the side of the apex: negative, positive
    Index face;
  };
  struct alignas(32) Point {
    double x, y, z, unused;
  };
  struct Measure {
    double length, area;
  };

  // The plane in the form that the walk evaluates; `through` is positive whatever rounding says.
  struct Side {
    double x, y, z, offset;
    Index through;
    double operator()(const Point& p, Index v) const {
      return v == through ? 0.0 : (x * p.x + y * p.y + z * p.z) - offset;
    }
  };

  template <class Visit>
  void walk(Index start, const Side& side, Visit&& visit) const;
  class PairWalk;
  Side side_through(Index v, const Vector3& normal) const;
  Measure measure(Index start, const Side& side, double bound, std::int64_t& steps) const;

  const SurfaceSnapshot& surface_;
  std::vector<Step> step_;
  std::vector<Point> point_;
};

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/slice/detail/trace_contour_impl.h"
#endif
