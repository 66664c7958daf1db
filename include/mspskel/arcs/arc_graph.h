// The skeleton between the collapse and the result: hubs (joints and leaf ends) connected by polyline arcs.
#pragma once

#include <array>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {

// A polyline from hub[0] to hub[1]; its first and last point are the hubs' positions.
struct Arc {
  std::array<Index, 2> hub{kNone, kNone};
  std::vector<Vector3> points;
  bool alive = true;
};

// A multigraph: arcs may be parallel, or loops at one hub. Positions are in the normalised frame of a
// snapshot. Every surface vertex belongs to one arc or one hub; a stage that removes either passes its
// vertices on, so the map stays a partition.
struct ArcGraph {
  std::vector<Vector3> hub_position;
  std::vector<bool> hub_alive;
  std::vector<Arc> arcs;
  std::vector<Index> arc_of_vertex;  // kNone: the vertex belongs to a hub, or to nothing if isolated
  std::vector<Index> hub_of_vertex;  // kNone: the vertex belongs to an arc

  Index hub_count() const { return static_cast<Index>(hub_position.size()); }
  Index arc_count() const { return static_cast<Index>(arcs.size()); }

  Index add_hub(const Vector3& position) {
    hub_position.push_back(position);
    hub_alive.push_back(true);
    return hub_count() - 1;
  }
  // Moves a hub and the arc ends that lie on it.
  void move_hub(Index hub, const Vector3& position);
  // Arcs at each hub, ascending; a loop is listed twice.
  std::vector<std::vector<Index>> incidence() const;
};

// What every stage has to keep: b0 and b1.
struct ArcGraphType {
  Index components = 0;
  Index cycles = 0;
  bool operator==(const ArcGraphType& other) const {
    return components == other.components && cycles == other.cycles;
  }
};
ArcGraphType homotopy_type(const ArcGraph& graph);

double arc_length(const Arc& arc);

// The points in order from the hub at the given end, 0 or 1.
std::vector<Vector3> points_from(const Arc& arc, int end);

// Points at equal steps of at most `step`; ends stay. A loop gets at least three edges, any other arc at
// least `min_edges`.
std::vector<Vector3> resampled(const Arc& arc, double step, Index min_edges = 1);

// Cuts edges longer than `longest` into equal pieces; the curve stays the same.
void subdivide(ArcGraph& graph, double longest);

// Puts a hub at an inner point of an arc, which ends there; the rest of it becomes the last arc. The hub.
Index split_arc(ArcGraph& graph, Index arc, std::size_t point);

// Joins two arcs that meet at a hub where nothing else ends: `kept` runs on as `gone`, which ends, as the
// hub.
void join_at(ArcGraph& graph, Index hub, Index kept, Index gone);

// Joins the two arcs that meet at every hub with exactly two arc ends, and gives the hub's vertices to the
// joint arc.
void dissolve_through_hubs(ArcGraph& graph);

// Contracts an arc that is no loop: its vertices and those of hub[1] go to hub[0], which moves to `position`.
void contract_arc(ArcGraph& graph, Index arc, const Vector3& position);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/arcs/detail/arc_graph_impl.h"
#endif
