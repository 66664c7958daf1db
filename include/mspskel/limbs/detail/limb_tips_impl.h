#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mspskel/base/linkage.h"
#include "mspskel/base/value_at_rank.h"
#include "mspskel/limbs/detail/body_ends.h"
#include "mspskel/limbs/detail/end_target.h"
#include "mspskel/limbs/detail/flat_ends.h"
#include "mspskel/limbs/detail/limb_search.h"
#include "mspskel/limbs/detail/plates.h"
#include "mspskel/mesh/inner_distance.h"

namespace mspskel {

MSPSKEL_INLINE std::vector<bool> components_with_limbs(const SurfaceSnapshot& surface,
                                                       const std::vector<LimbTip>& tips) {
  std::vector<bool> limbed(static_cast<std::size_t>(surface.component_count), false);
  for (const LimbTip& tip : tips)
    if (tip.kind == TipKind::kLimb || tip.kind == TipKind::kEar || tip.kind == TipKind::kFlatEnd)
      limbed[surface.component[tip.vertex]] = true;
  return limbed;
}

namespace detail {

// The vertex of the greatest finite value in each component; kNone where there is none.
template <class Value>
std::vector<Index> greatest_of_components(const SurfaceSnapshot& surface, Value value) {
  std::vector<Index> greatest(static_cast<std::size_t>(surface.component_count), kNone);
  std::vector<double> most(greatest.size(), -std::numeric_limits<double>::infinity());
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (surface.vertex_halfedge[v] == kNone) continue;
    const Index c = surface.component[v];
    const double x = value(v);
    if (!(std::isfinite(x) && x > most[c])) continue;
    most[c] = x;
    greatest[c] = v;
  }
  return greatest;
}

// Distances along the surface from one vertex of each component; infinity where that is kNone.
inline std::vector<double> surface_distances(const SurfaceSnapshot& surface, const SurfaceWays& ways,
                                             const std::vector<Index>& from) {
  std::vector<double> distance(surface.position.size(), std::numeric_limits<double>::infinity());
  for (const Index v : from)
    if (v != kNone) distance[v] = 0;
  ways.extend(std::vector<std::uint8_t>(distance.size(), 0), distance);
  return distance;
}

// A component without limbs or handles keeps its longest way: the two ends of it count as tips, without a
// depth. Where it has a handle, that is its skeleton.
inline void add_longest_ways(const SurfaceSnapshot& surface, const SurfaceWays& ways,
                             const std::vector<double>& distance, const std::vector<Index>& handles,
                             std::vector<LimbTip>& tips) {
  constexpr double kCap = 0.85;  // of the way
  std::vector<Index> from = greatest_of_components(surface, [&](Index v) { return distance[v]; });
  for (const LimbTip& tip : tips) from[surface.component[tip.vertex]] = kNone;
  for (std::size_t c = 0; c < from.size(); ++c)
    if (handles[c] > 0) from[c] = kNone;
  if (std::all_of(from.begin(), from.end(), [](Index v) { return v == kNone; })) return;
  const std::vector<double> way = surface_distances(surface, ways, from);
  const std::vector<Index> to = greatest_of_components(surface, [&](Index v) { return way[v]; });
  const std::vector<double> back = surface_distances(surface, ways, to);
  const auto add = [&](Index c, Index end, const std::vector<double>& along) {
    LimbTip tip;
    tip.kind = TipKind::kWayEnd;
    tip.vertex = end;
    for (Index v = 0; v < surface.vertex_count(); ++v)
      if (surface.component[v] == c && along[v] > kCap * along[end]) tip.cap.push_back(v);
    tips.push_back(std::move(tip));
  };
  for (Index c = 0; c < surface.component_count; ++c) {
    if (from[c] == kNone) continue;
    add(c, from[c], back);
    add(c, to[c], way);
  }
}

// A point in the solid near the middle of each component: the mean centre of the slices whose vertices'
// greatest distance along the surface to four far vertices is nearly the least; of the least alone where that
// lies outside.
inline std::vector<std::optional<Vector3>> middle_of_components(const SurfaceSnapshot& surface,
                                                                const SurfaceWays& ways,
                                                                const BoundingVolumeHierarchy& solid,
                                                                const VertexSlices& slices) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr int kFar = 4;
  constexpr double kNear = 0.1;  // farther than the least by this share counts no more
  const auto count = static_cast<std::size_t>(surface.component_count);
  const std::size_t n = surface.position.size();
  std::vector<Vector3> centroid(count, Vector3::Zero());
  std::vector<double> area(count, 0.0);
  for (std::size_t v = 0; v < n; ++v) {
    if (surface.vertex_halfedge[v] == kNone) continue;
    centroid[surface.component[v]] += surface.vertex_area[v] * surface.position[v];
    area[surface.component[v]] += surface.vertex_area[v];
  }
  std::vector<Index> from = greatest_of_components(surface, [&](Index v) {
    const Index c = surface.component[v];
    return (area[c] * surface.position[v] - centroid[c]).squaredNorm();
  });
  std::vector<double> nearest(n, kInfinity), farthest(n, 0.0);
  for (int k = 0; k < kFar; ++k) {
    const std::vector<double> distance = surface_distances(surface, ways, from);
    for (std::size_t v = 0; v < n; ++v) {
      nearest[v] = std::min(nearest[v], distance[v]);
      farthest[v] = std::max(farthest[v], distance[v]);
    }
    from = greatest_of_components(surface, [&](Index v) { return nearest[v]; });
  }
  const std::vector<Index> least =
      greatest_of_components(surface, [&](Index v) { return slices.valid[v] ? -farthest[v] : -kInfinity; });
  std::vector<std::optional<Vector3>> middle(count);
  for (std::size_t c = 0; c < count; ++c) {
    const Index v = least[c];
    if (v == kNone) continue;
    // One vertex's slice would make the middle jump where several are as good.
    Vector3 mean = Vector3::Zero();
    double weight = 0;
    for (std::size_t w = 0; w < n; ++w) {
      if (!slices.valid[w] || surface.component[w] != surface.component[v]) continue;
      const double share = surface.vertex_area[w] * (1 - (farthest[w] / farthest[v] - 1) / kNear);
      if (!(share > 0)) continue;
      mean += share * slices.centre[w];
      weight += share;
    }
    const Vector3 inward = -surface.normal[v];
    const Vector3 start = surface.position[v] + 1e-6 * inward;
    if (weight > 0 && solid.inside(mean / weight))
      middle[c] = mean / weight;
    else if (solid.inside(slices.centre[v]))
      middle[c] = slices.centre[v];
    else if (const auto hit = solid.first_hit(start, inward))
      middle[c] = start + 0.5 * hit->distance * inward;
  }
  return middle;
}

