#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/base/linkage.h"
#include "mspskel/collapse/detail/component_slabs.h"
#include "mspskel/collapse/detail/flat_regions.h"
#include "mspskel/collapse/detail/homology_generators.h"
#include "mspskel/collapse/detail/linking_cocycles.h"
#include "mspskel/collapse/detail/small_handles_impl.h"
#include "mspskel/collapse/label_rank.h"

namespace mspskel {
namespace detail {

// Values on loops by their numbers, in any order: those of a loop add up. Few of them differ from zero,
// however many loops there are.
using LoopValues = std::vector<std::pair<Index, std::int64_t>>;

inline CocycleLabel summed(LoopValues values) {
  std::sort(values.begin(), values.end());
  std::vector<CocycleLabel::Entry> entries;
  for (std::size_t i = 0; i < values.size();) {
    const Index loop = values[i].first;
    std::int64_t sum = 0;
    for (; i < values.size() && values[i].first == loop; ++i) sum += values[i].second;
    if (sum != 0) entries.push_back({loop, static_cast<std::int32_t>(sum)});
  }
  return CocycleLabel::from_entries(std::move(entries));
}

// Finds the cocycles of all components, source by source.
class CocycleSearch {
 public:
  CocycleSearch(const SurfaceSnapshot& surface, const CocycleOptions& options,
                const ProgressCallback& progress);

  VolumeCocycles run(std::vector<SliceCandidate> candidates);

 private:
  struct Component {
    ComponentElements elements;
    std::optional<ComponentSlabs> slabs;  // of the elements
    HomologyGenerators generators;
    int outward = 1;  // −1: its faces are turned inward
    Index genus = 0;
    LabelRank echelon;  // of the kept cocycles' values on the 2g loops
    std::int64_t sections_left = 0;
    std::vector<std::pair<FlatRegion, Plane>> holed;  // met on the way

    bool open() const { return echelon.rank() < genus; }
  };

  void index_loops();
  bool any_open() const;
  void try_slices(std::vector<SliceCandidate> candidates, bool only_on_loops);
  void try_plane(Component& component, Index vertex, const Vector3& normal);
  bool independent_contour(Component& component, Index vertex, const Vector3& normal);
  std::vector<SliceCandidate> planes_across_loops(const Component& component, double angle) const;
  void try_own_planes();
  void try_holed_regions(Component& component);
  void try_linking(Component& component);
  void complete(Component& component);

  CocycleLabel crossings(const std::vector<Index>& halfedges) const;
  bool keep_region(Component& component, const FlatRegion& region, const Plane& plane);
  void keep_periods(Component& component, CocycleSource source, Index loop, const CocycleLabel& periods);
  void write_labels();

  struct Use {
    Index loop, sign;
  };

