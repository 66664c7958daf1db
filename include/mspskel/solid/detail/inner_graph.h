// Shortest paths through the solid near its middle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/detail/box_index.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/solid/detail/gates.h"
#include "mspskel/solid/detail/inward_chord.h"
#include "mspskel/solid/detail/landmarks.h"

namespace mspskel {
namespace detail {

// Which surface the paths run beside. Few triangles round a limb are all that there is on the input, and what
// coarsening left on a coarser one.
enum class InnerSurface { kInput, kCoarser };

// Paths along the mesh's graph with every vertex moved to the middle of its inward chord, and through the
// gates of an input. Nothing is computed before prepare(), and distances to the surface only where a path
// comes by: many meshes need no path at all. Any surface within the solid will do: no vertex of it goes in or
// out.
class InnerPaths {
 public:
  InnerPaths(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
             const Execution& execution = {}, InnerSurface kind = InnerSurface::kCoarser)
      : surface_(surface), solid_(solid), execution_(execution), kind_(kind) {}

  bool is_input() const { return kind_ == InnerSurface::kInput; }

  // Once, before anything else. Cost: two rays a vertex.
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
    for (auto& side : marks_) side.assign(point_.size(), {});
    edge_.assign(surface_.origin.size(), EdgeState::kUnknown);
  }

  // Points strictly between a and b along the cheapest path, or false. The search goes from both ends in
  // turn: where one of them lies in a pocket that only a dear way leaves, it comes by few vertices more than
  // that pocket has. With a bound it goes from a, and gives up where it comes by more than `most` vertices.
  // Cost: what it comes by. Where searches without a bound have come by many vertices, those after them go
  // toward their other ends, so that they come by few that do not lie on the way.
  bool path(const Vector3& a, const Vector3& b, std::vector<Vector3>& between, Index most = kAnyNumber) {
    for (const Index v : marked_)
      for (auto& side : marks_) side[v] = {};
    marked_.clear();
    // By the cost of the whole way at least, but for what both sides have in common.
    using Reach = std::pair<double, Entry>;
    std::array<std::priority_queue<Reach, std::vector<Reach>, std::greater<Reach>>, 2> queue;
    std::array<std::vector<Index>, 2> ends;
    for (const auto& [distance, v] : entries(b)) ends[1].push_back(v);
    if (ends[1].empty()) return false;
    const auto first = entries(a);
    for (const auto& [distance, v] : first) ends[0].push_back(v);
    const bool in_turn = most == kAnyNumber;
    const Landmarks::Goal to_a = in_turn ? landmarks_.goal(ends[0]) : Landmarks::Goal(),
                          to_b = in_turn ? landmarks_.goal(ends[1]) : Landmarks::Goal();
    const auto reach = [&](int side, double cost, Index v, Index before) {
      // What comes after a way that is known to stay inside, or meets the surface, is never the cheapest.
      const std::pair<double, Index> way{cost, before};
      if (way >= marks_[side][v].known) return;
      const EdgeState state = before == kNone ? EdgeState::kInside
                              : side == 0     ? known_state(before, v)
                                              : known_state(v, before);
      if (state == EdgeState::kCrosses) return;
      if (state == EdgeState::kInside) mark(side, v).known = way;
      const double toward = 0.5 * (to_b.bound(v) - to_a.bound(v));
      queue[side].push({side == 0 ? cost + toward : cost - toward, {cost, v, before}});
    };
    const auto begin = [&](int side, double cost, Index v) {
      mark(side, v).start = cost;
      reach(side, cost, v, kNone);
    };
    for (const auto& [distance, v] : first) begin(0, step_cost(distance, clearance(v)), v);
    for (const Index v : ends[1]) begin(1, 0.0, v);
    double best = std::numeric_limits<double>::infinity();
    std::array<Index, 2> meeting{kNone, kNone};  // the last vertex of either side on the best way
    const auto meet = [&](int side, double cost, Index own, Index others) {
      best = cost;
      meeting[side] = own;
      meeting[1 - side] = others;
    };
    std::size_t came_by = 0;
    for (int side = 0; !queue[0].empty() && !queue[1].empty(); side = in_turn ? 1 - side : 0) {
      if (queue[0].top().first + queue[1].top().first >= best) break;
      const auto [cost, v, before] = queue[side].top().second;
      queue[side].pop();
      // Whether an edge stays inside is asked where it would be the cheapest way, which few edges are.
      if (marks_[side][v].done || (before != kNone && crosses(side, before, v))) continue;
      if (most != kAnyNumber && most-- <= 0) return false;
      Mark& own = mark(side, v);
      own.done = true;
      own.cost = cost;
      own.before = before;
      ++came_by;
      const Mark& other = marks_[1 - side][v];
      if (const double whole = cost + (other.done ? other.cost : other.start); whole < best)
        meet(side, whole, v, v);
      for_each_edge(v, [&, side = side, cost = cost, v = v](Index w, double more) {
        const Mark& beyond = marks_[1 - side][w];
        if (!beyond.done) {
          if (!marks_[side][w].done) reach(side, cost + more, w, v);
        } else if (const double whole = cost + more + beyond.cost; whole < best && !crosses(side, v, w)) {
          meet(side, whole, v, w);
        }
      });
    }
    if (meeting[0] != kNone) {
      between.clear();
      for (Index w = meeting[0]; w != kNone; w = marks_[0][w].before) between.push_back(point_[w]);
      std::reverse(between.begin(), between.end());
      Index w = meeting[0] == meeting[1] ? marks_[1][meeting[1]].before : meeting[1];
      for (; w != kNone; w = marks_[1][w].before) between.push_back(point_[w]);
    }
    if (in_turn) set_landmarks_where_worthwhile(ends[1].front(), came_by);
    return meeting[0] != kNone;
  }