// The centroid of the surface about some vertices.
inline Vector3 middle_of(const SurfaceSnapshot& surface, const std::vector<Index>& vertices) {
  Vector3 sum = Vector3::Zero();
  double area = 0;
  for (const Index v : vertices) {
    sum += surface.vertex_area[v] * surface.position[v];
    area += surface.vertex_area[v];
  }
  return area > 0 ? Vector3(sum / area) : surface.position[vertices.front()];
}

}  // namespace detail

MSPSKEL_INLINE void drop_tips_in_walls(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                                       const std::vector<bool>& shells, std::vector<LimbTip>& tips) {
  constexpr double kThin = 0.45;
  const auto in_wall = [&](const LimbTip& tip) {
    if (!shells[surface.component[tip.vertex]] || tip.is_lobe) return false;
    if (tip.measures.half_chord >= kThin * tip.measures.half_width) return false;
    std::vector<double> chords;
    for (const Index v : tip.cap) chords.push_back(detail::half_chord(surface, solid, v));
    return detail::value_at_rank(std::move(chords), 0.5) < kThin * tip.measures.half_width;
  };
  tips.erase(std::remove_if(tips.begin(), tips.end(), in_wall), tips.end());
}

namespace detail {

// Adds the ends of the bodies that have limbs or handles. Ears of components with neither limbs nor such ends
// go: on a plain body they are corners.
inline void add_body_ends(const SurfaceSnapshot& surface, const std::vector<bool>& shells,
                          const BodyEnds& bodies, const std::vector<Index>& handles,
                          std::vector<LimbTip>& tips) {
  std::vector<bool> has_ears(shells.size(), false);
  for (Index c = 0; c < surface.component_count; ++c) {
    has_ears[c] = bodies.limb_count(c) > 0;
    const bool loops = handles[c] > bodies.handles_of_limbs(c);
    if ((shells[c] || !has_ears[c]) && !loops) {
      if (std::optional<LimbTip> foot = bodies.foot(c)) tips.push_back(std::move(*foot));
    } else if (!shells[c]) {
      for (LimbTip& end : bodies.run(c, loops)) {
        has_ears[c] = true;
        tips.push_back(std::move(end));
      }
    }
  }
  const auto is_corner = [&](const LimbTip& tip) {
    return tip.kind == TipKind::kEar && !has_ears[surface.component[tip.vertex]];
  };
  tips.erase(std::remove_if(tips.begin(), tips.end(), is_corner), tips.end());
}

// Whether the ends of a body lie on one straight line, so that its axis stands for them.
inline bool are_opposite(const std::vector<const FlatEnd*>& ends) {
  constexpr double kOpposite = -0.85;
  return ends.size() == 1 || (ends.size() == 2 && ends[0]->normal.dot(ends[1]->normal) < kOpposite);
}

// Whether the straight way inward from an end is longer than that is wide: the hub of a wheel is not.
inline bool is_long_behind(const FlatEnd& end, const BoundingVolumeHierarchy& solid) {
  constexpr double kLonger = 1.25;  // as the stretch of a body that has an axis
  return !solid.first_hit(end.tip.target, -end.normal, 2 * kLonger * end.tip.flat_end);
}

// Radii of a flat end within which others are the same end.
inline constexpr double kNearFlatEnd = 1.5;

// Whether a tip lies in the cap of a flat end.
inline bool lies_in(const LimbTip& tip, const FlatEnd& end) {
  return std::binary_search(end.vertices.begin(), end.vertices.end(), tip.vertex);
}

// Whether a tip that is no way's is that of the tube that a flat end cuts off. A body may end in its middle,
// which is near to many caps.
inline bool stands_for(const LimbTip& tip, const FlatEnd& end) {
  constexpr double kAtEnd = 0.5;
  const double distance = (tip.target - end.tip.target).norm(), radius = end.tip.flat_end;
  if (tip.kind == TipKind::kWayEnd) return false;
  if (tip.kind == TipKind::kBodyEnd) return distance <= kAtEnd * radius;
  return lies_in(tip, end) || distance <= radius ||
         (distance <= kNearFlatEnd * radius &&
          std::find(tip.cap.begin(), tip.cap.end(), end.tip.vertex) != tip.cap.end());
}

// Whether a tip's arc is to end in the middle of a flat end, which nothing stands on where a body ends.
inline bool ends_in(const LimbTip& tip, const FlatEnd& end) {
  if (tip.kind == TipKind::kBodyEnd) return !end.carries && stands_for(tip, end);
  return tip.kind != TipKind::kWayEnd && lies_in(tip, end);
}

// Adds the flat ends that no tip stands for. A body without handles or other tips than the ends of its
// longest way has an axis if its flat ends are opposite; else they take the place of ways that end in them,
// at any place near the rim. A limb or body of which one is the end is led to its middle.
inline void add_flat_ends(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
                          const std::vector<FlatEnd>& ends, const std::vector<Index>& handles,
                          std::vector<LimbTip>& tips) {
  std::vector<std::vector<const FlatEnd*>> of_component(static_cast<std::size_t>(surface.component_count));
  for (const FlatEnd& end : ends) of_component[surface.component[end.tip.vertex]].push_back(&end);
  std::vector<bool> has_tip(of_component.size(), false);
  for (const LimbTip& tip : tips)
    if (tip.kind != TipKind::kWayEnd) has_tip[surface.component[tip.vertex]] = true;
  for (std::size_t c = 0; c < of_component.size(); ++c) {
    const bool opposite = !has_tip[c] && are_opposite(of_component[c]);
    if (opposite && handles[c] == 0) continue;
    for (const FlatEnd* const end : of_component[c]) {
      if (opposite && !is_long_behind(*end, solid)) continue;
      for (LimbTip& tip : tips)
        if (ends_in(tip, *end)) {
          tip.flat_end = end->tip.flat_end;
          tip.cap = end->tip.cap;
          tip.target = end->tip.target;
        }
      if (std::any_of(tips.begin(), tips.end(), [&](const LimbTip& tip) { return stands_for(tip, *end); }))
        continue;
      const auto way_ends_near = [&](const LimbTip& tip) {
        return tip.kind == TipKind::kWayEnd &&
               (surface.position[tip.vertex] - end->tip.target).norm() <= kNearFlatEnd * end->tip.flat_end;
      };
      tips.erase(std::remove_if(tips.begin(), tips.end(), way_ends_near), tips.end());
      tips.push_back(end->tip);
    }
  }
}

// A plate is one limb or none. What was told by a corner of it goes, be that the corner alone or most of the
// plate, as it reaches from afar, and so does what is less deep than the plate is thick. Where it stands out
// it takes the place of a longer limb, too, of which it is the end. Other limbs that end in it stay, and
// stand for it, as any do where no crease shows how deep it is; so do several that are no corners, as the
// lobes of a forked tail.
inline void judge_as_one(Plate plate, std::vector<FoundLimb>& limbs) {
  constexpr double kSlack = 1.2, kMost = 0.6, kAll = 1.25;  // of the plate's depth
  const std::vector<Index>& part = plate.limb.part;
  const LimbMeasures& whole = plate.limb.tip.measures;
  const double thickness = 2 * whole.half_thickness;
  const auto ends_in_plate = [&](const FoundLimb& limb) {
    return std::binary_search(part.begin(), part.end(), limb.tip.vertex);
  };
  const auto is_corner = [&](const FoundLimb& limb) {
    const LimbMeasures& m = limb.tip.measures;
    return m.depth < thickness ||
           is_slab_corner(m.depth, m.depth_over_mouth, m.slenderness, thickness, kSlack);
  };
  const bool forks = std::count_if(limbs.begin(), limbs.end(), [&](const FoundLimb& limb) {
                       return ends_in_plate(limb) && !is_corner(limb);
                     }) > 1;
  const auto is_most = [&](const FoundLimb& limb) {
    const double depth = limb.tip.measures.depth;
    return depth > kMost * whole.depth && (plate.stands_out || depth < kAll * whole.depth);
  };
  const auto goes = [&](const FoundLimb& limb) {
    return ends_in_plate(limb) && (is_corner(limb) || (!forks && is_most(limb)));
  };
  if (plate.from_crease) limbs.erase(std::remove_if(limbs.begin(), limbs.end(), goes), limbs.end());
  if (!plate.stands_out || std::any_of(limbs.begin(), limbs.end(), ends_in_plate)) return;
  plate.limb.tip.plate = part;
  limbs.push_back(std::move(plate.limb));
}

}  // namespace detail

