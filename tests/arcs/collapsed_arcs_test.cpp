// From the collapse's graph to arcs, and from arcs to the finished skeleton.
#include "mspskel/arcs/collapsed_arcs.h"

#include <catch2/catch.hpp>
#include <set>

#include "../topology/voxel_solids.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/skeleton/surface_map.h"
#include "support/arc_graphs.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

CollapsedSkeleton random_collapsed(Random& random) {
  CollapsedSkeleton collapsed;
  const Index nodes = 1 + random.below(12), edges = random.below(16);
  for (Index i = 0; i < nodes; ++i) {
    CollapsedNode node;
    node.position = 0.4 * random.in_ball();
    collapsed.nodes.push_back(node);
  }
  for (Index e = 0; e < edges && nodes > 1; ++e) {
    const Index a = random.below(nodes), b = random.below(nodes);
    if (a == b) continue;
    CollapsedEdge edge;
    edge.first = std::min(a, b);
    edge.second = std::max(a, b);
    collapsed.edges.push_back(edge);
  }
  std::sort(collapsed.edges.begin(), collapsed.edges.end(), [](const auto& x, const auto& y) {
    return std::make_pair(x.first, x.second) < std::make_pair(y.first, y.second);
  });
  for (Index v = 0; v < 80; ++v) collapsed.node_of_vertex.push_back(random.below(nodes + 1) - 1);
  return collapsed;
}

GraphType collapsed_type(const CollapsedSkeleton& collapsed) {
  ArcGraph graph;
  for (const CollapsedNode& node : collapsed.nodes) graph.add_hub(node.position);
  for (const CollapsedEdge& edge : collapsed.edges) add_arc(graph, edge.first, edge.second);
  return type_of(graph);
}

// Nearest point of a triangle by its vertices, edges and plane, each on its own.
double distance_to_triangle(const Vector3& p, const std::array<Vector3, 3>& t) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3 &a = t[i], &b = t[(i + 1) % 3];
    const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    best = std::min(best, (a + s * (b - a) - p).norm());
  }
  const Vector3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  const Vector3 foot = p - n * ((p - t[0]).dot(n) / n.squaredNorm());
  bool within = true;
  for (std::size_t i = 0; i < 3; ++i)
    within = within && (t[(i + 1) % 3] - t[i]).cross(foot - t[i]).dot(n) >= 0;
  return within ? std::min(best, (foot - p).norm()) : best;
}

}  // namespace

TEST_CASE("Arcs of a collapsed graph have its type, and every vertex that it maps") {
  Random random(1);
  for (int run = 0; run < 400; ++run) {
    const CollapsedSkeleton collapsed = random_collapsed(random);
    const ArcGraph graph = make_arc_graph(collapsed);
    REQUIRE(type_of(graph) == collapsed_type(collapsed));
    REQUIRE(arcs_meet_hubs(graph));
    for (std::size_t v = 0; v < collapsed.node_of_vertex.size(); ++v) {
      const bool mapped = collapsed.node_of_vertex[v] != kNone;
      REQUIRE((graph.arc_of_vertex[v] != kNone) + (graph.hub_of_vertex[v] != kNone) == mapped);
    }
    // No hub is left that an arc passes through, but one on each closed chain.
    for (const auto& arcs : graph.incidence())
      if (arcs.size() == 2) REQUIRE(arcs[0] == arcs[1]);
    double edges = 0, arcs = 0;
    for (const CollapsedEdge& e : collapsed.edges)
      edges += (collapsed.nodes[e.first].position - collapsed.nodes[e.second].position).norm();
    for (const Arc& arc : graph.arcs) arcs += arc_length(arc);
    REQUIRE(arcs == Approx(edges));
  }
}

