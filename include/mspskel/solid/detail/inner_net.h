// The middle of the solid as a graph: the surface's own, each vertex moved to the middle of its inward chord.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/detail/box_index.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/solid/detail/gates.h"
#include "mspskel/solid/detail/inward_chord.h"

namespace mspskel {
namespace detail {

// Which surface the paths run beside. Few triangles round a limb are all that there is on the input, and what
// coarsening left on a coarser one.
enum class InnerSurface { kInput, kCoarser };

// Its nodes are the vertices, and after them the gates of an input. Nothing is computed before prepare(), and
// distances to the surface and what meets it only where a search comes by: many meshes need no path at all.
// Any surface within the solid will do: no vertex of it goes in or out.
class InnerNet {
 public:
  // What is known of the way along an edge.
  enum class EdgeState : std::uint8_t { kUnknown, kInside, kCrosses };

  InnerNet(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid, const Execution& execution,
           InnerSurface kind)
      : surface_(surface), solid_(solid), execution_(execution), kind_(kind) {}

  bool is_input() const { return kind_ == InnerSurface::kInput; }
  const SurfaceSnapshot& surface() const { return surface_; }
  const BoundingVolumeHierarchy& solid() const { return solid_; }
  const Execution& execution() const { return execution_; }

  // Once, before anything below. Cost: two rays a vertex.
  void prepare() {
    if (!clearance_.empty()) return;
    point_ = surface_.position;
    clearance_.assign(surface_.position.size(), 0.0);
    parallel_for(
        surface_.vertex_count(), "arcs", execution_, [] { return 0; }, [&](Index v, int) { place(v); });
    add_gates();
    for (Index v = 0; v < node_count(); ++v)
      if (usable(v)) index_.add(v, point_[v], point_[v]);
    index_.build();
    edge_.assign(surface_.origin.size(), EdgeState::kUnknown);
  }

  Index node_count() const { return static_cast<Index>(point_.size()); }
  bool usable(Index v) const { return clearance_[v] != 0; }
  const Vector3& point(Index v) const { return point_[v]; }

  // Searches that have come by many points come by most: then the others are found on all threads.
  double clearance(Index v) {
    constexpr Index kShare = 4;
    if (clearance_[v] != kUnknown) return clearance_[v];
    if (++asked_ != node_count() / kShare) return clearance_[v] = solid_.distance(point_[v]);
    parallel_for(
        node_count(), "arcs", execution_, [] { return 0; },
        [&](Index w, int) {
          if (clearance_[w] == kUnknown) clearance_[w] = solid_.distance(point_[w]);
        });
    return clearance_[v];
  }

  // Among the vertices that `allowed` holds for; kNone if none of them has a point.
  template <class Allowed>
  Index nearest(const Vector3& x, Allowed allowed) const {
    Index best = kNone;
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (usable(v) && allowed(v) &&
          (best == kNone || (point_[v] - x).squaredNorm() < (point_[best] - x).squaredNorm()))
        best = v;
    return best;
  }

  // Of a step from or to a point with this distance to the surface.
  static double step_cost(double length, double clearance) { return length / std::max(clearance, 1e-6); }

  // visit(w, cost) for the edges of a usable vertex to usable ones, whether they stay inside or not.
  template <class Visit>
  void for_each_edge(Index v, Visit visit) {
    const auto lead_to = [&](Index w) {
      if (usable(w) && w != v)
        visit(w, step_cost((point_[w] - point_[v]).norm(), std::min(clearance(v), clearance(w))));
    };
    const auto lead_to_gates_at = [&](Index w) { for_each_gate_at(w, lead_to); };
    if (v < surface_.vertex_count()) {
      for_each_neighbour(surface_, v, lead_to);
      if (gates_.empty()) return;
      lead_to_gates_at(v);
      for_each_neighbour(surface_, v, lead_to_gates_at);
      return;
    }
    for (const Index corner : gates_[v - surface_.vertex_count()].corner) {
      lead_to(corner);
      lead_to_gates_at(corner);
      for_each_neighbour(surface_, corner, [&](Index w) {
        lead_to(w);
        lead_to_gates_at(w);
      });
    }
  }

  // Of the edge from one neighbour to the other.
  EdgeState state(Index from, Index to) const {
    if (std::max(from, to) >= surface_.vertex_count()) return EdgeState::kUnknown;  // a gate
    return edge_[edge_between(from, to)];
  }

  // Whether the way along an edge, from one neighbour to the other, meets what bounds the solid. Searches
  // come by the same edges time after time, so the solid is asked once.
  bool edge_crosses(Index from, Index to) {
    if (std::max(from, to) >= surface_.vertex_count())  // a gate
      return solid_.segment_crosses(point_[from], point_[to]);
    const Index h = edge_between(from, to);
    if (edge_[h] == EdgeState::kUnknown)
      edge_[h] = solid_.segment_crosses(point_[from], point_[to]) ? EdgeState::kCrosses : EdgeState::kInside;
    return edge_[h] == EdgeState::kCrosses;
  }

