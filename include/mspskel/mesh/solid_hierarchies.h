// What lies inside the solid of each component of a surface.
#pragma once

#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/component_solids.h"
#include "mspskel/mesh/detail/box_index.h"

namespace mspskel {

// A hierarchy for each component, over the faces that bound its solid: its own and those of its cavities
// (component_solids.h). What other components lie around it, in it or across it changes nothing.
class SolidHierarchies {
 public:
  // `whole` is the hierarchy of all faces; it serves a surface of one component, and has to stay. Cost:
  // O(faces log faces). Throws Cancelled.
  SolidHierarchies(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& whole,
                   const ProgressCallback& progress = {});

  // Of kNone: the whole surface's.
  const BoundingVolumeHierarchy& operator()(Index component) const {
    return own_.empty() || component == kNone ? whole_ : own_[static_cast<std::size_t>(component)];
  }
  const BoundingVolumeHierarchy& whole() const { return whole_; }
  const ComponentSolids& components() const { return components_; }

  // The components in whose solid the point (normalised units) lies, ascending.
  std::vector<Index> around(const Vector3& p) const;

 private:
  const BoundingVolumeHierarchy& whole_;
  ComponentSolids components_;
  std::vector<BoundingVolumeHierarchy> own_;  // per component; empty if there is only one
  detail::BoxIndex boxes_;                    // of the components
};

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/mesh/detail/solid_hierarchies_impl.h"
#endif