  const SurfaceSnapshot& surface_;
  const CocycleOptions& options_;
  const ProgressCallback& progress_;
  std::vector<Component> components_;
  // Loops of its component that run along half-edge h: uses_[slot_[h] .. slot_[h + 1]).
  std::vector<Index> slot_;
  std::vector<Use> uses_;
  std::vector<bool> on_loop_, touched_;  // per vertex
  std::vector<std::uint8_t> positive_;   // per vertex, of the plane that is looked at
  VolumeCocycles result_;
};

inline CocycleSearch::CocycleSearch(const SurfaceSnapshot& surface, const CocycleOptions& options,
                                    const ProgressCallback& progress)
    : surface_(surface), options_(options), progress_(progress) {
  std::vector<ComponentElements> elements = component_elements(surface);
  std::vector<HomologyGenerators> generators = homology_generators(surface, elements);
  components_.resize(elements.size());
  for (std::size_t c = 0; c < elements.size(); ++c) {
    Component& component = components_[c];
    component.genus = elements[c].genus();
    component.sections_left = std::int64_t{options.sections_per_handle} * (component.genus + 1);
    double volume = 0;
    for (const Index f : elements[c].faces)
      volume += surface.position[surface.origin[3 * f]].dot(
          surface.position[surface.origin[3 * f + 1]].cross(surface.position[surface.origin[3 * f + 2]]));
    component.outward = volume < 0 ? -1 : 1;
    component.elements = std::move(elements[c]);
    component.slabs.emplace(surface, component.elements);
    component.generators = std::move(generators[c]);
    result_.genus.push_back(component.genus);
  }
  result_.label.resize(surface.origin.size());
}

inline bool CocycleSearch::any_open() const {
  return std::any_of(components_.begin(), components_.end(), [](const Component& c) { return c.open(); });
}

inline void CocycleSearch::index_loops() {
  slot_.assign(surface_.origin.size() + 1, 0);
  on_loop_.assign(surface_.position.size(), false);
  positive_.resize(surface_.position.size());
  const auto each = [&](auto&& visit) {
    for (const Component& component : components_)
      for (std::size_t i = 0; i < component.generators.loop.size(); ++i)
        for (const Index h : component.generators.loop[i]) {
          visit(h, Use{static_cast<Index>(i), 1});
          visit(surface_.twin[h], Use{static_cast<Index>(i), -1});
        }
  };
  each([&](Index h, Use) {
    ++slot_[h + 1];
    on_loop_[surface_.origin[h]] = true;
  });
  for (std::size_t i = 1; i < slot_.size(); ++i) slot_[i] += slot_[i - 1];
  uses_.resize(static_cast<std::size_t>(slot_.back()));
  std::vector<Index> fill(slot_.begin(), slot_.end() - 1);
  each([&](Index h, Use use) { uses_[fill[h]++] = use; });
}

// Values on the generator loops of the cocycle that is 1 on these half-edges and −1 on their twins.
inline CocycleLabel CocycleSearch::crossings(const std::vector<Index>& halfedges) const {
  LoopValues values;
  for (const Index h : halfedges)
    for (Index i = slot_[h]; i < slot_[h + 1]; ++i) values.push_back({uses_[i].loop, uses_[i].sign});
  return summed(std::move(values));
}

// Whether some contour through the vertex bounds material and has new values on the loops: a look at the
// contour alone, before the whole component is cut. Marks the vertices beside the contours as touched.
inline bool CocycleSearch::independent_contour(Component& component, Index vertex, const Vector3& normal) {
  const PlaneSide side{surface_, {normal, normal.dot(surface_.position[vertex])}, vertex};
  const Index first = surface_.vertex_halfedge[vertex];
  bool found = false;
  Index h = first;
  do {
    const Index target = surface_.target(h), apex = surface_.apex(h);
    if (side(target) >= 0 && side(apex) < 0) {
      const Contour contour = walk_contour(surface_, surface_.twin[SurfaceSnapshot::next(h)], side);
      ++result_.contours_traced;
      for (const Index crossed : contour.halfedge)
        touched_[surface_.origin[crossed]] = touched_[surface_.target(crossed)] = true;
      if (contour.area * component.outward > 0)
        found = found || !component.echelon.depends(crossings(contour.halfedge));
    }
    h = surface_.next_outgoing(h);
  } while (h != first);
  return found;
}

inline bool CocycleSearch::keep_region(Component& component, const FlatRegion& region, const Plane& plane) {
  std::vector<Index> halfedges;
  for (const Contour& contour : region.contours)
    halfedges.insert(halfedges.end(), contour.halfedge.begin(), contour.halfedge.end());
  if (!component.echelon.insert(crossings(halfedges))) return false;
  VolumeCocycle cocycle;
  cocycle.source = region.is_disc() ? CocycleSource::kDisc : CocycleSource::kHoledRegion;
  ++(region.is_disc() ? result_.discs : result_.holed_regions);
  cocycle.component = surface_.component[surface_.origin[halfedges.front()]];
  for (const Index h : halfedges) cocycle.values.push_back({h, 1});
  cocycle.plane = plane;
  cocycle.contours = region.contours;
  result_.cocycle.push_back(std::move(cocycle));
  return true;
}

// Cuts the component beside the vertex, keeps the discs that are new and remembers the regions with
// holes.
inline void CocycleSearch::try_plane(Component& component, Index vertex, const Vector3& normal) {
  constexpr double kWindow =
      0.05;  // of the longest edge at the vertex: the contour stays nearly where it was
  constexpr std::size_t kHoledRegions = 16;
  double longest = 0;
  const Index first = surface_.vertex_halfedge[vertex];
  Index h = first;
  do {
    longest = std::max(longest, (surface_.position[surface_.target(h)] - surface_.position[vertex]).norm());
    h = surface_.next_outgoing(h);
  } while (h != first);
  --component.sections_left;
  ++result_.sections;
  report_progress(progress_, "cocycles", 0.2);
  const double height = normal.dot(surface_.position[vertex]), window = kWindow * longest;
  const ComponentElements& near = (*component.slabs)(normal, height - window, height);
  const auto plane = generic_plane(surface_, near.vertices, vertex, normal, window);
  if (!plane) return;
  for (FlatRegion& region : flat_regions(surface_, near, component.outward, *plane, positive_)) {
    if (!component.open()) return;
    if (region.is_disc() && options_.use_discs)
      keep_region(component, region, *plane);
    else if (!region.is_disc() &&
             component.holed.size() < kHoledRegions * static_cast<std::size_t>(component.genus))
      component.holed.emplace_back(std::move(region), *plane);
  }
}

// A contour that tells loops apart crosses one of them, so it passes beside a vertex of a loop. Vertices that
// a contour has passed are skipped: neighbours have nearly the same slice.
inline void CocycleSearch::try_slices(std::vector<SliceCandidate> candidates, bool only_on_loops) {
  const auto useless = [&](const SliceCandidate& c) {
    return only_on_loops != on_loop_[c.vertex] || !components_[surface_.component[c.vertex]].open();
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), useless), candidates.end());
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const SliceCandidate& a, const SliceCandidate& b) { return a.perimeter < b.perimeter; });
  touched_.assign(surface_.position.size(), false);
  for (const SliceCandidate& c : candidates) {
    Component& component = components_[surface_.component[c.vertex]];
    if (!component.open() || component.sections_left <= 0 || touched_[c.vertex]) continue;
    if (independent_contour(component, c.vertex, c.normal)) try_plane(component, c.vertex, c.normal);
  }
}

