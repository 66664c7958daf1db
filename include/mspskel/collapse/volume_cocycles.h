// Volume cocycles: integer labels of the surface's edges that tell which loops the solid can fill.
//
// A closed surface of genus g has 2g independent loops, its solid only g: half of them bound in the solid.
// The labels computed here are a basis (over the rationals) of the first cohomology of the solid, restricted
// to the surface: a loop's label sum is zero exactly if some multiple of it bounds in the solid.
//
// Three sources, each tried only for what the one before it leaves open:
// 1. Discs. A contour whose flat region holds no other contour of its plane bounds a disc in the solid, and
//    "signed crossings with this contour" is such a cocycle.
// 2. Flat regions with holes, all contours of the region together: the same argument for a disc with holes.
// 3. Linking numbers of loops with loops pushed out of the solid, which always have rank g (Dey, Li, Sun,
//    "Computing handle and tunnel loops with knot linking", CAD 2009).
//
// Only contours of the same component matter: a component that meets the disc of another one without crossing
// that one's surface lies inside it as a whole, is a shell of its own and gets cocycles of its own. Every
// component is taken as the boundary of the bounded solid that it encloses, whichever way its faces turn.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/progress.h"
#include "mspskel/collapse/cocycle_label.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/slice/contour.h"
#include "mspskel/slice/vertex_slices.h"

namespace mspskel {

// A plane to try: through a vertex, with a unit normal; `perimeter` (normalised units) only sets the order.
struct SliceCandidate {
  Index vertex = kNone;
  Vector3 normal = Vector3::Zero();
  double perimeter = 0.0;
};

struct CocycleOptions {
  // Planes through a generator loop, across its direction, a loop: 0 to 1000. Tried after the given
  // candidates.
  int own_planes = 12;
  // Sections of the whole component are computed for at most this many planes for each handle (plus one):
  // 0 to 100000. What is open then is settled by regions with holes found on the way, and by linking numbers.
  int sections_per_handle = 6;
  bool use_discs = true;          // source 1
  bool use_holed_regions = true;  // source 2
  // Handles round which shorter loops run on the surface get no cycle: share of the extent,
  // 0 to 1; 0: none.
  double smallest_handle = 0.0;
};

// Throws UsageError naming the option.
inline void validate(const CocycleOptions& options) {
  if (options.own_planes < 0 || options.own_planes > 1000)
    throw UsageError("own_planes must be from 0 to 1000, not " + std::to_string(options.own_planes));
  if (options.sections_per_handle < 0 || options.sections_per_handle > 100000)
    throw UsageError("sections_per_handle must be from 0 to 100000, not " +
                     std::to_string(options.sections_per_handle));
  if (!(options.smallest_handle >= 0 && options.smallest_handle <= 1))
    throw UsageError("smallest handle must be from 0 to 1 of the extent");
}

enum class CocycleSource {
  kDisc,         // one contour around a disc
  kHoledRegion,  // all contours of a flat region with holes
  kLinking,      // linking numbers with a loop pushed outward
  kCompletion,   // none of these: only closed; happens only if the surface crosses itself
};

// One cocycle, with the geometry that lets anyone check it.
struct VolumeCocycle {
  CocycleSource source = CocycleSource::kDisc;
  Index component = kNone;
  // Half-edges with a nonzero value; their twins have the negated value.
  std::vector<std::pair<Index, std::int32_t>> values;
  // Disc, holed region: the plane and its contours, the outer one first (normalised units).
  Plane plane;
  std::vector<Contour> contours;
  // Linking, completion: the loop on the surface as a closed polygon. Inside the solid the cocycle is the
  // linking number with it.
  std::vector<Vector3> loop;
};

// A handle without a cycle.
struct SmallHandle {
  double length = 0.0;           // of the shortest loop round it, normalised units
  Vector3 at = Vector3::Zero();  // a place on that loop
};

struct VolumeCocycles {
  Index rank = 0;                   // the sum of the genera, without the small handles
  std::vector<CocycleLabel> label;  // per half-edge, in Z^rank; label[twin] = −label; 0 summed round a face
  std::vector<Index> genus;         // per component
  std::vector<VolumeCocycle> cocycle;  // as many as the sum of the genera
  // Per cocycle what a crossing of it counts as in the labels. Empty: entry i is component i of the labels.
  std::vector<CocycleLabel> image;
  std::vector<SmallHandle> small_handles;  // per component of the surface, by length
  Index discs = 0, holed_regions = 0, linking = 0, completions = 0;  // cocycles by source
  std::int64_t contours_traced = 0;  // work: contours tried against the generators
  std::int64_t sections = 0;         // work: planes cut with a whole component

  CocycleLabel image_of(Index i) const {
    return image.empty() ? CocycleLabel::unit(i) : image[static_cast<std::size_t>(i)];
  }
};

// Candidates from the slices of the MSP stage: every vertex with a valid slice.
inline std::vector<SliceCandidate> slice_candidates(const VertexSlices& slices) {
  std::vector<SliceCandidate> candidates;
  for (Index v = 0; v < static_cast<Index>(slices.valid.size()); ++v)
    if (slices.valid[v]) candidates.push_back({v, slices.normal[v], slices.perimeter[v]});
  return candidates;
}

// The cocycles of every component. `candidates` may be empty or cover any part of the surface: they only
// serve to find small discs soon. The result has the genus of each component as rank in any case, but for
// small handles; where the
// surface crosses itself the cocycles are still closed and independent but need not come from a solid.
//
// Postconditions: per face the labels add up to zero; the cocycles' values on loops are independent; each
// vanishes on every loop that bounds in the solid (if the surface is embedded).
// Cost: O(faces) for genus 0; else O(faces · log faces), and for each section the faces and the pairs of
// contours at its plane. Throws UsageError for options or candidates out of range, Cancelled.
VolumeCocycles compute_volume_cocycles(const SurfaceSnapshot& surface,
                                       std::vector<SliceCandidate> candidates = {},
                                       const CocycleOptions& options = {},
                                       const ProgressCallback& progress = {});

// Leaves out the handles round which loops shorter than `share` (0 to 1) of their component's extent run
// along edges of the surface: the labels become those of the solid in which such loops are filled. What they
// tell apart is told apart in the solid too, and the rank falls by the number of independent classes of such
// loops, which are listed in `small_handles`. A thin handle that closes a long way round is not small: no
// short loop goes round it that the solid cannot fill.
//
// Returns false and changes nothing where crossings with regions would have to be added to linking numbers.
// Cost: a tree of shortest paths within half that length for each vertex at an edge with a label. Throws
// Cancelled.
bool leave_out_small_handles(const SurfaceSnapshot& surface, double share, VolumeCocycles& cocycles,
                             const ProgressCallback& progress = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/volume_cocycles_impl.h"
#endif
