// Pieces of vessels, cut off just beside where they branch: each flat cap is an end.
#include "mspskel/limbs/detail/flat_ends.h"

#include <catch2/catch.hpp>
#include <limits>

#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/render/render.h"
#include "support/pipes.h"
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

struct Stub {
  double place, radius, top;
};

// A header of radius 1 along x, from -4 to 4, and stubs that stand up from it.
DefaultMesh header(const std::vector<Stub>& stubs) {
  std::vector<Pipe> pipes{{{-4, 0, 0}, {4, 0, 0}, 1.0}};
  for (const Stub& stub : stubs)
    pipes.push_back({{stub.place, 0, 0}, {stub.place, 0, stub.top}, stub.radius});
  return united(pipes, 0.15);
}

double distance_to_leaf(const CurveSkeleton& skeleton, const Vector3& x) {
  const auto neighbours = adjacency(skeleton);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (neighbours[i].size() == 1) nearest = std::min(nearest, (skeleton.nodes[i].position - x).norm());
  return nearest;
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
      for (const Outlet& outlet : outlets)
        CHECK(distance_to_leaf(skeleton, outlet.centre()) < 0.4 * outlet.radius);
    }
  }
}

TEST_CASE("Stubs near the ends of a header and these ends have a leaf each, in the middles of their caps") {
  const std::vector<std::vector<Stub>> rows = {
      {{-2.8, 0.4, 2.4}, {0, 0.4, 2.4}, {2.8, 0.4, 2.4}},
      {{-2.6, 0.5, 2.0}, {-0.8, 0.3, 1.8}, {1.0, 0.6, 2.2}, {2.9, 0.3, 1.8}},
      {{-2.4, 0.3, 2.2}, {2.5, 0.6, 2.0}}};
  for (const std::vector<Stub>& stubs : rows)
    for (const double noise : {0.0, 0.05}) {
      CAPTURE(stubs.size(), noise);
      const CurveSkeleton skeleton = extract_skeleton(jittered(header(stubs), 5, noise)).skeleton;
      CHECK(count_graph(skeleton).leaves == static_cast<Index>(stubs.size() + 2));
      for (const double end : {-4.0, 4.0}) CHECK(distance_to_leaf(skeleton, {end, 0, 0}) < 0.4);
      for (const Stub& stub : stubs)
        CHECK(distance_to_leaf(skeleton, {stub.place, 0, stub.top}) < 0.5 * stub.radius);
    }
}

TEST_CASE("The rim of a flat end may be jagged") {
  const DefaultMesh mesh = united({{{-1.5, 0, 0}, {1.5, 0, 0}, 1.0}, {{0, 0, 0}, {0, 0, 1.5}, 0.8}}, 0.08);
  const Solid solid(jittered(mesh, 3, 0.2));
  CHECK(detail::FlatEndSearch(solid.surface, solid.hierarchy, {}).run().size() == 3);
}

TEST_CASE("A jug has an axis from its mouth to its bottom, and a loop") {
  for (const double bottom : {-1.0, -1.4}) {
    std::vector<Pipe> pipes{{{0, 0, bottom}, {0, 0, 1}, 1.0}, {{0, 0, 0}, {0, 0, 2}, 0.4}};
    const std::vector<Vector3> handle = {
        {0.5, 0, 0.7}, {1.5, 0, 0.7}, {1.9, 0, 0.1}, {1.5, 0, -0.5}, {0.5, 0, -0.5}};
    for (std::size_t i = 1; i < handle.size(); ++i) {
      const Vector3 overlap = 0.05 * (handle[i] - handle[i - 1]).normalized();
      pipes.push_back({handle[i - 1] - overlap, handle[i] + overlap, 0.15});
    }
    const CurveSkeleton skeleton = extract_skeleton(united(pipes, 0.15)).skeleton;
    CAPTURE(bottom);
    CHECK(count_graph(skeleton).leaves == 2);
    CHECK(count_graph(skeleton).cycles == 1);
    CHECK(distance_to_leaf(skeleton, {0, 0, 2}) < 0.2);
    CHECK(distance_to_leaf(skeleton, {0, 0, bottom}) < 0.3);
  }
}

TEST_CASE("A flat spanner has a loop, and no end but those of its jaw") {
  for (const int length : {8, 12}) {
    VoxelSolid spanner;
    spanner.box({0, 0, 0}, {length, 2, 1});
    spanner.box({length, -1, 0}, {length + 1, 3, 1});
    for (const int side : {-1, 2}) spanner.box({length + 1, side, 0}, {length + 3, side + 1, 1});
    spanner.box({-4, -1, 0}, {0, 3, 1});
    for (const int x : {-3, -2})
      for (const int y : {0, 1}) spanner.cells.erase({x, y, 0});
    const DefaultMesh mesh = rotated(to_mesh(boundary(spanner, 3)), {0.2, 0.5, -0.8}, 0.7);
    const GraphCounts counts = count_graph(extract_skeleton(mesh).skeleton);
    CAPTURE(length);
    CHECK(counts.leaves == 2);
    CHECK(counts.cycles == 1);
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
  for (const double foot : {0.6, 1.3, 1.8, 2.5}) {
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

TEST_CASE("A lamp's arc runs from its base through its pole into its shade, whatever the shade's height") {
  for (const double height : {0.8, 1.2, 1.4, 1.6, 2.0, 2.6}) {
    const double top = 5.5 + height;
    const CurveSkeleton skeleton = extract_skeleton(united({{{0, 0, 0}, {0, 0, 0.25}, 0.9},
                                                            {{0, 0, 0.1}, {0, 0, 6}, 0.12},
                                                            {{0, 0, 5.5}, {0, 0, top}, 1.1}},
                                                           0.12))
                                       .skeleton;
    CAPTURE(height);
    double lowest = top, highest = 0;
    for (const SkeletonNode& node : skeleton.nodes) {
      lowest = std::min(lowest, node.position.z());
      highest = std::max(highest, node.position.z());
    }
    CHECK(lowest < 0.5);
    CHECK(highest > 5.7);
  }
}

TEST_CASE("A rod with an eye has an arc to the end of what carries it, as short as that may be") {
  for (const double length : {1.0, 1.3, 1.7}) {
    std::vector<Pipe> pipes{{{0, 0, 0}, {0, 0, length}, 0.8}, {{0, 0, -4}, {0, 0, 0.3}, 0.2}};
    for (int i = 0; i < 8; ++i) {
      const auto at = [](int k) { return Vector3(std::sin(kPi * k / 4), 0, -4.8 + std::cos(kPi * k / 4)); };
      const Vector3 overlap = 0.07 * (at(i + 1) - at(i));
      pipes.push_back({at(i) - overlap, at(i + 1) + overlap, 0.25});
    }
    const CurveSkeleton skeleton = extract_skeleton(united(pipes, 0.15)).skeleton;
    CAPTURE(length);
    CHECK(count_graph(skeleton).cycles == 1);
    CHECK(count_graph(skeleton).leaves == 1);
    double highest = -6;
    for (const SkeletonNode& node : skeleton.nodes) highest = std::max(highest, node.position.z());
    CHECK(highest > 0.2 * length);
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
