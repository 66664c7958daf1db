// Shortest paths through the solid near its middle.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/base/watch.h"
#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/solid/detail/inner_net.h"
#include "mspskel/solid/detail/landmarks.h"

namespace mspskel {
namespace detail {

// Searches of an inner net, from both ends or among the ways of a class.
class InnerPaths {
 public:
  InnerPaths(const SurfaceSnapshot& surface, const BoundingVolumeHierarchy& solid,
             const Execution& execution = {}, InnerSurface kind = InnerSurface::kCoarser)
      : net_(surface, solid, execution, kind) {}

  bool is_input() const { return net_.is_input(); }

  // Once, before anything else. Cost: two rays a vertex.
  void prepare() {
    net_.prepare();
    for (auto& side : marks_) side.resize(static_cast<std::size_t>(net_.node_count()));
  }

  // Points strictly between a and b along the cheapest path, or false. The search goes from both ends in
  // turn: where one of them lies in a pocket that only a dear way leaves, it comes by few vertices more than
  // that pocket has. With a bound it goes from a, and gives up where it comes by more than `most` vertices.
  // Cost: what it comes by. Where searches without a bound have come by many vertices, those after them go
  // toward their other ends, so that they come by few that do not lie on the way. Throws Cancelled.
  bool path(const Vector3& a, const Vector3& b, std::vector<Vector3>& between, Index most = kAnyNumber) {
    for (const Index v : marked_)
      for (auto& side : marks_) side[v] = {};
    marked_.clear();
    // By the cost of the whole way at least, but for what both sides have in common.
    using Reach = std::pair<double, Entry>;
    std::array<std::priority_queue<Reach, std::vector<Reach>, std::greater<Reach>>, 2> queue;
    std::array<std::vector<Index>, 2> ends;
    for (const auto& [distance, v] : net_.entries(b)) ends[1].push_back(v);
    if (ends[1].empty()) return false;
    const auto first = net_.entries(a);
    for (const auto& [distance, v] : first) ends[0].push_back(v);
    const bool in_turn = most == kAnyNumber;
    const Landmarks::Goal to_a = in_turn ? landmarks_.goal(ends[0]) : Landmarks::Goal(),
                          to_b = in_turn ? landmarks_.goal(ends[1]) : Landmarks::Goal();
    const auto reach = [&](int side, double cost, Index v, Index before) {
      // What comes after a way that is known to stay inside, or meets the surface, is never the cheapest.
      const std::pair<double, Index> way{cost, before};
      if (way >= marks_[side][v].known) return;
      const InnerNet::EdgeState state = before == kNone ? InnerNet::EdgeState::kInside
                                        : side == 0     ? net_.state(before, v)
                                                        : net_.state(v, before);
      if (state == InnerNet::EdgeState::kCrosses) return;
      if (state == InnerNet::EdgeState::kInside) mark(side, v).known = way;
      const double toward = 0.5 * (to_b.bound(v) - to_a.bound(v));
      queue[side].push({side == 0 ? cost + toward : cost - toward, {cost, v, before}});
    };
    const auto begin = [&](int side, double cost, Index v) {
      mark(side, v).start = cost;
      reach(side, cost, v, kNone);
    };
    for (const auto& [distance, v] : first) begin(0, InnerNet::step_cost(distance, net_.clearance(v)), v);
    for (const Index v : ends[1]) begin(1, 0.0, v);
    double best = std::numeric_limits<double>::infinity();
    std::array<Index, 2> meeting{kNone, kNone};  // the last vertex of either side on the best way
    const auto meet = [&](int side, double cost, Index own, Index others) {
      best = cost;
      meeting[side] = own;
      meeting[1 - side] = others;
    };
    std::size_t came_by = 0;
    Watch watch(net_.execution().progress, kStage);
    for (int side = 0; !queue[0].empty() && !queue[1].empty(); side = in_turn ? 1 - side : 0) {
      if (queue[0].top().first + queue[1].top().first >= best) break;
      watch.step();
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
      net_.for_each_edge(v, [&, side = side, cost = cost, v = v](Index w, double more) {
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
      for (Index w = meeting[0]; w != kNone; w = marks_[0][w].before) between.push_back(net_.point(w));
      std::reverse(between.begin(), between.end());
      Index w = meeting[0] == meeting[1] ? marks_[1][meeting[1]].before : meeting[1];
      for (; w != kNone; w = marks_[1][w].before) between.push_back(net_.point(w));
    }
    if (in_turn) set_landmarks_where_worthwhile(ends[1].front(), came_by);
    return meeting[0] != kNone;
  }

  // Vertices that searches without a bound have come by, until there were landmarks.
  std::size_t came_by() const { return came_by_; }

  // As path(), among the ways with this label. False as well where the search comes by many labels before it
  // finds one: so many ways round handles are as short. Throws Cancelled.
  bool path_of_class(const Vector3& a, const Vector3& b, const CrossingLabels& crossings,
                     const CocycleLabel& wanted, std::vector<Vector3>& between) {
    constexpr std::size_t kLabels = 4;  // as many as all points with so many labels each
    std::vector<Place> places;
    std::unordered_map<Index, std::vector<Index>> at;  // places of a vertex
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    for (const auto& [distance, v] : net_.entries(a))
      queue.push({InnerNet::step_cost(distance, net_.clearance(v)), v, kNone});
    std::unordered_set<Index> goal;
    for (const auto& [distance, v] : net_.entries(b)) goal.insert(v);
    Watch watch(net_.execution().progress, kStage);
    watch.ask();
    while (!queue.empty() && places.size() < kLabels * marks_[0].size()) {
      watch.step();
      const auto [cost, v, before] = queue.top();
      queue.pop();
      CocycleLabel label = before == kNone ? crossings(a, net_.point(v))
                                           : places[before].label +
                                                 crossings(net_.point(places[before].vertex), net_.point(v));
      std::vector<Index>& here = at[v];
      if (std::any_of(here.begin(), here.end(), [&](Index p) { return places[p].label == label; }) ||
          (before != kNone && net_.edge_crosses(places[before].vertex, v)))
        continue;
      const auto place = static_cast<Index>(places.size());
      here.push_back(place);
      places.push_back({v, before, std::move(label)});
      if (goal.count(v) > 0 && places[place].label + crossings(net_.point(v), b) == wanted) {
        between.clear();
        for (Index p = place; p != kNone; p = places[p].before)
          between.push_back(net_.point(places[p].vertex));
        std::reverse(between.begin(), between.end());
        return true;
      }
      net_.for_each_edge(v, [&, cost = cost, before = before](Index w, double more) {
        if (before == kNone || places[before].vertex != w) queue.push({cost + more, w, place});
      });
    }
    return false;
  }

 protected:
  const InnerNet& net() const { return net_; }

 private:
  static constexpr const char* kStage = "arcs";
  static constexpr Index kAnyNumber = std::numeric_limits<Index>::max();

  // A point reached by ways of one class, and the place before it.
  struct Place {
    Index vertex, before;
    CocycleLabel label;
  };

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

  // Of the step that a search from this side takes, asked in the direction of the way from side 0 to side 1.
  bool crosses(int side, Index from, Index to) {
    return side == 0 ? net_.edge_crosses(from, to) : net_.edge_crosses(to, from);
  }

  // Landmarks take about as long as four searches of the whole graph.
  void set_landmarks_where_worthwhile(Index goal, std::size_t came_by) {
    constexpr std::size_t kSearches = 4;
    if (!landmarks_.empty()) return;
    came_by_ += came_by;
    if (came_by_ < kSearches * marks_[0].size()) return;
    Watch watch(net_.execution().progress, kStage);
    landmarks_.build(net_.node_count(), goal, [&](Index v, auto visit) {
      watch.step();
      net_.for_each_edge(v, visit);
    });
  }

  InnerNet net_;
  std::array<std::vector<Mark>, 2> marks_;  // per side and node; of `marked_` alone they mean something
  std::vector<Index> marked_;
  Landmarks landmarks_;      // of this net, where searches have come by many vertices
  std::size_t came_by_ = 0;  // vertices, before there were landmarks
};

}  // namespace detail
}  // namespace mspskel