  // The nearest inner points that x sees, and as many of those near the middle. Where chords from far away
  // have their middles, as those from the rim of a disc have in the middle of the disc, the ways to their
  // vertices are long ones.
  std::vector<std::pair<double, Index>> entries(const Vector3& x) {
    constexpr std::size_t kWanted = 8, kUsual = 64;
    std::vector<std::pair<double, Index>> near, far;
    std::size_t seen = 0;
    for (const std::size_t tried : {std::size_t{16}, kUsual, 16 * kUsual}) {
      const std::vector<std::pair<double, Index>> found = nearest_points(x, tried);
      for (; seen < found.size() && near.size() < kWanted; ++seen) {
        const auto& [distance, v] = found[seen];
        std::vector<std::pair<double, Index>>& kept = is_near_middle(v) ? near : far;
        if (kept.size() < kWanted && !solid_.segment_crosses(x, point_[v])) kept.push_back(found[seen]);
      }
      if (near.size() >= kWanted || (tried >= kUsual && (!near.empty() || far.empty()))) break;
    }
    near.insert(near.end(), far.begin(), far.end());
    return near;
  }

 private:
  static constexpr double kUnknown = -1.0;

  void place(Index v) {
    if (surface_.vertex_halfedge[v] == kNone) return;
    const auto chord = inward_chord(surface_, solid_, v);
    if (!chord) return;
    point_[v] = chord->start - 0.5 * chord->length * surface_.normal[v];
    clearance_[v] = kUnknown;
  }

  void add_gates() {
    if (!is_input()) return;
    gates_ = find_gates(surface_);
    for (std::size_t i = 0; i < gates_.size(); ++i) {
      const auto [a, b, c] = gates_[i].corner;
      const Vector3 middle = (surface_.position[a] + surface_.position[b] + surface_.position[c]) / 3;
      point_.push_back(middle);
      clearance_.push_back(solid_.inside(middle) ? kUnknown : 0.0);
    }
    if (gates_.empty()) return;
    first_gate_.assign(surface_.position.size() + 1, 0);
    for (const Gate& gate : gates_)
      for (const Index v : gate.corner) ++first_gate_[v + 1];
    std::partial_sum(first_gate_.begin(), first_gate_.end(), first_gate_.begin());
    gates_at_.resize(static_cast<std::size_t>(first_gate_.back()));
    std::vector<Index> next(first_gate_);
    for (std::size_t i = 0; i < gates_.size(); ++i)
      for (const Index v : gates_[i].corner)
        gates_at_[next[v]++] = surface_.vertex_count() + static_cast<Index>(i);
  }

  // visit(gate) for the gates with a corner at v.
  template <class Visit>
  void for_each_gate_at(Index v, Visit visit) const {
    for (Index i = first_gate_[v]; i < first_gate_[v + 1]; ++i) visit(gates_at_[i]);
  }

  // The half-edge between two neighbours. Cost: the fewer edges of the two.
  Index edge_between(Index from, Index to) const {
    Index out = surface_.vertex_halfedge[from], back = surface_.vertex_halfedge[to];
    while (true) {
      if (surface_.target(out) == to) return out;
      if (surface_.target(back) == from) return surface_.twin[back];
      out = surface_.next_outgoing(out);
      back = surface_.next_outgoing(back);
    }
  }

  // Whether half of the chord is not much longer than the way from its middle to the surface.
  bool is_near_middle(Index v) {
    constexpr double kMuch = 4;
    return v >= surface_.vertex_count() || (point_[v] - surface_.position[v]).norm() <= kMuch * clearance(v);
  }

  // The `count` points nearest to x, or all, by growing distance: from balls round it of growing radius.
  std::vector<std::pair<double, Index>> nearest_points(const Vector3& x, std::size_t count) {
    constexpr double kBeyondAll = 16;   // model extents
    constexpr std::size_t kPlenty = 3;  // times as many as were wanted
    std::vector<std::pair<double, Index>> found;
    double radius = usual_radius_;
    for (;; radius *= 1.5) {
      found.clear();
      const Vector3 reach = Vector3::Constant(radius);
      index_.in_box(x - reach, x + reach, [&](Index v) {
        const double distance = (point_[v] - x).norm();
        if (distance <= radius) found.push_back({distance, v});
      });
      if (found.size() >= count || radius > kBeyondAll) break;
    }
    // Places are about as dense as those that were asked for before.
    if (radius <= kBeyondAll) usual_radius_ = found.size() > kPlenty * count ? 0.7 * radius : radius;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(std::min(found.size(), count));
    std::partial_sort(found.begin(), end, found.end());
    found.erase(end, found.end());
    return found;
  }

  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  const Execution execution_;
  const InnerSurface kind_;
  std::vector<Gate> gates_;
  std::vector<Index> first_gate_, gates_at_;  // those of each vertex one after the other
  std::vector<Vector3> point_;                // of the vertices, then of the gates
  std::vector<double> clearance_;             // 0: no chord, or a gate outside
  Index asked_ = 0;                           // for clearances, one by one
  BoxIndex index_;                            // of the usable points
  double usual_radius_ = 0.01;                // of the ball that held as many of them as were wanted
  std::vector<EdgeState> edge_;               // per half-edge
};

}  // namespace detail
}  // namespace mspskel
