#pragma once

#include <algorithm>

#include "mspskel/arcs/cut_returns.h"
#include "mspskel/arcs/limit_nodes.h"
#include "mspskel/arcs/merge_joints.h"
#include "mspskel/arcs/sharpen_corners.h"
#include "mspskel/arcs/tighten_walls.h"
#include "mspskel/base/linkage.h"
#include "mspskel/refine/aim_ends.h"
#include "mspskel/refine/complete_limbs.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/detail/center_part.h"
#include "mspskel/refine/lay_axes.h"
#include "mspskel/refine/lay_longest_paths.h"
#include "mspskel/refine/prune_branches.h"
#include "mspskel/solid/detail/inner_graph.h"
#include "mspskel/solid/shells.h"

namespace mspskel {
namespace detail {

// The stages of refine_arcs on one graph. Each has to keep the graph's homotopy type, and is held to it.
class ArcRefinement {
 public:
  ArcRefinement(ArcGraph& graph, const SurfaceSnapshot& surface, const SurfaceSnapshot& input,
                const BoundingVolumeHierarchy& solid, const VertexSlices& slices, std::vector<LimbTip> tips,
                const RefinementOptions& options, const Execution& execution, const ArcClasses& classes)
      : graph_(graph),
        surface_(surface),
        input_(input),
        solid_(solid),
        slices_(slices),
        tips_(std::move(tips)),
        options_(options),
        execution_(execution),
        classes_(classes),
        type_(homotopy_type(graph)),
        inner_(surface, solid, execution, &surface == &input ? InnerSurface::kInput : InnerSurface::kCoarser),
        draft_(options.centering) {
    // Until the graph's shape is settled a coarser line will do.
    draft_.rounds = (options.centering.rounds + 2) / 3;
    draft_.step = std::min(0.5, 2 * options.centering.step);
    draft_.rays = std::max(4, 2 * options.centering.rays / 3);
  }

  RefinementCounts run() {
    lay();
    route();
    aim();
    prune();  // hairs would pull on the arcs that they leave
    for (int pass = 0; pass < 2; ++pass) {
      center(draft_);
      zip();
      prune();
    }
    aim();
    complete();
    center(draft_);
    zip(ends_of_limbs());
    cut();  // a completed limb's way may have gone to and fro in the body
    extend();
    center(draft_);
    prune();
    center(options_.centering);
    settle_strays();
    const std::vector<bool> shells = find_shells(surface_, solid_, slices_, execution_.progress);
    tighten(shells);
    lay();  // straight again: in a block every wall is as near, and centring goes where the noise leads
    lay_paths(shells);
    sharpen();
    subdivide(graph_, 1.25 * options_.centering.step);  // rounds of centring stretch some edges
    // What no way was found for, the later stages may have led inside all the same.
    if (counts_.routing.unroutable > 0) counts_.routing.unroutable = count_crossing_edges(graph_, solid_);
    return counts_;
  }

 private:
  void keep_type(const char* stage) const {
    if (!(homotopy_type(graph_) == type_))
      throw NoSkeletonError(std::string(stage) + " would have changed the skeleton's topology");
  }

