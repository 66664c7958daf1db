// Solids round a given graph: the models whose skeleton is known before it is extracted.
#pragma once

#include <utility>
#include <vector>

#include "mspskel/samples/polygonise.h"

namespace mspskel {

struct BallNode {
  Vector3 position;
  double radius;
};

// Balls joined by round cones. Where edges of the graph pass nearer to each other than their radii allow, the
// skin has handles that the graph lacks.
struct BallGraph {
  std::vector<BallNode> nodes;
  std::vector<std::pair<Index, Index>> edges;
  double blend = 0.1;  // width of the fillets where limbs meet, model units, >= 0; at most 0.6 of a limb's
                       // thinner radius is used
};

// Distance to the round cone over two balls, negative inside: the convex hull of both (Quilez, "round cone").
double round_cone_distance(const Vector3& p, const BallNode& a, const BallNode& b);

// Smooth minimum: at most min(a, b), equal to it where they differ by `blend` or more, as Lipschitz as they
// are.
double smooth_minimum(double a, double b, double blend);

// The union of the graph's round cones with fillets, and its width. Precondition: every node has an edge and
// all radii are positive. An evaluation takes O(log edges) where few edges pass nearby.
ImplicitSolid skin_solid(const BallGraph& graph);

// The skin with about `vertices` vertices. Throws UsageError where they are too few for its thinnest limb.
PolygonSoup skin_graph(const BallGraph& graph, Index vertices);

// The same with edges in proportion to the width of the limbs.
PolygonSoup skin_graph_by_width(const BallGraph& graph, Index vertices);

}  // namespace mspskel
