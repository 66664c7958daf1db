// The fields whose zeros are skeletal points: the repulsive force of Eq. 4.1, sampled and in closed form, and
// the pull of the filled region.
#pragma once

#include <vector>

#include "mspskel/center/planar_region.h"

namespace mspskel {

// A potential at a point, its negative gradient and its Hessian's entries. Each potential here is subharmonic
// inside the region (xx + yy >= 0), so it has no maximum there.
struct FieldValue {
  double potential = 0.0;
  Vector2 force = Vector2::Zero();
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

// Point charges on contours, in flat arrays. Converts from points on purpose.
struct ForceSamples {
  ForceSamples(const std::vector<Vector2>& points);

  Index count = 0;
  std::vector<double> x, y;  // padded to whole blocks by points too far away to be felt
};

// Eq. 4.1 literally: sum over force samples b of (p − b) / |p − b|³. Units: 1 / length². Not finite at a
// force sample. Cost: O(samples), vectorised.
Vector2 sampled_repulsive_force(const ForceSamples& force_samples, const Vector2& p);

// Eq. 4.1 integrated along all contours of the region: no sampling parameter, and a wall at the contour,
// where the potential is infinite. For a segment ab of length L with d1 = p − a, d2 = p − b, r = |d|, u = d /
// r and w = u1 + u2:
//   potential U = ln((r1 + r2 + L) / (r1 + r2 − L)) = ln((r1 + r2 + L)² g / 2),
//   force     F = L g w,  g = 1 / (r1 r2 + d1 · d2) = 2 / (r1 r2 |w|²),
//   Hessian     = L (g² (r1 + r2) w wᵀ − g ((I − u1 u1ᵀ) / r1 + (I − u2 u2ᵀ) / r2)).
// The forms with |w|² keep their relative accuracy near the contour, where r1 r2 + d1 · d2 cancels.
// Cost: O(segments), vectorised. Potential has no unit; force 1 / length.
FieldValue repulsive_field(const PlanarRegion& region, const Vector2& p);

// The field of the uniformly filled region: potential ∫∫ ln|y − p| dA, force ∫∫ (y − p) / |y − p|² dA. Its
// zero is a centre that weighs near material more than the centroid does; seen from inside a convex region
// the force is ∫ r(θ) d(θ) dθ over the rays d(θ) of length r(θ). Regular everywhere; the Hessian's trace is
// 2π inside. With a segment's unit tangent t and outward normal n, h = (a − p) · n, φ the signed angle under
// which it is seen, and q = φ n + ln(r2 / r1) t:
//   F = Σ h q,  Hessian = Σ q nᵀ,  U = Σ h (s2 ln r2 − s1 ln r1 − L + h φ) / 2 − h L / 4  with s along t from
//   p's foot.
// Cost: O(segments), an arctangent and a logarithm each. Units: potential length², force length.
FieldValue area_field(const PlanarRegion& region, const Vector2& p);

// ∫ r(θ) d(θ) dθ over `rays` even directions, each to its first hit with a contour: the part of the region
// that is visible from p. Equals area_field's force in convex regions as the rays grow dense. p has to lie
// inside. Cost: O(segments + rays · depth).
Vector2 visible_field(const PlanarRegion& region, const Vector2& p, Index rays);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/center/detail/repulsive_force_impl.h"
#endif
