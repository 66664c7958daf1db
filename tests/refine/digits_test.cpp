// Fingers: as many as a hand has, each with an arc of its own; none where there is no hand.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mspskel/extract_skeleton.h"
#include "mspskel/refine/find_digits.h"
#include "mspskel/refine/reach_digits.h"
#include "support/arc_graphs.h"
#include "support/questions.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

constexpr double kFingerRadius = 0.06;

// Two plain limbs, and one with a palm and fingers in its plane; the fingers are the last nodes.
BallGraph figure(int fingers) {
  BallGraph graph;
  graph.blend = 0.05;
  graph.nodes = {{{0, 0, 0}, 0.6}, {{-2.6, 0.3, -1.8}, 0.35}, {{-2.6, -0.3, 1.8}, 0.35}, {{3, 0, 0}, 0.3}};
  graph.edges = {{0, 1}, {0, 2}, {0, 3}};
  for (int i = 0; i < fingers; ++i) {
    const double turn = (i - 0.5 * (fingers - 1)) * 0.6;
    const Vector3 along(std::cos(turn), std::sin(turn), 0);
    graph.nodes.push_back({graph.nodes[3].position + 0.52 * along, kFingerRadius});
    graph.nodes.push_back({graph.nodes[3].position + 0.2 * along, kFingerRadius});
    graph.edges.push_back({4 + 2 * i, 5 + 2 * i});
    graph.edges.push_back({3, 5 + 2 * i});
  }
  return graph;
}

Vector3 finger_tip(const BallGraph& graph, int i) { return graph.nodes[4 + 2 * i].position; }

// The figure's graph without its fingers: the arm ends in the palm.
ArcGraph without_fingers(const Solid& solid, const BallGraph& figure) {
  ArcGraph graph;
  for (int i = 0; i < 4; ++i) graph.add_hub(solid.at(figure.nodes[i].position));
  for (const Index tip : {1, 2, 3}) {
    Arc arc;
    arc.hub = {0, tip};
    arc.points = {graph.hub_position[0], graph.hub_position[tip]};
    graph.arcs.push_back(arc);
  }
  subdivide(graph, 0.008);
  graph.arc_of_vertex.assign(solid.surface.position.size(), kNone);
  graph.hub_of_vertex.assign(solid.surface.position.size(), 0);
  return graph;
}

std::vector<Vector3> leaf_ends(const CurveSkeleton& skeleton) {
  std::vector<int> degree(skeleton.nodes.size(), 0);
  for (const auto& [a, b] : skeleton.edges) {
    ++degree[a];
    ++degree[b];
  }
  std::vector<Vector3> ends;
  for (std::size_t i = 0; i < degree.size(); ++i)
    if (degree[i] == 1) ends.push_back(skeleton.nodes[i].position);
  return ends;
}

}  // namespace

TEST_CASE("A hand has as many digits as fingers") {
  for (const int fingers : {3, 4, 5}) {
    CAPTURE(fingers);
    const BallGraph graph = figure(fingers);
    const Solid solid(to_mesh(skin_graph(graph, 18000)));
    const std::vector<Digit> digits =
        find_digits(without_fingers(solid, graph), solid.surface, solid.hierarchy, {});
    REQUIRE(digits.size() == static_cast<std::size_t>(fingers));
    for (int i = 0; i < fingers; ++i) {
      const Vector3 tip = finger_tip(graph, i);
      const auto own = std::find_if(digits.begin(), digits.end(), [&](const Digit& digit) {
        return (solid.model(digit.tip) - tip).norm() < 1.2 * kFingerRadius;
      });
      REQUIRE(own != digits.end());
      const double scale = solid.surface.frame.scale;
      CHECK(own->radius * scale == Approx(kFingerRadius).epsilon(0.25));
      CHECK(own->length * scale > 0.15);
      CHECK(own->length * scale < 0.52);
      for (const Vector3& x : own->way) CHECK(solid.hierarchy.inside(x));
      for (const Index v : own->vertices) CHECK((solid.model(solid.surface.position[v]) - tip).norm() < 0.65);
    }
  }
}

TEST_CASE("Digits are found beside others that have arcs already") {
  const BallGraph graph = figure(5);
  const Solid solid(to_mesh(skin_graph(graph, 18000)));
  const ArcGraph bare = without_fingers(solid, graph);
  const std::vector<Digit> digits = find_digits(bare, solid.surface, solid.hierarchy, {});
  REQUIRE(digits.size() == 5);
  for (std::size_t first = 0; first < 5; ++first)
    for (std::size_t second = first + 1; second < 5; ++second) {
      CAPTURE(first, second);
      ArcGraph arcs = bare;
      // The arm's own arc is led on into one of the two, so there is a joint in the palm.
      reach_digits(arcs, solid.surface, solid.hierarchy, {digits[first], digits[second]}, 0.008, 1.0);
      REQUIRE(joint_count(arcs) == 2);
      CHECK(find_digits(arcs, solid.surface, solid.hierarchy, {}).size() == 5);
    }
}

