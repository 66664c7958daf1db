// The way through the solid that begins at a place on the surface.
#pragma once

#include <optional>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

struct InwardChord {
  Vector3 start = Vector3::Zero();
  double length = 0.0;
  bool at_place = true;  // whether the solid begins at the place itself
};

// From a place on a surface along the unit vector `inward`. On a coarser surface it may lie outside the
// solid: the chord starts where the ray enters.
inline std::optional<InwardChord> inward_chord(const BoundingVolumeHierarchy& solid, const Vector3& place,
                                               const Vector3& inward) {
  constexpr double kSkip = 1e-7;  // far less than a chord and far more than rounding
  Vector3 start = place + kSkip * inward;
  const bool at_place = solid.inside(start);
  if (!at_place) {
    const auto entry = solid.first_hit(start, inward);
    if (!entry) return std::nullopt;
    start += (entry->distance + kSkip) * inward;
    if (!solid.inside(start)) return std::nullopt;
  }
  const auto hit = solid.first_hit(start, inward);
  if (!hit || hit->distance <= 0) return std::nullopt;
  return InwardChord{start, hit->distance, at_place};
}

// Against the vertex's normal.
inline std::optional<InwardChord> inward_chord(const SurfaceSnapshot& surface,
                                               const BoundingVolumeHierarchy& solid, Index v) {
  return inward_chord(solid, surface.position[v], -surface.normal[v]);
}

// Half the chord inward from a vertex; 0 if there is none.
inline double half_chord(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid, Index v) {
  const auto chord = inward_chord(surface, solid, v);
  return chord ? 0.5 * chord->length : 0.0;
}

}  // namespace detail
}  // namespace mspskel
