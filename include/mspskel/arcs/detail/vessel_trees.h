// What joins the tubes of a vessel in its wall: every handle closes the shortest way, and hangs on the floor.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "mspskel/arcs/detail/hub_components.h"
#include "mspskel/arcs/detail/in_tubes.h"
#include "mspskel/arcs/detail/near_vertices.h"
#include "mspskel/arcs/detail/polyline_ends.h"
#include "mspskel/arcs/detail/tight_line.h"
#include "mspskel/mesh/detail/solid_moments.h"
#include "mspskel/solid/detail/axis_stretch.h"
#include "mspskel/solid/detail/inner_graph.h"

namespace mspskel {
namespace detail {

// The arcs of a shell without their stretches in tubes are trees where the wall is all of one piece. Any tree
// over the same ends stands for it as well; this one gives every handle the shortest loop of its class. It
// joins the two ends of each handle in the wall, and the nearer of them, the ends of other tubes and the
// leaves with the middle of the floor, where the axis of the opening runs inside.
class VesselTrees {
 public:
  VesselTrees(ArcGraph graph, InnerGraph& inner, double step, const CrossingLabels& crossings)
      : graph_(std::move(graph)),
        surface_(inner.surface()),
        solid_(inner.solid()),
        inner_(inner),
        crossings_(crossings),
        line_(solid_, step, crossings),
        step_(step) {}

  // The graph with such trees in the components marked in `shells`, as far as they make the loops of two
  // handles or more shorter; takes the marks from those components. Nothing where they do not.
  std::optional<ArcGraph> run(std::vector<bool>& shells) {
    if (!cut_out_tubes(shells)) return std::nullopt;
    const std::vector<Index> component = hub_components(graph_, surface_);  // with the hubs of the cuts
    const std::vector<SolidMoments> moments = solid_moments(surface_);
    bool laid = false;
    for (const Tree& tree : trees()) {
      const Index c = component[tree.hubs.front()];
      const auto stretch = axis_stretch(moments[c], solid_);
      if (!stretch || !lay(tree, ((*stretch)[0] + (*stretch)[1]) / 2)) continue;
      laid = true;
      shells[c] = false;
    }
    if (!laid) return std::nullopt;
    dissolve_through_hubs(graph_);
    return std::move(graph_);
  }

 private:
  // Arcs outside of tubes that hang together.
  struct Tree {
    std::vector<Index> hubs, arcs;
  };
  using Way = std::vector<Vector3>;

  // Per component: it is marked and has more than one independent loop.
  std::vector<bool> several_loops(const std::vector<bool>& shells,
                                  const std::vector<Index>& component) const {
    std::vector<Index> loops(shells.size(), 1);
    for (Index h = 0; h < graph_.hub_count(); ++h)
      if (graph_.hub_alive[h] && component[h] != kNone) --loops[component[h]];
    for (const Arc& arc : graph_.arcs)
      if (arc.alive && component[arc.hub[0]] != kNone) ++loops[component[arc.hub[0]]];
    std::vector<bool> several(shells);
    for (std::size_t c = 0; c < several.size(); ++c) several[c] = several[c] && loops[c] > 1;
    return several;
  }

  // Puts hubs where tubes begin and end, in shells with several loops. Whether there are two tubes or more.
  bool cut_out_tubes(const std::vector<bool>& shells) {
    const std::vector<Index> component = hub_components(graph_, surface_);
    const std::vector<bool> marked = several_loops(shells, component);
    const auto at = graph_.incidence();
    const Index count = graph_.arc_count();
    in_tube_.assign(count, 0);
    Index tubes = 0;
    for (Index a = 0; a < count; ++a) {
      Arc& arc = graph_.arcs[a];
      in_tube_[a] = !arc.alive || component[arc.hub[0]] == kNone || !marked[component[arc.hub[0]]];
      if (in_tube_[a]) continue;
      arc.points = resampled_inside(arc, step_, solid_, crossings_);
      const bool ring = arc.hub[0] == arc.hub[1] && at[arc.hub[0]].size() == 2;
      if (!ring || begin_in_tube(graph_, a, solid_)) tubes += cut_out_tubes_of(a);
    }
    return tubes > 1;
  }