  // Vertices that searches without a bound have come by, until there were landmarks.
  std::size_t came_by() const { return came_by_; }

  // As path(), among the ways with this label. False as well where the search comes by many labels before it
  // finds one: so many ways round handles are as short.
  bool path_of_class(const Vector3& a, const Vector3& b, const CrossingLabels& crossings,
                     const CocycleLabel& wanted, std::vector<Vector3>& between) {
    constexpr std::size_t kLabels = 4;  // as many as all points with so many labels each
    std::vector<Place> places;
    std::unordered_map<Index, std::vector<Index>> at;  // places of a vertex
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (const auto& [distance, v] : entries(a)) queue.push({step_cost(distance, clearance(v)), v, kNone});
    std::unordered_set<Index> goal;
    for (const auto& [distance, v] : entries(b)) goal.insert(v);
    while (!queue.empty() && places.size() < kLabels * point_.size()) {
      const auto [cost, v, before] = queue.top();
      queue.pop();
      CocycleLabel label = before == kNone
                               ? crossings(a, point_[v])
                               : places[before].label + crossings(point_[places[before].vertex], point_[v]);
      std::vector<Index>& here = at[v];
      if (std::any_of(here.begin(), here.end(), [&](Index p) { return places[p].label == label; }) ||
          (before != kNone && edge_crosses(places[before].vertex, v)))
        continue;
      const auto place = static_cast<Index>(places.size());
      here.push_back(place);
      places.push_back({v, before, std::move(label)});
      if (goal.count(v) > 0 && places[place].label + crossings(point_[v], b) == wanted) {
        between.clear();
        for (Index p = place; p != kNone; p = places[p].before) between.push_back(point_[places[p].vertex]);
        std::reverse(between.begin(), between.end());
        return true;
      }
      for_each_edge(v, [&, cost = cost, before = before](Index w, double more) {
        if (before == kNone || places[before].vertex != w) queue.push({cost + more, w, place});
      });
    }
    return false;
  }

 protected:
  const SurfaceSnapshot& surface() const { return surface_; }
  const BoundingVolumeHierarchy& solid() const { return solid_; }
  bool usable(Index v) const { return clearance_[v] != 0; }
  const Vector3& point(Index v) const { return point_[v]; }

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

 private:
  static constexpr double kUnknown = -1.0;
  static constexpr Index kAnyNumber = std::numeric_limits<Index>::max();

  // A point reached by ways of one class, and the place before it.
  struct Place {
    Index vertex, before;
    CocycleLabel label;
  };

  enum class EdgeState : std::uint8_t { kUnknown, kInside, kCrosses };

