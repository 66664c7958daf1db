// The certificate: what shows, by geometry alone, that a finished skeleton has exactly the solid's handles.
//
// A graph inside the solid is a skeleton of the right topology if it has one piece in each component, as many
// independent cycles as the surface has handles (b1 = genus), and if its cycles are independent in the solid.
// The last is shown by crossings: each volume cocycle is "signed crossings with a disc" (or a flat region
// with holes, or the linking number with a loop outside), so the matrix of cycles against cocycles has full
// rank. Nothing of this looks at how the skeleton was made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mspskel/collapse/piece_components.h"
#include "mspskel/collapse/volume_cocycles.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"

namespace mspskel {

enum class TopologyVerdict {
  kProved,  // every condition holds
  kKept,    // b0 and b1 are right, but something stands in the way of the proof
  kFailed,  // b0 or b1 is wrong, or the cycles that lie inside depend on each other
};

// "proved", "kept", "failed".
inline const char* to_string(TopologyVerdict verdict) {
  return verdict == TopologyVerdict::kProved ? "proved"
         : verdict == TopologyVerdict::kKept ? "kept"
                                             : "failed";
}

struct CertificateOptions {
  // Whether the surface crosses or touches itself, if that is known; otherwise it is tested here.
  std::optional<bool> self_intersecting;
};

struct TopologyCertificate {
  TopologyVerdict verdict = TopologyVerdict::kFailed;
  std::string reason;  // why it is not proved; empty if it is

  // Of the surface.
  Index components = 0, nested_components = 0;  // the latter lie inside others
  std::vector<Index> genus;                     // per component
  Index total_genus = 0;
  Index small_handles = 0;  // of these, handles that are too small for a cycle by CocycleOptions
  bool self_intersecting = false;

  // What the cocycles come from, and how many are independent on the surface's loops.
  Index discs = 0, holed_regions = 0, linking = 0, completions = 0;
  Index cocycle_rank = 0;

  // Of the skeleton.
  Index b0 = 0, b1 = 0;
  Index crossing_rank = 0;  // rank of the signed crossings of its cycles with the cocycles' regions
  bool clear = true;        // false: rounding left a doubt about the crossings
  // Share of the length inside the solid of the component that each piece stands for, without its cavities;
  // edges that are not inside from end to end.
  double inside = 0.0;
  Index edges_inside = 0, edges_not_inside = 0;
  std::optional<Vector3> outside_at;  // a place outside, normalised units; of edges that only graze the
                                      // surface, none may be found
};

// `solids` are those of the surface. Cost: O(faces + edges · (log faces + cocycles · crossings a
// contour)), and the test for self-intersections, O(faces · log faces).
// Throws UsageError for an edge that names no node, or a component that does not exist; Cancelled.
TopologyCertificate certify_topology(const SurfaceSnapshot& surface, const VolumeCocycles& cocycles,
                                     const SolidHierarchies& solids, const PolylineGraph& graph,
                                     const CertificateOptions& options = {}, const Execution& execution = {});
// The same with the hierarchy of the whole surface, from which it makes those of the components.
TopologyCertificate certify_topology(const SurfaceSnapshot& surface, const VolumeCocycles& cocycles,
                                     const BoundingVolumeHierarchy& hierarchy, const PolylineGraph& graph,
                                     const CertificateOptions& options = {}, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/topology_certificate_impl.h"
#endif