  Index cut_out_tubes_of(Index a) {
    const std::vector<std::uint8_t> tube = in_tubes(graph_.arcs[a].points, solid_);
    Index tubes = 0;
    const auto cut = [&](std::size_t point, bool rest_in_tube) {
      split_arc(graph_, a, point);
      in_tube_.push_back(rest_in_tube);
      give_near_vertices(graph_, surface_, a, graph_.arc_count() - 1);
    };
    for (std::size_t end = tube.size(); end-- > 0;) {  // from the back, so that places before it stay
      if (!tube[end]) continue;
      std::size_t begin = end;
      while (begin > 0 && tube[begin - 1]) --begin;
      if (begin == end) continue;
      ++tubes;
      if (end + 1 < tube.size()) cut(end, false);
      if (begin > 0)
        cut(begin, true);
      else
        in_tube_[a] = 1;
      end = begin;
    }
    return tubes;
  }

  std::vector<Tree> trees() {
    at_ = graph_.incidence();
    std::vector<char> seen(graph_.hub_position.size(), 0);
    std::vector<Tree> found;
    for (Index h = 0; h < graph_.hub_count(); ++h) {
      if (seen[h] || !has_arc_in_wall(h)) continue;
      Tree tree;
      tree.hubs.push_back(h);
      seen[h] = 1;
      for (std::size_t k = 0; k < tree.hubs.size(); ++k)
        for (const Index a : at_[tree.hubs[k]]) {
          if (in_tube_[a]) continue;
          if (graph_.arcs[a].hub[0] == tree.hubs[k]) tree.arcs.push_back(a);
          for (const Index next : graph_.arcs[a].hub)
            if (!seen[next]) {
              seen[next] = 1;
              tree.hubs.push_back(next);
            }
        }
      std::sort(tree.arcs.begin(), tree.arcs.end());
      tree.arcs.erase(std::unique(tree.arcs.begin(), tree.arcs.end()), tree.arcs.end());
      if (tree.arcs.size() + 1 == tree.hubs.size()) found.push_back(std::move(tree));
    }
    return found;
  }

  bool has_arc_in_wall(Index h) const {
    return std::any_of(at_[h].begin(), at_[h].end(), [&](Index a) { return !in_tube_[a]; });
  }
  bool has_tube(Index h) const {
    return std::any_of(at_[h].begin(), at_[h].end(), [&](Index a) { return in_tube_[a] != 0; });
  }

  // The hub where the tube that begins at h comes back to a wall; kNone where it does not.
  Index other_end(Index h) const {
    const auto tube = std::find_if(at_[h].begin(), at_[h].end(), [&](Index a) { return in_tube_[a] != 0; });
    Index arc = *tube, hub = h;
    for (;;) {
      hub = graph_.arcs[arc].hub[graph_.arcs[arc].hub[0] == hub ? 1 : 0];
      if (hub == h || has_arc_in_wall(hub)) return hub == h ? kNone : hub;
      if (at_[hub].size() != 2) return kNone;
      arc = at_[hub][at_[hub][0] == arc ? 1 : 0];
    }
  }

  // The ways from a hub in the wall to the others of its tree, by hub.
  std::vector<Way> ways_from(Index from) const {
    std::vector<Way> way(graph_.hub_position.size());
    way[from] = {graph_.hub_position[from]};
    std::vector<Index> waiting{from};
    while (!waiting.empty()) {
      const Index h = waiting.back();
      waiting.pop_back();
      for (const Index a : at_[h]) {
        const Arc& arc = graph_.arcs[a];
        const Index next = arc.hub[arc.hub[0] == h ? 1 : 0];
        if (in_tube_[a] || !way[next].empty()) continue;
        way[next] = way[h];
        if (arc.hub[0] == h)
          way[next].insert(way[next].end(), arc.points.begin() + 1, arc.points.end());
        else
          way[next].insert(way[next].end(), arc.points.rbegin() + 1, arc.points.rend());
        waiting.push_back(next);
      }
    }
    return way;
  }

  // The shortest way with a label through the middle of the wall.
  std::optional<Way> tight_way(const Vector3& from, const Vector3& to, const CocycleLabel& label) {
    auto way = way_of_class(inner_, crossings_, from, to, label);
    if (way) way = line_.tighten(std::move(*way));
    return way;
  }

  struct Link {
    std::array<Index, 2> hub;  // kNone: the floor
    Way way;
  };

