// The inner paths beside the surface that an arc graph's map is of.
#pragma once

#include "mspskel/solid/detail/inner_paths.h"

namespace mspskel {
namespace detail {

// What reads the map takes surface, solid and the vertices' points from here, so vertices of another surface
// cannot come in between.
class InnerGraph : public InnerPaths {
 public:
  using InnerPaths::InnerPaths;

  const SurfaceSnapshot& surface() const { return net().surface(); }
  const BoundingVolumeHierarchy& solid() const { return net().solid(); }
  bool usable(Index v) const { return net().usable(v); }
  const Vector3& point(Index v) const { return net().point(v); }
  template <class Allowed>
  Index nearest(const Vector3& x, Allowed allowed) const {
    return net().nearest(x, allowed);
  }
};

}  // namespace detail
}  // namespace mspskel
