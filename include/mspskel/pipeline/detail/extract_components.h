// Every component of a surface by itself, and the results as those of the whole.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mspskel/base/run_each_beside.h"
#include "mspskel/mesh/component_solids.h"
#include "mspskel/pipeline/component_order.h"
#include "mspskel/pipeline/detail/extract_component.h"
#include "mspskel/pipeline/detail/join_components.h"

namespace mspskel {
namespace detail {

// Whether the options ask for more of a component than its part of the whole's nodes.
inline ExtractOptions with_share_of_nodes(const ExtractOptions& options, Index own, Index all) {
  ExtractOptions share = options;
  share.refinement.nodes = static_cast<Index>(
      std::max<std::int64_t>(1, std::int64_t{options.refinement.nodes} * own / std::max<Index>(all, 1)));
  return share;
}

// Every component of a surface by itself: in a frame, with a budget of vertices and in a solid of its own.
class ComponentwiseExtraction {
 public:
  ComponentwiseExtraction(const SurfaceSnapshot& surface, const ComponentSolids& solids,
                          const ExtractOptions& options)
      : surface_(surface),
        solids_(solids),
        options_(options),
        part_(solids.faces.size()),
        own_(part_.size()) {
    for (Index f = 0; f < surface.face_count(); ++f)
      own_[surface.component[surface.origin[3 * f]]].push_back(f);
  }

  void run_into(ExtractResult& result) {
    ExtractOptions first = options_;
    first.refinement.nodes = 0;
    extract_all([&](Index) { return first; });
    if (options_.refinement.nodes > 0 && options_.refinement.enabled) {
      // A component gets nodes in proportion to what it has without a budget.
      std::vector<Index> nodes;
      Index all = 0;
      for (const ExtractResult& part : part_) {
        nodes.push_back(static_cast<Index>(part.skeleton.nodes.size()));
        all += nodes.back();
      }
      if (all > options_.refinement.nodes)
        extract_all([&](Index c) { return with_share_of_nodes(options_, nodes[c], all); });
    }
    make_room(result);
    for (std::size_t c = 0; c < part_.size(); ++c) {
      const NormalisedFrame frame = part_[c].surface.frame;
      join_component(std::move(part_[c]),
                     {static_cast<Index>(c), vertex_[c], own_[c], {frame, surface_.frame}}, result);
    }
  }

 private:
  template <class OptionsOf>
  void extract_all(OptionsOf options_of) {
    vertex_.assign(part_.size(), {});
    std::vector<std::size_t> faces;
    for (const std::vector<Index>& own : own_) faces.push_back(own.size());
    const double working_faces = most_working_faces(options_.coarsen, options_.coarsening.vertices);
    const ComponentOrder order = order_components(faces, working_faces, thread_count(options_.execution));
    const auto work = [&](Index c) { return component_work(faces[c], working_faces); };
    const auto beside = order.components.begin() + static_cast<std::ptrdiff_t>(order.alone);
    std::for_each(order.components.begin(), beside, [&](Index c) { extract_one(c, options_of(c)); });
    const auto count = static_cast<Index>(order.components.end() - beside);
    SideBySideShare together(std::accumulate(beside, order.components.end(), 0.0,
                                             [&](double sum, Index c) { return sum + work(c); }));
    run_each_beside(count, options_.execution, [&](Index i, const Execution& aside) {
      ExtractOptions options = options_of(beside[i]);
      options.execution.threads = aside.threads;
      // Stages of several components at the same time would say nothing.
      options.execution.progress = [&](const char*, double) {
        return !aside.progress || aside.progress(kSideBySideStage, together.share());
      };
      together.begin(work(beside[i]));
      extract_one(beside[i], options);
      together.end(work(beside[i]));
    });
  }

  void extract_one(Index c, const ExtractOptions& options) {
    SurfacePart own = surface_part(surface_, own_[c]);
    vertex_[c] = std::move(own.vertex);
    std::optional<SurfacePart> bounds;
    if (solids_.faces[c].size() > own_[c].size())
      bounds = solid_part(surface_, solids_.faces[c], own_[c].size(), own.surface.frame);
    part_[c] = extract_component(std::move(own.surface), bounds ? &bounds->surface : nullptr, options);
  }

  const SurfaceSnapshot& surface_;
  const ComponentSolids& solids_;
  const ExtractOptions& options_;
  std::vector<ExtractResult> part_;         // per component
  std::vector<std::vector<Index>> own_;     // per component: its faces
  std::vector<std::vector<Index>> vertex_;  // per component: its vertices
};

inline ExtractResult extract_componentwise(SurfaceSnapshot surface, const ExtractOptions& options) {
  ExtractResult result;
  result.surface = std::move(surface);
  const ComponentSolids solids = find_component_solids(result.surface, options.execution.progress);
  ComponentwiseExtraction(result.surface, solids, options).run_into(result);
  const auto cavities = std::count(solids.cavity.begin(), solids.cavity.end(), 1);
  if (cavities > 0)
    result.warnings.push_back(std::to_string(cavities) + (cavities == 1 ? " cavity" : " cavities") +
                              " found: each has a skeleton of its own, which lies in the hollow, and the "
                              "solid round it keeps clear of it");
  return result;
}

inline ExtractResult extract_pieces(SurfaceSnapshot surface, const ExtractOptions& options) {
  return surface.component_count > 1 ? extract_componentwise(std::move(surface), options)
                                     : extract_component(std::move(surface), nullptr, options);
}

}  // namespace detail
}  // namespace mspskel