TEST_CASE("Hubs and arcs have the same numbers however the nodes are turned and numbered") {
  Random random(3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Vector3(3, -1, 2).normalized()).toRotationMatrix();
  for (int run = 0; run < 200; ++run) {
    CollapsedSkeleton collapsed = random_collapsed(random);
    for (CollapsedNode& node : collapsed.nodes) node.area = random.uniform(0.1, 1);
    const auto count = static_cast<Index>(collapsed.nodes.size());
    const std::vector<Index> place = permutation(count, random);
    CollapsedSkeleton copy = collapsed;
    for (Index i = 0; i < count; ++i) {
      copy.nodes[place[i]] = collapsed.nodes[i];
      copy.nodes[place[i]].position = turn * collapsed.nodes[i].position;
    }
    for (CollapsedEdge& e : copy.edges) {
      const Index a = place[e.first], b = place[e.second];
      e.first = std::min(a, b);
      e.second = std::max(a, b);
    }
    std::sort(copy.edges.begin(), copy.edges.end(), [](const auto& x, const auto& y) {
      return std::make_pair(x.first, x.second) < std::make_pair(y.first, y.second);
    });
    const ArcGraph expected = make_arc_graph(collapsed), graph = make_arc_graph(copy);
    REQUIRE(graph.hub_count() == expected.hub_count());
    REQUIRE(graph.arc_count() == expected.arc_count());
    for (Index h = 0; h < graph.hub_count(); ++h)
      REQUIRE((graph.hub_position[h] - turn * expected.hub_position[h]).norm() < 1e-12);
    for (Index a = 0; a < graph.arc_count(); ++a) {
      const auto &points = graph.arcs[a].points, &expected_points = expected.arcs[a].points;
      REQUIRE(points.size() == expected_points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        REQUIRE((points[i] - turn * expected_points[i]).norm() < 1e-12);
    }
  }
}

TEST_CASE("Of several balls that touch a vertex the same one has it however the model is turned") {
  // All nodes see the vertex (6, 6, 3) on the inner edge of an angle as their nearest.
  VoxelSolid solid;
  solid.box({0, 0, 0}, {12, 6, 6});
  solid.box({0, 0, 0}, {6, 12, 6});
  const PolygonSoup soup = boundary(solid);
  std::vector<Index> expected;
  for (int run = 0; run < 12; ++run) {
    const Vector3 axis(1, 2, 3 + run);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7 * run, axis.normalized()).toRotationMatrix();
    PolygonSoup turned = soup;
    for (Vector3& p : turned.points) p = turn * p;
    const SurfaceSnapshot surface = make_snapshot(to_mesh(turned));
    const auto place = [&](double x, double y) -> Vector3 {
      return surface.frame.to_normalised(turn * Vector3(x, y, 3));
    };
    ArcGraph graph;
    for (const Vector3& p : {place(4.5, 4.5), place(5.7, 4.1), place(4.1, 5.7)}) graph.add_hub(p);
    line(graph, 0, 1, 8);
    line(graph, 0, 2, 8);
    graph.hub_of_vertex.assign(surface.vertex_count(), 0);
    graph.arc_of_vertex.assign(surface.vertex_count(), kNone);
    const std::vector<double> none(surface.vertex_count(), 0.0);
    const CurveSkeleton skeleton =
        make_curve_skeleton(graph, surface, BoundingVolumeHierarchy(surface), none, none);
    if (run == 0) expected = skeleton.node_of_vertex;
    CHECK(skeleton.node_of_vertex == expected);
  }
}