  // Replaces the tree; false if a way is missing or the loops get no shorter.
  bool lay(const Tree& tree, const Vector3& floor) {
    std::vector<Link> links;
    std::vector<std::array<Index, 2>> hung;  // a handle's two ends, or one hub twice
    double before = 0, after = 0;
    for (const Index h : tree.hubs) {
      if (!has_tube(h)) {
        if (at_[h].size() == 1) hung.push_back({h, h});
        continue;
      }
      const Index other = other_end(h);
      const bool handle =
          other != kNone && std::find(tree.hubs.begin(), tree.hubs.end(), other) != tree.hubs.end();
      if (!handle) hung.push_back({h, h});
      if (!handle || other < h) continue;
      const Way old = ways_from(h)[other];
      auto way = tight_way(old.front(), old.back(), crossings_.along(old));
      if (!way) return false;
      before += length_of(old);
      after += length_of(*way);
      links.push_back({{h, other}, std::move(*way)});
      hung.push_back({h, other});
    }
    const double slack = static_cast<double>(links.size()) * step_;
    if (links.size() < 2 || !(after + slack < before) || !hang(hung, floor, links)) return false;
    replace(tree, floor, links);
    return true;
  }

  // Links with the floor. The shortest of the ways down decides which way round the handles the others go: in
  // a wall thinner than a handle, ways from a handle's far end may lead through it.
  bool hang(const std::vector<std::array<Index, 2>>& hung, const Vector3& floor, std::vector<Link>& links) {
    inner_.prepare();
    Index first = kNone;
    Way down, between;
    for (const auto& ends : hung)
      for (const Index h : ends) {
        if (!inner_.path(graph_.hub_position[h], floor, between)) continue;
        between.insert(between.begin(), graph_.hub_position[h]);
        between.push_back(floor);
        if (first != kNone && !(length_of(between) < length_of(down))) continue;
        first = h;
        down = between;
      }
    if (first == kNone) return false;
    const std::vector<Way> from_first = ways_from(first);
    const CocycleLabel reference = crossings_.along(down);
    for (const auto& ends : hung) {
      std::optional<Link> best;
      for (const Index h : ends) {
        if (best && h == ends[0]) break;  // a single end
        Way back(from_first[h].rbegin(), from_first[h].rend());
        auto way = tight_way(graph_.hub_position[h], floor, crossings_.along(back) + reference);
        if (!way) return false;
        if (!best || length_of(*way) < length_of(best->way)) best = Link{{h, kNone}, std::move(*way)};
      }
      links.push_back(std::move(*best));
    }
    return true;
  }

  void replace(const Tree& tree, const Vector3& floor, std::vector<Link>& links) {
    std::vector<char> gone(graph_.arcs.size(), 0);
    for (const Index a : tree.arcs) {
      graph_.arcs[a].alive = false;
      gone[a] = 1;
    }
    const Index middle = graph_.add_hub(floor), first = graph_.arc_count();
    std::vector<char> kept(graph_.hub_position.size(), 0);
    for (Link& link : links) {
      for (Index& hub : link.hub) {
        if (hub == kNone) hub = middle;
        kept[hub] = 1;
      }
      Arc arc;
      arc.hub = link.hub;
      arc.points = std::move(link.way);
      graph_.arcs.push_back(std::move(arc));
      in_tube_.push_back(1);  // done with
    }
    for (const Index h : tree.hubs)
      if (!kept[h]) graph_.hub_alive[h] = false;
    for (Index v = 0; v < surface_.vertex_count(); ++v) {
      const Index a = graph_.arc_of_vertex[v], h = graph_.hub_of_vertex[v];
      if (!(a != kNone && a < first && gone[a]) && !(h != kNone && !graph_.hub_alive[h])) continue;
      graph_.hub_of_vertex[v] = kNone;
      Index nearest = first;
      for (Index b = first + 1; b < graph_.arc_count(); ++b)
        if (distance_to_points(graph_.arcs[b].points, surface_.position[v]) <
            distance_to_points(graph_.arcs[nearest].points, surface_.position[v]))
          nearest = b;
      graph_.arc_of_vertex[v] = nearest;
    }
  }

  ArcGraph graph_;
  const SurfaceSnapshot& surface_;
  const BoundingVolumeHierarchy& solid_;
  InnerGraph& inner_;
  const CrossingLabels& crossings_;
  const TightLine line_;
  const double step_;
  std::vector<char> in_tube_;           // per arc: it is not to be laid anew
  std::vector<std::vector<Index>> at_;  // arcs at each hub
};

}  // namespace detail
}  // namespace mspskel
