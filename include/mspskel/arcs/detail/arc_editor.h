// Changes of an arc graph in one place after the other.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "mspskel/arcs/arc_graph.h"
#include "mspskel/arcs/detail/near_vertices.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {
namespace detail {

// Knows the arcs at every hub and the vertices of every arc and hub, so that a change costs what it touches,
// however many handles and leaves the graph has. While it lives, only it may change which arcs, hubs and
// vertices belong together. Making it costs O(arcs + hubs + vertices).
class ArcEditor {
 public:
  explicit ArcEditor(ArcGraph& graph)
      : graph_(graph),
        at_(graph.incidence()),
        of_arc_(graph.arcs.size()),
        of_hub_(graph.hub_position.size()) {
    for (Index v = 0; v < static_cast<Index>(graph.arc_of_vertex.size()); ++v) {
      if (graph.arc_of_vertex[v] != kNone) of_arc_[graph.arc_of_vertex[v]].push_back(v);
      if (graph.hub_of_vertex[v] != kNone) of_hub_[graph.hub_of_vertex[v]].push_back(v);
    }
  }

  // Arcs at a hub, ascending; a loop is listed twice.
  const std::vector<Index>& at(Index hub) const { return at_[hub]; }

  Index add_hub(const Vector3& position) {
    at_.emplace_back();
    of_hub_.emplace_back();
    return graph_.add_hub(position);
  }
  Index add_arc(Arc arc) {
    const Index added = graph_.arc_count();
    for (const Index hub : arc.hub) at_[hub].push_back(added);
    of_arc_.emplace_back();
    graph_.arcs.push_back(std::move(arc));
    return added;
  }
  // Gives an arc other points, which end at `hub` at the given end.
  void lead_to(Index arc, int end, Index hub, std::vector<Vector3> points) {
    leave(graph_.arcs[arc].hub[end], arc);
    enter(hub, arc);
    graph_.arcs[arc].hub[end] = hub;
    graph_.arcs[arc].points = std::move(points);
  }

  // Removes a leaf arc: the hub `keep` that it leaves takes its vertices, and those of its tip.
  void remove_leaf_arc(Index arc, Index keep) {
    Arc& gone = graph_.arcs[arc];
    const Index tip = gone.hub[0] == keep ? gone.hub[1] : gone.hub[0];
    gone.alive = false;
    graph_.hub_alive[tip] = false;
    for (const Index hub : gone.hub) leave(hub, arc);
    give_to_hub(of_arc_[arc], keep);
    give_to_hub(of_hub_[tip], keep);
  }

  // Joins the two arcs that meet at a hub with exactly two arc ends, and gives its vertices to the joint arc:
  // that one, or kNone where there is nothing to join.
  Index dissolve(Index hub) {
    if (at_[hub].size() != 2 || at_[hub][0] == at_[hub][1]) return kNone;
    const Index kept = at_[hub][0], gone = at_[hub][1];
    join_at(graph_, hub, kept, gone);
    leave(graph_.arcs[kept].hub[1], gone);
    enter(graph_.arcs[kept].hub[1], kept);
    at_[hub].clear();
    give_to_arc(of_hub_[hub], kept);
    give_to_arc(of_arc_[gone], kept);
    return kept;
  }

  // Gives the arc `to` what it is nearer to of the vertices of the arc `from`.
  void give_near_vertices(const SurfaceSnapshot& surface, Index from, Index to) {
    std::vector<Index>& own = of_arc_[from];
    const auto stays = [&](Index v) { return !is_nearer(graph_, surface.position[v], to, from); };
    std::vector<Index> given(std::stable_partition(own.begin(), own.end(), stays), own.end());
    own.resize(own.size() - given.size());
    give_to_arc(given, to);
  }

 private:
  void leave(Index hub, Index arc) { at_[hub].erase(std::find(at_[hub].begin(), at_[hub].end(), arc)); }
  void enter(Index hub, Index arc) {
    at_[hub].insert(std::upper_bound(at_[hub].begin(), at_[hub].end(), arc), arc);
  }
  void give_to_arc(std::vector<Index>& vertices, Index arc) {
    for (const Index v : vertices) graph_.arc_of_vertex[v] = arc, graph_.hub_of_vertex[v] = kNone;
    of_arc_[arc].insert(of_arc_[arc].end(), vertices.begin(), vertices.end());
    vertices.clear();
  }
  void give_to_hub(std::vector<Index>& vertices, Index hub) {
    for (const Index v : vertices) graph_.arc_of_vertex[v] = kNone, graph_.hub_of_vertex[v] = hub;
    of_hub_[hub].insert(of_hub_[hub].end(), vertices.begin(), vertices.end());
    vertices.clear();
  }

  ArcGraph& graph_;
  std::vector<std::vector<Index>> at_;
  std::vector<std::vector<Index>> of_arc_, of_hub_;  // vertices
};

}  // namespace detail
}  // namespace mspskel