TEST_CASE("Digits of a rounded mesh have vertices and a way, if there are any") {
  const BallGraph graph = figure(5);
  const DefaultMesh mesh = to_mesh(skin_graph(graph, 8000));
  for (double grid = 0.004; grid < 0.13; grid *= 1.06) {
    CAPTURE(grid);
    const Solid solid(moved(mesh, [&](const Vector3& p) {
      return Vector3(grid * std::round(p.x() / grid), grid * std::round(p.y() / grid),
                     grid * std::round(p.z() / grid));
    }));
    for (const Digit& digit :
         find_digits(without_fingers(solid, graph), solid.surface, solid.hierarchy, {})) {
      CHECK_FALSE(digit.vertices.empty());
      CHECK_FALSE(digit.way.empty());
      CHECK((std::isfinite(digit.length) && std::isfinite(digit.radius)));
      for (const Vector3& x : digit.way) CHECK(x.allFinite());
    }
  }
}

TEST_CASE("Two fingers are a cleft") {
  const BallGraph graph = figure(2);
  const Solid solid(to_mesh(skin_graph(graph, 18000)));
  CHECK(find_digits(without_fingers(solid, graph), solid.surface, solid.hierarchy, {}).empty());
}

TEST_CASE("Digits that are no longer than noise, or not slender enough, are none") {
  const BallGraph graph = figure(4);
  const Solid solid(to_mesh(skin_graph(graph, 18000)));
  const ArcGraph arcs = without_fingers(solid, graph);
  LimbOptions plump, large;
  plump.slenderness = 10;
  large.smallest = 0.06;
  CHECK(find_digits(arcs, solid.surface, solid.hierarchy, plump).empty());
  CHECK(find_digits(arcs, solid.surface, solid.hierarchy, large).empty());
}

TEST_CASE("Each digit gets an arc that takes its vertices, stays inside and keeps the type") {
  const BallGraph graph = figure(5);
  const Solid solid(to_mesh(skin_graph(graph, 18000)));
  ArcGraph arcs = without_fingers(solid, graph);
  const GraphType type = type_of(arcs);
  const std::vector<Digit> digits = find_digits(arcs, solid.surface, solid.hierarchy, {});
  const double step = 0.008;
  CHECK(questions_of([&](const ProgressCallback& progress) {
          ArcGraph again = arcs;
          Execution execution;
          execution.progress = progress;
          reach_digits(again, solid.surface, solid.hierarchy, digits, step, 1.0, execution);
        }) >= static_cast<int>(digits.size()));
  // The arm's own arc is led on into one finger.
  CHECK(reach_digits(arcs, solid.surface, solid.hierarchy, digits, step, 1.0) >= 4);
  CHECK(type_of(arcs) == type);
  CHECK(arcs_meet_hubs(arcs));
  CHECK(map_is_partition(arcs));
  CHECK(crossings(arcs, solid.hierarchy) == 0);
  CHECK(leaf_count(arcs) == 7);
  for (const Arc& arc : arcs.arcs)
    for (std::size_t i = 1; arc.alive && i < arc.points.size(); ++i)
      CHECK((arc.points[i] - arc.points[i - 1]).norm() < 1.3 * step);
  const auto at = arcs.incidence();
  for (const Digit& digit : digits) {
    Index end = kNone;
    for (Index h = 0; h < arcs.hub_count(); ++h)
      if (arcs.hub_alive[h] && at[h].size() == 1 &&
          (arcs.hub_position[h] - digit.tip).norm() < 2 * digit.radius)
        end = h;
    REQUIRE(end != kNone);
  }
  // A second time there is nothing left to reach.
  const std::vector<Digit> again = find_digits(arcs, solid.surface, solid.hierarchy, {});
  CHECK(reach_digits(arcs, solid.surface, solid.hierarchy, again, step, 1.0) == 0);
}

TEST_CASE("A skeleton ends in every finger, wherever the figure lies and however its mesh is stored") {
  const BallGraph graph = figure(5);
  const DefaultMesh mesh = to_mesh(skin_graph(graph, 18000));
  const ExtractResult result = extract_skeleton(mesh);
  const std::vector<Vector3> ends = leaf_ends(result.skeleton);
  CHECK(ends.size() == 7);
  for (int i = 0; i < 5; ++i)
    CHECK(std::any_of(ends.begin(), ends.end(), [&](const Vector3& end) {
      return (end - finger_tip(graph, i)).norm() < 1.5 * kFingerRadius;
    }));
  // A finger's tip maps to a node in that finger.
  for (std::size_t v = 0; v < result.surface.position.size(); ++v) {
    const Vector3 x = result.surface.frame.to_model(result.surface.position[v]);
    for (int i = 0; i < 5; ++i)
      if ((x - finger_tip(graph, i)).norm() < 1.1 * kFingerRadius)
        CHECK((result.skeleton.nodes[result.skeleton.node_of_vertex[v]].position - x).norm() <
              4 * kFingerRadius);
  }
  const ExtractResult moved =
      extract_skeleton(translated(scaled(rotated(mesh, {0.3, -0.8, 0.5}, 1.1), 37.5), {10, -20, 5}));
  CHECK(leaf_ends(moved.skeleton).size() == 7);
}

TEST_CASE("Where there are no hands nothing changes") {
  for (const char* name : {"octoped", "quadruped"}) {
    const ExtractResult result = extract_skeleton(sample(name, 5000));
    CHECK(result.digits == 0);
  }
}
