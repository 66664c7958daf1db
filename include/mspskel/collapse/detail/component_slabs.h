// What of a component of the surface lies between two planes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/mesh/detail/box_index.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// The faces of a component that a slab may meet, and their corners. Few sections look at the whole component,
// which costs less than to sort it first; many of them find their faces in a tree of boxes, so that a
// handle's sections cost what they cut and not what all other handles have. Refers to the surface and the
// elements.
class ComponentSlabs {
 public:
  ComponentSlabs(const SurfaceSnapshot& surface, const ComponentElements& component)
      : surface_(surface), component_(component) {}

  // Every face that meets low <= normal · x <= high, and some more, ascending; their corners, some more than
  // once. Valid until the next call.
  const ComponentElements& operator()(const Vector3& normal, double low, double high) {
    constexpr int kWholeLooks = 32;  // a tree takes about as long
    if (++looks_ <= kWholeLooks) return component_;
    if (looks_ == kWholeLooks + 1) sort_faces();
    near_.faces.clear();
    near_.vertices.clear();
    faces_.in_slab(normal, low, high, [&](Index f) { near_.faces.push_back(f); });
    std::sort(near_.faces.begin(), near_.faces.end());
    for (const Index f : near_.faces)
      for (Index h = 3 * f; h < 3 * f + 3; ++h) near_.vertices.push_back(surface_.origin[h]);
    return near_;
  }

 private:
  void sort_faces() {
    for (const Index f : component_.faces) {
      const auto corner = [&](Index k) -> const Vector3& {
        return surface_.position[surface_.origin[3 * f + k]];
      };
      faces_.add(f, corner(0).cwiseMin(corner(1)).cwiseMin(corner(2)),
                 corner(0).cwiseMax(corner(1)).cwiseMax(corner(2)));
    }
    faces_.build();
  }

  const SurfaceSnapshot& surface_;
  const ComponentElements& component_;
  std::int64_t looks_ = 0;
  BoxIndex faces_;
  ComponentElements near_;
};

}  // namespace detail
}  // namespace mspskel
