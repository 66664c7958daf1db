// The result: a graph of nodes and straight edges with a radius at every node and a map from the surface.
#pragma once

#include <array>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel {

struct SkeletonNode {
  Vector3 position = Vector3::Zero();  // model coordinates
  double radius = 0.0;                 // distance to the surface, model units: the maximal inscribed ball
  double area = 0.0;                   // surface area of the vertices that map here, model units squared
  double perimeter = 0.0;              // mean minimum slice perimeter of those vertices, model units
  double slice_error = 0.0;            // mean normalised slice error of those vertices, 0 to 1
};

struct CurveSkeleton {
  std::vector<SkeletonNode> nodes;
  // Simple graph: no loops, no parallel edges (both are subdivided). Smaller index first, sorted.
  std::vector<std::array<Index, 2>> edges;
  // Input vertex -> node; a partition of the surface. Isolated vertices of the input map to kNone.
  std::vector<Index> node_of_vertex;
};

// A branch (arc): a maximal chain of edges whose inner nodes have exactly two neighbours. A closed chain
// without any joint starts and ends at its smallest node.
struct Branch {
  std::vector<Index> nodes;  // ends included
};

// Neighbours of every node, ascending.
std::vector<std::vector<Index>> adjacency(const CurveSkeleton& skeleton);
// Branches in ascending order of their first edge; every edge is in exactly one.
std::vector<Branch> branches(const CurveSkeleton& skeleton);

// Counts that topology is judged by.
struct GraphCounts {
  Index nodes = 0, edges = 0, components = 0, cycles = 0;  // cycles: first Betti number
  Index leaves = 0, joints = 0;                            // one neighbour; three or more
  double length = 0.0;                                     // sum of the edge lengths, model units
};
GraphCounts count_graph(const CurveSkeleton& skeleton);

}  // namespace mspskel

#ifndef MSPSKEL_COMPILED
#include "mspskel/skeleton/detail/curve_skeleton_impl.h"
#endif
