// Pieces of vessels, cut off just beside where they branch: each flat cap is an end.
#include "mspskel/limbs/detail/flat_ends.h"

#include <catch2/catch.hpp>

#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/render/render.h"
#include "support/solids.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

struct Outlet {
  Vector3 direction;  // unit
  double radius, distance;
  Vector3 centre() const { return distance * direction; }
};

// Tubes from the origin, cut across at a distance.
DefaultMesh cut_vessel(const std::vector<Outlet>& outlets, Index vertices) {
  BallGraph graph;
  graph.blend = 0.2;
  graph.nodes = {{Vector3::Zero(), 1.0}};
  for (const Outlet& outlet : outlets) {
    graph.edges.emplace_back(0, static_cast<Index>(graph.nodes.size()));
    graph.nodes.push_back({2 * outlet.centre(), outlet.radius});
  }
  PolygonSoup soup = skin_graph(graph, vertices);
  for (Vector3& p : soup.points)
    for (const Outlet& outlet : outlets)
      if (const double height = p.dot(outlet.direction); height > outlet.distance && p.norm() > 1)
        if ((p - height * outlet.direction).norm() < 1.5 * outlet.radius)
          p -= (height - outlet.distance) * outlet.direction;
  CoarseningOptions even;  // of the triangles, which the cut has pressed flat
  even.vertices = vertices / 3;
  return to_mesh(to_polygon_soup(coarsen_surface(make_snapshot(to_mesh(soup)), even).surface));
}

std::vector<std::vector<Outlet>> vessels() {
  const Vector3 x(1, 0, 0), z(0, 0, 1);
  return {{{z, 0.9, 1.5}, {Vector3(0.87, 0, -0.5), 0.8, 1.5}, {Vector3(-0.87, 0, -0.5), 0.7, 1.6}},
          {{x, 0.8, 1.5}, {-x, 0.7, 1.5}, {z, 0.75, 1.4}},
          {{x, 0.9, 1.6}, {z, 0.9, 1.6}},
          {{Vector3(0.58, 0.58, 0.58), 0.8, 1.5},
           {Vector3(-0.58, -0.58, 0.58), 0.7, 1.5},
           {Vector3(0.58, -0.58, -0.58), 0.7, 1.5},
           {Vector3(-0.58, 0.58, -0.58), 0.7, 1.5}}};
}

}  // namespace

TEST_CASE("A short vessel's skeleton ends in the middle of each of its caps") {
  for (std::vector<Outlet> outlets : vessels()) {
    for (Outlet& outlet : outlets) outlet.direction.normalize();
    for (const double noise : {0.0, 0.1}) {
      CAPTURE(outlets.size(), noise);
      const DefaultMesh mesh = jittered(cut_vessel(outlets, 6000), 11, noise);
      const CurveSkeleton skeleton = extract_skeleton(mesh).skeleton;
      CHECK(count_graph(skeleton).leaves == static_cast<Index>(outlets.size()));
      const auto neighbours = adjacency(skeleton);
      for (const Outlet& outlet : outlets) {
        double nearest = 10;
        for (std::size_t i = 0; i < neighbours.size(); ++i)
          if (neighbours[i].size() == 1)
            nearest = std::min(nearest, (skeleton.nodes[i].position - outlet.centre()).norm());
        CHECK(nearest < 0.4 * outlet.radius);
      }
    }
  }
}

TEST_CASE("The arms of square tees and crosses have an end each, and cubes none") {
  for (const int arms : {0, 3, 4}) {
    VoxelSolid cells;
    cells.box({0, 0, 0}, {1, 1, 1});
    if (arms > 0) cells.box({-1, 0, 0}, {2, 1, 1});
    if (arms > 0) cells.box({0, 0, 0}, {1, 1, 2});
    if (arms > 3) cells.box({0, 0, -1}, {1, 1, 1});
    const DefaultMesh mesh = rotated(to_mesh(boundary(cells, 4)), {0.2, 0.5, -0.8}, 0.7);
    CAPTURE(arms);
    const Solid solid(mesh);
    CHECK(detail::FlatEndSearch(solid.surface, solid.hierarchy, {}).run().size() ==
          static_cast<std::size_t>(arms));
    if (arms > 0) CHECK(count_graph(extract_skeleton(mesh).skeleton).leaves == arms);
  }
}

TEST_CASE("A stand with hooks on its top ends at its foot, however wide that is") {
  for (const double foot : {0.6, 1.3, 1.8}) {
    BallGraph graph;
    graph.blend = 0.05;
    graph.nodes = {{{0, 0, 0}, 0.2}, {{0, 0, 6}, 0.2}};
    graph.edges = {{0, 1}};
    for (const double angle : {0.3, 2.4, 4.5}) {
      graph.edges.emplace_back(1, static_cast<Index>(graph.nodes.size()));
      graph.nodes.push_back({{1.4 * std::cos(angle), 1.4 * std::sin(angle), 6.9}, 0.15});
    }
    PolygonSoup soup = skin_graph(graph, 6000);
    // The bottom of the pole is spread out to a disc.
    for (Vector3& p : soup.points)
      if (p.z() < 0.3) p.head<2>() *= 1 + (foot / 0.2 - 1) * std::min(1.0, (0.3 - p.z()) / 0.1);
    const CurveSkeleton skeleton = extract_skeleton(to_mesh(soup)).skeleton;
    CAPTURE(foot);
    CHECK(count_graph(skeleton).leaves == 4);
    double lowest = 10;
    for (const SkeletonNode& node : skeleton.nodes) lowest = std::min(lowest, node.position.z());
    CHECK(lowest < 0.5);
  }
}

TEST_CASE("Faces of blocks, thin discs and rounded ends are no flat ends, and caps of rods are") {
  const auto count = [](const DefaultMesh& mesh) {
    const Solid solid(mesh);
    return detail::FlatEndSearch(solid.surface, solid.hierarchy, {}).run().size();
  };
  CHECK(count(sample("box", 2000)) == 0);
  CHECK(count(sphere(1000)) == 0);
  CHECK(count(sample("capsule", 1000)) == 0);
  CHECK(count(test::tube(1, 0.5, 32, 8)) == 0);
  for (const double noise : {0.0, 0.1}) CHECK(count(jittered(test::tube(1, 4, 32, 24), 3, noise)) == 2);
}
