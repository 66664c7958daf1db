// From skeleton mesh to skeleton: greedy edge collapses until no face is left (thesis 4.3, Fig. 4.5).
#pragma once

#include <cstdint>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/collapse/collapse_options.h"
#include "mspskel/collapse/complex_topology.h"
#include "mspskel/collapse/detail/sheet_rest.h"
#include "mspskel/collapse/merging_set.h"
#include "mspskel/collapse/saturation.h"
#include "mspskel/collapse/skeleton_complex.h"

namespace mspskel {

struct CollapseCounts {
  Index collapses = 0;                  // of all edges
  Index one_dimensional_collapses = 0;  // of those, edges without faces (noise by their saturation)
  Index refused_labels = 0;             // refusals: parallel edges round a handle would arise
  Index refused_loop = 0;               // refusals: a parallel edge would become a loop
  Index listed = 0;                     // edges put into the list of skeleton edges L
  Index parked = 0;                     // edges set aside until an adjacent edge changes
  Index reopened = 0;                   // edges that came back from L or from aside
  Index parallel_collapses = 0;         // dead ends left by allowing parallel edges
  Index thinned_faces = 0;  // dead ends left by deleting a face with a free edge: same homotopy type
  Index deleted_faces = 0;  // dead ends left by deleting a face
  Index deleted_edges = 0;  // surplus loops cut at the end
  std::int64_t queue_operations = 0;  // pushes and pops
};

struct CollapsedNode {
  Vector3 position = Vector3::Zero();  // Eq. 4.6
  double area = 0.0;                   // surface that maps here
  double perimeter = 0.0;              // mean MSP; 0 if no vertex of the set has a slice
  double error = 0.0;                  // mean normalised slice error
  Vector3 normal = Vector3::Zero();    // mean slice normal as an axis, unit; zero if no vertex has a slice
  MergingSet set;                      // all the sums, for stages that merge nodes further
};

struct CollapsedEdge {
  Index first = kNone, second = kNone;  // nodes, first < second; several edges may have the same ends
  CocycleLabel label;                   // from first to second
};

// Lengths in the normalised frame.
struct CollapsedSkeleton {
  std::vector<CollapsedNode> nodes;   // in the order of the smallest vertex that maps to each
  std::vector<CollapsedEdge> edges;   // sorted by their nodes
  std::vector<Index> node_of_vertex;  // a partition of the surface; kNone for vertices without a face
  // Per vertex the label of the way to it from its node's origin, the vertex whose place in the complex the
  // node has: labels of edges are those of ways between origins. Empty after a filter.
  std::vector<CocycleLabel> label_of_vertex;
  CollapseCounts counts;
};

// The loop of Fig. 4.5, one operation at a time. Costs and constraints are computed when an edge is popped;
// an edge whose cost has grown since it was pushed goes back. Costs that differ by rounding only are equal,
// or regular and symmetric surfaces would collapse in another order once they are turned; ties go by length,
// then by the edge's index, so equal input gives equal bytes. It always ends: every operation removes a
// vertex, an edge or a face for good, and between two operations each edge is popped a bounded number of
// times.
class SkeletonDecimater {
 public:
  // `sets` per vertex of the complex, each of one vertex. With keep_topology off the labels of the complex
  // are ignored. Throws UsageError for options out of range, a wrong number of sets or a position that is not
  // finite.
  SkeletonDecimater(SkeletonComplex complex, std::vector<MergingSet> sets, CollapseOptions options = {});

  // One collapse, or one way out of a dead end; false when the skeleton is done. Cost: O(log edges +
  // degrees).
  bool step();
  // Steps to the end. Throws Cancelled if the callback asks to stop.
  void run(const Execution& execution = {});

  const SkeletonComplex& complex() const { return complex_; }
  const CollapseCounts& counts() const { return counts_; }
  // Of a vertex of the complex that is alive.
  const MergingSet& merging_set(Index node) const { return sets_[node]; }
  // The living vertex whose merging set holds v.
  Index node_of(Index v) const;
  // M(e) as things stand, by the options' order. For tests and pictures.
  double cost(Index e);
  CostTerms cost_terms(Index e);
  CollapsedSkeleton result() const;

 private:
  // Where a living edge is when it is not in the queue.
  enum class State : unsigned char { kQueued, kRefused, kParked, kListed };
  struct Key {
    float cost, length;  // rounded, so that what is equal up to a double's rounding ties
    Index edge;
    std::uint32_t revision;  // of both ends, when the cost was computed
    bool operator<(const Key& other) const {
      if (cost != other.cost) return cost < other.cost;
      return length != other.length ? length < other.length : edge < other.edge;
    }
    bool operator>(const Key& other) const { return other < *this; }
  };
  struct Node {
    Vector3 position, axis;
    double perimeter = 0.0;
    std::uint32_t revision = 0;
    bool axis_known = false;
  };

  void refresh(Index node);
  const Vector3& axis(Index node);
  double length(Index e) const;
  float rounded_length(Index e) const;
  std::uint32_t revision(Index e) const;
  Key key(Index e);
  void push(const Key& key);
  Key pop();
  bool process(Index e);
  bool is_noise(Index e) const;
  bool has_settled_neighbours(Index e) const;
  bool outranks(Index u, Index v) const;
  bool try_collapse(Index e, bool allow_parallel);
  void reopen_noise(Index node);
  void reopen_refused(Index node);
  bool leave_dead_end();
  bool collapse_to_parallel_edges();
  double face_area(Index f) const;
  void delete_face(Index f);
  bool thin_sheet();
  void delete_largest_face();
  bool cut_surplus_loops();

  SkeletonComplex complex_;
  std::vector<MergingSet> sets_;
  CollapseOptions options_;
  CollapseCounts counts_;
  std::vector<Node> nodes_;
  std::vector<Index> parent_;              // gone vertex -> the one it merged into
  std::vector<CocycleLabel> from_parent_;  // the way to it from there
  std::vector<State> state_;
  std::vector<Key> heap_;
  std::vector<Index> living_;  // scratch of the dead ends: a superset of the living edges
  detail::SheetRest sheets_;
  double longest_ = 0.0;       // ‖e_max‖
};

// From any complex with a merging set per vertex. Throws as SkeletonDecimater does, and Cancelled.
CollapsedSkeleton collapse_complex(SkeletonComplex complex, std::vector<MergingSet> sets,
                                   const CollapseOptions& options = {}, const Execution& execution = {});

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/collapse/detail/skeleton_decimater_impl.h"
#endif