// At even steps along each loop a plane that holds the surface normal and lies across the loop, turned round
// the surface normal by the given angle.
inline std::vector<SliceCandidate> CocycleSearch::planes_across_loops(const Component& component,
                                                                      double angle) const {
  std::vector<SliceCandidate> candidates;
  for (const std::vector<Index>& loop : component.generators.loop) {
    const std::size_t n = loop.size(), reach = std::max<std::size_t>(1, n / 12);
    const auto at = [&](std::size_t i) { return surface_.position[surface_.origin[loop[i % n]]]; };
    const auto planes = std::min(n, static_cast<std::size_t>(options_.own_planes));
    for (std::size_t k = 0; k < planes; ++k) {
      const std::size_t i = k * n / planes;
      const Index v = surface_.origin[loop[i]];
      const Vector3& axis = surface_.normal[v];
      Vector3 across = at(i + reach) - at(i + n - reach);
      across -= across.dot(axis) * axis;
      if (across.norm() < 1e-9) continue;
      candidates.push_back({v, Eigen::AngleAxisd(angle, axis) * across.normalized(), 0.0});
    }
  }
  return candidates;
}

inline void CocycleSearch::try_own_planes() {
  constexpr int kAngles = 4;
  for (int k = 0; k < kAngles && any_open(); ++k) {
    std::vector<SliceCandidate> planes;
    for (const Component& component : components_) {
      if (!component.open()) continue;
      const auto more = planes_across_loops(component, k * kPi / kAngles);
      planes.insert(planes.end(), more.begin(), more.end());
    }
    try_slices(std::move(planes), true);
  }
}

inline void CocycleSearch::try_holed_regions(Component& component) {
  std::stable_sort(component.holed.begin(), component.holed.end(),
                   [](const auto& a, const auto& b) { return a.first.perimeter < b.first.perimeter; });
  for (const auto& [region, plane] : component.holed)
    if (component.open()) keep_region(component, region, plane);
  component.holed.clear();
}