MSPSKEL_INLINE std::vector<LimbTip> find_limb_tips(const SurfaceSnapshot& surface,
                                                   const BoundingVolumeHierarchy& solid,
                                                   const VertexSlices& slices, const LimbOptions& options,
                                                   const Execution& execution) {
  const SurfaceWays ways(surface);
  const auto middle = detail::middle_of_components(surface, ways, solid, slices);
  const std::vector<double> distance = inner_distances(surface, ways, solid, middle, execution);
  std::vector<detail::FoundLimb> limbs =
      detail::LimbTipSearch(surface, solid, slices, options, distance, execution.progress).run();
  for (detail::Plate& plate : detail::PlateSearch(surface, solid, options, execution.progress).run(distance))
    detail::judge_as_one(std::move(plate), limbs);
  constexpr double kLobe = 0.45;  // half of a tube and of a plank, a third of a disc round its stem
  std::vector<LimbTip> tips;
  for (const detail::FoundLimb& limb : limbs) {
    report_progress(execution.progress, "arcs", 0.0);
    tips.push_back(limb.tip);
    tips.back().position = surface.position[limb.tip.vertex];
    const LimbMeasures& m = limb.tip.measures;
    tips.back().is_lobe = m.mean_depth >= kLobe && m.slenderness >= kFinger * options.slenderness &&
                          solid.inside(detail::middle_of(surface, limb.part));
    detail::keep_target_well_inside(tips.back(), solid);
  }
  const std::vector<bool> shells = find_shells(surface, solid, slices, execution.progress);
  drop_tips_in_walls(surface, solid, shells, tips);
  const std::vector<Index> handles = handles_of_components(surface);
  detail::add_body_ends(surface, shells, detail::BodyEnds(surface, solid, limbs), handles, tips);
  detail::add_longest_ways(surface, ways, distance, handles, tips);
  detail::add_flat_ends(surface, solid, detail::FlatEndSearch(surface, solid, execution.progress).run(),
                        handles, tips);
  for (LimbTip& tip : tips) tip.position = surface.position[tip.vertex];
  return tips;
}

MSPSKEL_INLINE std::vector<LimbTip> on_coarser_surface(std::vector<LimbTip> tips,
                                                       const std::vector<Index>& coarse_vertex) {
  for (LimbTip& tip : tips) {
    tip.vertex = coarse_vertex[tip.vertex];
    for (std::vector<Index>* part : {&tip.cap, &tip.plate, &tip.head}) {
      for (Index& v : *part) v = coarse_vertex[v];
      std::sort(part->begin(), part->end());
      part->erase(std::unique(part->begin(), part->end()), part->end());
    }
  }
  return tips;
}

}  // namespace mspskel
