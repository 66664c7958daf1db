// The simplicial complex that a skeleton mesh collapses on, down to a graph.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/types.h"
#include "mspskel/collapse/cocycle_label.h"
#include "mspskel/mesh/surface_snapshot.h"

namespace mspskel {

// Why an edge does not collapse.
enum class CollapseRefusal {
  kAllowed,          // it does
  kDifferentLabels,  // two edges would become parallel whose loop goes round a handle
  kLoop,             // a parallel edge would become a loop
};

// Vertices, edges and triangles in flat arrays with tombstones: indices stay valid, a collapse allocates
// nothing. Edges may be parallel and may have any number of faces, none included, which no half-edge
// structure can hold.
//
//              x                    A dart is a directed edge: 2e runs from edge e's first end to its second,
//              2e + 1 back.
//            /   \.                 A face is three darts, each starting where the one before it ends:
//            2-simplices are
//      label/  f  \label            keyed by their edges, since corners do not tell parallel edges apart.
//          /       \.
//         u ------> v               label(2e + 1) = −label(2e), and the labels round a face sum to zero
//         (cocycle).
//            label
//
// No edge is a loop, so the three corners of a face are distinct, and no two parallel edges have equal labels
// once merge_parallel_edges() ran; both stay true through every operation below.
class SkeletonComplex {
 public:
  explicit SkeletonComplex(Index vertex_count = 0);

  // Throws UsageError for ends that are equal or no vertex. Returns the edge. Not after a collapse.
  Index add_edge(Index first, Index second, CocycleLabel label = {});
  // Throws UsageError unless the darts make a closed path whose labels sum to zero. Returns the face.
  Index add_face(Index dart0, Index dart1, Index dart2);
  // Memory for that many more elements.
  void reserve(Index edges, Index faces);
  // Vertices without an edge are dead from here on.
  void drop_isolated_vertices();
  // Every label becomes zero, and all parallel edges merge.
  void forget_labels();
  // Identifies parallel edges with equal labels. Cost: O(sum of squared degrees).
  void merge_parallel_edges();

  // Sizes of the arrays, dead elements included.
  Index vertex_capacity() const { return static_cast<Index>(vertices_.size()); }
  Index edge_capacity() const { return static_cast<Index>(edges_.size()); }
  Index face_capacity() const { return static_cast<Index>(corners_.size() / 3); }
  // Numbers of living elements.
  Index vertex_count() const { return vertex_count_; }
  Index edge_count() const { return edge_count_; }
  Index face_count() const { return face_count_; }
  bool is_vertex(Index v) const { return vertices_[v].alive; }
  bool is_edge(Index e) const { return darts_[2 * e].origin != kNone; }
  bool is_face(Index f) const { return corners_[3 * f].dart != kNone; }

  Index origin(Index dart) const { return darts_[dart].origin; }
  Index target(Index dart) const { return darts_[dart ^ 1].origin; }
  std::array<Index, 2> ends(Index e) const { return {origin(2 * e), target(2 * e)}; }
  Index degree(Index v) const { return vertices_[v].degree; }
  Index face_count(Index e) const { return edges_[e].face_count; }
  CocycleLabel label(Index dart) const;
  std::array<Index, 3> face_darts(Index f) const;
  // A dart from u to v of the given edge's ends.
  Index dart_from(Index e, Index u) const { return origin(2 * e) == u ? 2 * e : 2 * e + 1; }

  // The darts that start at v: for (Index d = first_dart(v); d != kNone; d = next_dart(d)).
  Index first_dart(Index v) const { return vertices_[v].first; }
  Index next_dart(Index dart) const { return darts_[dart].next; }
  // The faces of an edge: for (Index c = first_corner(e); c != kNone; c = next_corner(c)) face is c / 3.
  Index first_corner(Index e) const { return edges_[e].first_corner; }
  Index next_corner(Index corner) const { return corners_[corner].next; }

  // Whether and why not e may collapse. Unequal labels of edges that would become parallel are a refusal
  // unless `allow_parallel`, a loop always is. Cost: O(sum over the gone end's neighbours x of min(degree(x),
  // degree(kept end))).
  CollapseRefusal refusal(Index e, Index kept, bool allow_parallel = false);
  // Merges the other end v of e into `kept` u: e and its faces vanish, label(u,x) := label(u,v) + label(v,x),
  // parallel edges with equal labels merge, faces with the same three edges merge. The homotopy class of the
  // complex changes by null-homologous loops only; a refused collapse changes nothing.
  CollapseRefusal collapse(Index e, Index kept, bool allow_parallel = false);
  // Edges of `kept` that took in a parallel edge in the last collapse.
  const std::vector<Index>& merged_edges() const { return merged_; }

  // Always legal: the loops that remain reach every class that they reached with the face.
  void delete_face(Index f);
  // Throws UsageError if the edge has faces.
  void delete_edge(Index e);

  // Empty if every invariant holds, otherwise a sentence about one that does not. For tests. Cost: O(size).
  std::string find_violation() const;

 private:
  struct Vertex {
    Index first = kNone, degree = 0;
    bool alive = true;
  };
  struct Dart {
    Index origin = kNone, next = kNone, prev = kNone;
  };
  struct Edge {
    Index first_corner = kNone, face_count = 0;
  };
  struct Corner {
    Index dart = kNone, next = kNone, prev = kNone;
  };

  // shift + label(dart) == label(other), without allocation where all are zero.
  bool same_class(const CocycleLabel& shift, Index dart, Index other) const;
  void link_dart(Index dart, Index vertex);
  void unlink_dart(Index dart);
  void link_corner(Index corner, Index dart);
  void unlink_corner(Index corner);
  void merge_edges(Index keep, Index gone);
  bool has_twin_face(Index f) const;
  void rebase(Index dart, const CocycleLabel& shift);
  template <class Visit>
  void for_each_dart_between(Index u, Index x, Visit visit) const;

  std::vector<Vertex> vertices_;
  std::vector<Dart> darts_;
  std::vector<Edge> edges_;
  std::vector<CocycleLabel> labels_;  // of dart 2e
  std::vector<Corner> corners_;       // 3f + i
  Index vertex_count_ = 0, edge_count_ = 0, face_count_ = 0;
  std::vector<std::array<Index, 2>> merges_;  // scratch: {dart kept → x, dart gone → x}
  std::vector<Index> merged_;
};

// The surface's vertices, edges and faces; `halfedge_label` per half-edge of the snapshot, or empty for zero
// labels. Edges are numbered by their vertices (smaller one first), whatever the order of the faces. Vertices
// without a face are no vertices of the complex. Cost: O(faces). Throws UsageError if there are labels and
// their number is wrong, twins are not negatives or a face's sum is not zero.
SkeletonComplex make_complex(const SurfaceSnapshot& surface,
                             const std::vector<CocycleLabel>& halfedge_label = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/skeleton_complex_impl.h"
#endif