  void route() {
    counts_.routing = route_inside(graph_, inner_);
    // Edges of the coarser surface may cut what bounds the solid where a limb is thin.
    if (counts_.routing.unroutable > 0 && &input_ != &surface_) {
      InnerPaths fine(input_, solid_, execution_, InnerSurface::kInput);
      const RoutingResult again = route_arcs_inside(graph_, solid_, fine);
      counts_.routing.routed += again.routed;
      counts_.routing.unroutable = again.unroutable;
    }
    if (counts_.routing.unroutable > 0) counts_.pruned += remove_crossing_leaves(graph_, solid_);
    counts_.classes = route_by_class(graph_, classes_.tubes, input_, solid_, classes_.crossings, execution_);
    // That moves hubs, and leaf arcs have to follow.
    if (counts_.classes.checked > 0)
      counts_.routing.routed += route_arcs_inside(graph_, solid_, inner_, arcs_of_cycles(graph_)).routed;
    counts_.routing.unroutable = count_crossing_edges(graph_, solid_);
    keep_type("routing inside");
  }
  void aim() {
    aim_ends(graph_, surface_, solid_, options_.centering.step, execution_);
    aim_at_tips(graph_, inner_, tips_, options_.centering.step);
    keep_type("aiming of ends");
  }
  // In fins and wide ends centring draws a leaf back into the body, time after time.
  std::vector<Index> aim_strays() {
    constexpr double kSlack = 1.0;
    std::vector<Index> strays = aim_at_tips(graph_, inner_, tips_, options_.centering.step, kSlack);
    keep_type("aiming of strays");
    return strays;
  }
  // A leaf that centring has drawn back from its target goes there again, before anyone calls it a spur, and
  // stays while the arcs near what has changed settle. That may draw back others. What centring has laid
  // double is cut before, and settles with them.
  void settle_strays() {
    constexpr int kPasses = 3;
    ArcGraph settled = graph_;
    std::vector<Index> held = aim_strays();
    const Index cuts = cut(), spurs = drop_spurs();
    bool unsettled = !held.empty() || cuts > 0 || spurs > 0;
    for (int pass = 0; pass < kPasses && unsettled; ++pass) {
      center_part(graph_, arcs_near_changes(settled, graph_), solid_, options_.centering, execution_,
                  classes_.crossings, held);
      keep_type("settling");
      settled = graph_;
      const std::vector<Index> strays = aim_strays();
      held.insert(held.end(), strays.begin(), strays.end());
      unsettled = !strays.empty();
    }
  }
  void lay() {
    counts_.axes = lay_axes(graph_, surface_, solid_, tips_);
    keep_type("laying of axes");
  }
  void lay_paths(const std::vector<bool>& shells) {
    counts_.paths = lay_longest_paths(graph_, inner_, shells, options_.centering.step);
    keep_type("laying of paths");
  }
  void tighten(const std::vector<bool>& shells) {
    tighten_in_walls(graph_, inner_, shells, options_.centering.step, classes_.crossings, execution_);
    keep_type("tightening in walls");
  }
  void prune() {
    counts_.pruned += prune_branches(graph_, tips_);
    keep_type("pruning");
    counts_.joints_merged += merge_joints(graph_, solid_, options_.joint_overlap, classes_.crossings);
    dissolve_through_hubs(graph_);
    keep_type("merging of joints");
  }
  void center(const CenteringOptions& centering) {
    center_arcs(graph_, solid_, centering, execution_, classes_.crossings);
    keep_type("centring");
  }
  Index cut() {
    const Index cuts = cut_returns(graph_, solid_, execution_, classes_.crossings);
    keep_type("cutting of returns");
    return cuts;
  }
  void zip(const std::vector<bool>& kept = {}) {
    counts_.zips += zip_arcs(graph_, surface_, solid_, options_.zip, classes_.crossings, execution_, kept);
    keep_type("zipping");
  }
  void sharpen() {
    counts_.corners = sharpen_corners(graph_, solid_, execution_, classes_.crossings);
    keep_type("sharpening of corners");
  }
  void complete() {
    counts_.completed =
        complete_limbs(graph_, inner_, tips_, options_.limbs, options_.centering.step, execution_);
    keep_type("completion of limbs");
  }
  // Marks the hubs where leaf arcs end that stand for limbs.
  std::vector<bool> ends_of_limbs() const {
    std::vector<bool> ends(graph_.hub_position.size(), false);
    const ArcLeaves leaves(graph_, graph_.incidence());
    for (const std::size_t leaf : leaves_of_tips(graph_, leaves, tips_))
      if (leaf != kNoLeaf) ends[leaves.leaf[leaf].tip] = true;
    return ends;
  }
  void extend() {
    extend_ends(graph_, solid_, options_.extension);
    keep_type("extension of ends");
  }
  Index drop_spurs() {
    const Index spurs = remove_spurs(graph_, solid_, tips_);
    counts_.pruned += spurs;
    keep_type("removal of spurs");
    return spurs;
  }

  ArcGraph& graph_;
  const SurfaceSnapshot& surface_;
  const SurfaceSnapshot& input_;
  const BoundingVolumeHierarchy& solid_;
  const VertexSlices& slices_;
  std::vector<LimbTip> tips_;  // more as limbs are completed
  const RefinementOptions& options_;
  const Execution& execution_;
  const ArcClasses& classes_;
  const ArcGraphType type_;
  InnerGraph inner_;
  CenteringOptions draft_;
  RefinementCounts counts_;
};

}  // namespace detail

MSPSKEL_INLINE RefinementCounts refine_arcs(ArcGraph& graph, const SurfaceSnapshot& surface,
                                            const SurfaceSnapshot& input,
                                            const BoundingVolumeHierarchy& solid, const VertexSlices& slices,
                                            std::vector<LimbTip> tips, const RefinementOptions& options,
                                            const Execution& execution, const ArcClasses& classes) {
  validate(options);
  return detail::ArcRefinement(graph, surface, input, solid, slices, std::move(tips), options, execution,
                               classes)
      .run();
}

}  // namespace mspskel