// The cocycle with the given values on the loops: the dual loops are cocycles with unit vectors as values.
inline void CocycleSearch::keep_periods(Component& component, CocycleSource source, Index loop,
                                        const CocycleLabel& periods) {
  if (!component.echelon.insert(periods)) return;
  VolumeCocycle cocycle;
  cocycle.source = source;
  ++(source == CocycleSource::kLinking ? result_.linking : result_.completions);
  cocycle.component = surface_.component[component.elements.vertices.front()];
  cocycle.loop = linking::polygon(surface_, component.generators.dual_loop[loop]);
  std::vector<std::pair<Index, std::int64_t>> terms;
  for (const auto& [j, value] : periods.entries())
    for (const Index h : component.generators.dual_loop[static_cast<std::size_t>(j)]) {
      const Index t = surface_.twin[h];
      terms.push_back({std::min(h, t), h < t ? value : -value});
    }
  std::sort(terms.begin(), terms.end());
  for (std::size_t i = 0; i < terms.size();) {
    std::int64_t sum = 0;
    const Index h = terms[i].first;
    for (; i < terms.size() && terms[i].first == h; ++i) sum += terms[i].second;
    if (sum != 0) cocycle.values.push_back({h, static_cast<std::int32_t>(sum)});
  }
  result_.cocycle.push_back(std::move(cocycle));
}

inline void CocycleSearch::try_linking(Component& component) {
  LinkingPeriods periods(surface_, component.generators, component.outward);
  // Short loops first: each has to be filled, and their surfaces are what later ways are asked about.
  const std::vector<std::vector<Index>>& dual = component.generators.dual_loop;
  std::vector<Index> order(dual.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return dual[a].size() < dual[b].size(); });
  for (std::size_t i = 0; i < order.size() && component.open(); ++i) {
    if (i % 16 == 0) report_progress(progress_, "cocycles", 0.7);
    const Index loop = order[i];
    if (const auto of_loop = periods(loop))
      keep_periods(component, CocycleSource::kLinking, loop, summed(*of_loop));
  }
}

inline void CocycleSearch::complete(Component& component) {
  const std::size_t n = component.generators.loop.size();
  for (std::size_t i = 0; i < n && component.open(); ++i) {
    const auto loop = static_cast<Index>(i);
    keep_periods(component, CocycleSource::kCompletion, loop, CocycleLabel::unit(loop));
  }
}

inline void CocycleSearch::write_labels() {
  std::stable_sort(result_.cocycle.begin(), result_.cocycle.end(),
                   [](const VolumeCocycle& a, const VolumeCocycle& b) { return a.component < b.component; });
  result_.rank = static_cast<Index>(result_.cocycle.size());
  for (Index i = 0; i < result_.rank; ++i)
    for (const auto& [h, value] : result_.cocycle[i].values) {
      result_.label[h] += CocycleLabel::unit(i, value);
      result_.label[surface_.twin[h]] += CocycleLabel::unit(i, -value);
    }
}

inline VolumeCocycles CocycleSearch::run(std::vector<SliceCandidate> candidates) {
  if (!any_open()) return std::move(result_);
  index_loops();
  if (options_.use_discs || options_.use_holed_regions) {
    try_slices(candidates, true);
    try_own_planes();
    if (any_open()) try_slices(std::move(candidates), false);
  }
  report_progress(progress_, "cocycles", 0.7);
  for (Component& component : components_) {
    if (component.open() && options_.use_holed_regions) try_holed_regions(component);
    if (component.open()) try_linking(component);
    if (component.open()) complete(component);
  }
  write_labels();
  report_progress(progress_, "cocycles", 1.0);
  return std::move(result_);
}

}  // namespace detail

MSPSKEL_INLINE VolumeCocycles compute_volume_cocycles(const SurfaceSnapshot& surface,
                                                      std::vector<SliceCandidate> candidates,
                                                      const CocycleOptions& options,
                                                      const ProgressCallback& progress) {
  validate(options);
  for (const SliceCandidate& c : candidates)
    if (c.vertex < 0 || c.vertex >= surface.vertex_count() || surface.vertex_halfedge[c.vertex] == kNone ||
        !c.normal.allFinite())
      throw UsageError("slice candidate at vertex " + std::to_string(c.vertex) + " is not on the surface");
  report_progress(progress, "cocycles", 0.0);
  VolumeCocycles result = detail::CocycleSearch(surface, options, progress).run(std::move(candidates));
  if (leave_out_small_handles(surface, options.smallest_handle, result, progress)) return result;
  CocycleOptions linking = options;
  linking.use_discs = linking.use_holed_regions = false;
  result = detail::CocycleSearch(surface, linking, progress).run({});
  leave_out_small_handles(surface, options.smallest_handle, result, progress);
  return result;
}

}  // namespace mspskel