TEST_CASE("The finished skeleton is a simple graph of the same type; map, areas and radii are exact") {
  const DefaultMesh mesh = sphere(80);
  const SurfaceSnapshot surface = make_snapshot(scaled(translated(mesh, {4, 5, 6}), 3));
  const BoundingVolumeHierarchy solid(surface);
  const double scale = surface.frame.scale;
  double total = 0;
  for (const double a : surface.vertex_area) total += a * scale * scale;
  Random random(2);
  for (int run = 0; run < 60; ++run) {
    ArcGraph graph = random_arc_graph(random, 0.45);
    map_to_nearest(graph, surface.position);
    if (run % 2) dissolve_through_hubs(graph);
    std::vector<double> perimeter, error;
    for (Index v = 0; v < surface.vertex_count(); ++v) {
      perimeter.push_back(random.below(4) ? random.uniform(1, 2) : 0.0);
      error.push_back(random.uniform());
    }
    const CurveSkeleton skeleton = make_curve_skeleton(graph, surface, solid, perimeter, error);

    const GraphCounts counts = count_graph(skeleton);
    REQUIRE(GraphType{counts.components, counts.cycles} == type_of(graph));
    const std::set<std::array<Index, 2>> distinct(skeleton.edges.begin(), skeleton.edges.end());
    REQUIRE(distinct.size() == skeleton.edges.size());
    REQUIRE(std::is_sorted(skeleton.edges.begin(), skeleton.edges.end()));
    for (const auto& [a, b] : skeleton.edges) REQUIRE(a < b);

    const SurfaceMapReport map = report_surface_map(surface, skeleton);
    REQUIRE(map.partition);
    REQUIRE(map.share_in_one_patch == 1.0);
    double area = 0, all_error = 0, expected_error = 0;
    for (const SkeletonNode& node : skeleton.nodes) {
      area += node.area;
      all_error += node.area * node.slice_error;
      REQUIRE((node.perimeter == 0 || (node.perimeter >= scale && node.perimeter <= 2 * scale)));
    }
    for (Index v = 0; v < surface.vertex_count(); ++v)
      expected_error += surface.vertex_area[v] * scale * scale * error[v];
    REQUIRE(area == Approx(total));
    REQUIRE(all_error == Approx(expected_error));

    for (const SkeletonNode& node : skeleton.nodes) {
      double nearest = std::numeric_limits<double>::infinity();
      const Vector3 p = surface.frame.to_normalised(node.position);
      for (Index f = 0; f < surface.face_count(); ++f)
        nearest = std::min(nearest, distance_to_triangle(p, {surface.position[surface.origin[3 * f]],
                                                             surface.position[surface.origin[3 * f + 1]],
                                                             surface.position[surface.origin[3 * f + 2]]}));
      REQUIRE(node.radius == Approx(nearest * scale).margin(1e-9));
    }
  }
}

TEST_CASE("Loops and parallel arcs without inner points are told apart") {
  const SurfaceSnapshot surface = make_snapshot(sphere(60));
  const BoundingVolumeHierarchy solid(surface);
  ArcGraph graph;
  graph.add_hub({0, 0, 0});
  graph.add_hub({0.1, 0, 0});
  for (int i = 0; i < 3; ++i) add_arc(graph, i % 2, 1 - i % 2);
  for (int i = 0; i < 2; ++i) add_arc(graph, 1, 1);
  map_to_nearest(graph, surface.position);
  const std::vector<double> zero(surface.position.size(), 0.0);
  const CurveSkeleton skeleton = make_curve_skeleton(graph, surface, solid, zero, zero);
  const GraphCounts counts = count_graph(skeleton);
  CHECK(counts.components == 1);
  CHECK(counts.cycles == 4);
  CHECK(branches(skeleton).size() == 5);
}

TEST_CASE("A lone hub takes all of its component") {
  const SurfaceSnapshot surface = make_snapshot(sphere(60));
  const BoundingVolumeHierarchy solid(surface);
  ArcGraph graph;
  graph.add_hub({0, 0, 0});
  map_to_nearest(graph, surface.position);
  const std::vector<double> zero(surface.position.size(), 0.0);
  const CurveSkeleton skeleton = make_curve_skeleton(graph, surface, solid, zero, zero);
  REQUIRE(skeleton.nodes.size() == 1);
  CHECK(skeleton.edges.empty());
  CHECK(skeleton.nodes[0].radius == Approx(surface.frame.scale * solid.distance(Vector3::Zero())));
  CHECK(std::all_of(skeleton.node_of_vertex.begin(), skeleton.node_of_vertex.end(),
                    [](Index i) { return i == 0; }));
}