  // What a search from one side knows of a vertex.
  struct Mark {
    Index before = kNone;
    // The first in the queue of the ways that are known to stay inside: its cost and the vertex before.
    std::pair<double, Index> known{std::numeric_limits<double>::infinity(), kNone};
    double start = std::numeric_limits<double>::infinity();  // cost where the search begins here
    double cost = 0.0;                                       // once done
    bool done = false;
  };
  Mark& mark(int side, Index v) {
    marked_.push_back(v);
    return marks_[side][v];
  }

  // Cost of the way to a vertex, the vertex, and the vertex or place before it.
  using Entry = std::tuple<double, Index, Index>;

  void place(Index v) {
    if (surface_.vertex_halfedge[v] == kNone) return;
    const auto chord = inward_chord(surface_, solid_, v);
    if (!chord) return;
    point_[v] = chord->start - 0.5 * chord->length * surface_.normal[v];
    clearance_[v] = kUnknown;
  }

  Index node_count() const { return static_cast<Index>(point_.size()); }

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

  // What is known of that.
  EdgeState known_state(Index from, Index to) const {
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

  // Of the step that a search from this side takes, asked in the direction of the way from side 0 to side 1.
  bool crosses(int side, Index from, Index to) {
    return side == 0 ? edge_crosses(from, to) : edge_crosses(to, from);
  }

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

  // Landmarks take about as long as four searches of the whole graph.
  void set_landmarks_where_worthwhile(Index goal, std::size_t came_by) {
    constexpr std::size_t kSearches = 4;
    if (!landmarks_.empty()) return;
    came_by_ += came_by;
    if (came_by_ < kSearches * point_.size()) return;
    landmarks_.build(node_count(), goal, [&](Index v, auto visit) { for_each_edge(v, visit); });
  }

  // The nearest inner points that x sees, and as many of those near the middle. Where chords from far away
  // have their middles, as those from the rim of a disc have in the middle of the disc, the ways to their
  // vertices are long ones.
  std::vector<std::pair<double, Index>> entries(const Vector3& x) {
    constexpr std::size_t kWanted = 8;
    std::vector<std::pair<double, Index>> near, far;
    for (const std::size_t tried : {64, 1024}) {
      near.clear();
      far.clear();
      for (const auto& entry : nearest_points(x, tried)) {
        if (near.size() >= kWanted) break;
        std::vector<std::pair<double, Index>>& kept = is_near_middle(entry.second) ? near : far;
        if (kept.size() < kWanted && !solid_.segment_crosses(x, point_[entry.second])) kept.push_back(entry);
      }
      if (!near.empty() || far.empty()) break;
    }
    near.insert(near.end(), far.begin(), far.end());
    return near;
  }

  // Whether half of the chord is not much longer than the way from its middle to the surface.
  bool is_near_middle(Index v) {
    constexpr double kMuch = 4;
    return v >= surface_.vertex_count() || (point_[v] - surface_.position[v]).norm() <= kMuch * clearance(v);
  }

  // The `count` points nearest to x, or all, by growing distance: from balls round it of growing radius.
  std::vector<std::pair<double, Index>> nearest_points(const Vector3& x, std::size_t count) const {
    constexpr double kFirst = 0.02, kBeyondAll = 16;  // model extents
    std::vector<std::pair<double, Index>> found;
    for (double radius = kFirst; found.size() < count && radius < kBeyondAll; radius *= 2) {
      found.clear();
      const Vector3 reach = Vector3::Constant(radius);
      index_.in_box(x - reach, x + reach, [&](Index v) {
        const double distance = (point_[v] - x).norm();
        if (distance <= radius) found.push_back({distance, v});
      });
    }
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
  std::vector<EdgeState> edge_;               // per half-edge
  std::array<std::vector<Mark>, 2> marks_;    // per side and point; of `marked_` alone they mean something
  std::vector<Index> marked_;
  Landmarks landmarks_;      // of this graph, where searches have come by many vertices
  std::size_t came_by_ = 0;  // vertices, before there were landmarks
};

// The inner paths of the surface that an arc graph's map is of. What reads that map takes surface, solid and
// the vertices' points from here, so vertices of another surface cannot come in between.
class InnerGraph : public InnerPaths {
 public:
  using InnerPaths::InnerPaths;
  using InnerPaths::is_input;
  using InnerPaths::nearest;
  using InnerPaths::point;
  using InnerPaths::solid;
  using InnerPaths::surface;
  using InnerPaths::usable;
};

}  // namespace detail
}  // namespace mspskel
