// Vessels: the law that their arcs follow from the shape and not from where the collapse put them.
#include "mspskel/solid/shells.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>

#include "mspskel/arcs/cycle_rank.h"
#include "mspskel/arcs/tighten_walls.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/samples/polygonise.h"
#include "mspskel/solid/detail/inner_graph.h"
#include "support/questions.h"
#include "support/solids.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

constexpr double kWall = 0.12;

double goblet_distance(const Vector3& p, double stem) {
  const Vector3 q(std::hypot(p.x(), p.y()), 0, p.z());
  const BallNode floor{{0, 0, 0}, kWall / 2}, edge{{0.8, 0, 0}, kWall / 2}, rim{{0.9, 0, 1.6}, kWall / 2};
  double d = std::min(round_cone_distance(q, floor, edge), round_cone_distance(q, edge, rim));
  if (stem > 0) {
    const BallNode foot{{0, 0, -stem}, kWall / 2}, foot_edge{{0.7, 0, -stem}, kWall / 2},
        top{{0, 0, 0}, kWall}, bottom{{0, 0, -stem}, kWall};
    d = std::min({d, round_cone_distance(q, foot, foot_edge), round_cone_distance(q, bottom, top)});
  }
  return d;
}

// A glass, on a stem if that has a length.
DefaultMesh glass(double stem, Index vertices) {
  ImplicitSolid solid;
  solid.low = {-1.1, -1.1, -stem - 0.2};
  solid.high = {1.1, 1.1, 1.8};
  solid.value = [stem](const Vector3& p) { return goblet_distance(p, stem); };
  return to_mesh(polygonise(solid, vertices, kWall / 2));
}

// A glass with a rod that leaves its side.
DefaultMesh pan(Index vertices) {
  const BallNode near{{0.8, 0, 0.8}, 0.16}, far{{3.5, 0, 0.8}, 0.16};
  ImplicitSolid solid;
  solid.low = {-1.1, -1.1, -0.2};
  solid.high = {3.8, 1.1, 1.8};
  solid.value = [=](const Vector3& p) {
    const double beyond = 0.85 - p.x();
    return std::min(goblet_distance(p, 0), std::max(round_cone_distance(p, near, far), beyond));
  };
  return to_mesh(polygonise(solid, vertices, kWall / 2));
}

bool is_shell(const DefaultMesh& mesh) {
  const Solid solid(mesh);
  return find_shells(solid.surface, solid.hierarchy, solid.slices()) == std::vector<bool>{true};
}

}  // namespace

TEST_CASE("Thin walls round a hollow are shells, and thick or flat things are not") {
  CHECK(is_shell(glass(0, 4000)));
  CHECK(is_shell(glass(1.5, 6000)));
  CHECK(is_shell(sample("cup", 6000)));
  CHECK_FALSE(is_shell(prism(4, 5, 9)));
  CHECK_FALSE(is_shell(sample("plate", 3000)));
  CHECK_FALSE(is_shell(to_mesh(polygonise(skin_solid(tripod()), 1500, 0.2))));
}

// Where many tunnels are closed the slices of a sponge are walls that go round hundreds of them.
TEST_CASE("A sponge of thin walls is no shell") {
  const SurfaceSnapshot surface = snapshot_of(foam({7, 7, 7}, 0.55), 1);
  const SliceTracer tracer(surface);
  VertexSlices slices = search_minimum_slice_perimeters(tracer, {});
  compute_slice_errors(tracer, {}, slices);
  CHECK(find_shells(surface, BoundingVolumeHierarchy(surface), slices) == std::vector<bool>{false});
}

TEST_CASE("The chords of a wall are measured with questions between them") {
  const Solid solid(glass(0, 8000));
  const VertexSlices slices = solid.slices();
  CHECK(questions_of([&](const ProgressCallback& progress) {
          (void)find_shells(solid.surface, solid.hierarchy, slices, progress);
        }) > 4);
}

TEST_CASE("A glass keeps what its axis has of the solid, whatever the triangles") {
  for (const double stem : {0.0, 1.5})
    for (const Index vertices : {5000, 8000}) {
      const Vector3 turn(1, 2, -0.5);
      const Eigen::AngleAxisd rotation(0.8, turn.normalized());
      const ExtractResult result = extract_skeleton(rotated(glass(stem, vertices), turn, 0.8));
      CHECK(count_graph(result.skeleton).leaves == 2);
      CHECK(count_graph(result.skeleton).cycles == 0);
      double low = 9, high = -9;
      for (const SkeletonNode& node : result.skeleton.nodes) {
        const Vector3 x = rotation.inverse() * node.position;
        CHECK(std::hypot(x.x(), x.y()) < 0.03);
        low = std::min(low, x.z());
        high = std::max(high, x.z());
      }
      CHECK(low > -stem - kWall);
      CHECK(low < -stem);
      CHECK(high < 0.6 * kWall);
      CHECK(high > -kWall);
    }
}

namespace {

// A vessel turned round the z axis: the middle of its wall, from the middle of the floor to the rim.
struct Vessel {
  std::vector<Vector2> wall;  // distance from the axis, height
  struct Handle {
    double angle;
    std::size_t low, high;  // points of the wall where it leaves and returns
    double reach, radius;   // how far it stands out, half its thickness
  };
  std::vector<Handle> handles;
  std::vector<std::pair<BallNode, BallNode>> spouts;

  Vector3 at(double angle, const Vector2& x) const {
    return {x.x() * std::cos(angle), x.x() * std::sin(angle), x.y()};
  }
  // Half an ellipse over the line between its ends.
  std::vector<Vector3> line(const Handle& h) const {
    std::vector<Vector3> points;
    constexpr int kSteps = 12;
    for (int i = 0; i <= kSteps; ++i) {
      const double t = kPi * i / kSteps, share = (1 - std::cos(t)) / 2;
      const Vector2 x =
          wall[h.low] + share * (wall[h.high] - wall[h.low]) + Vector2(h.reach * std::sin(t), 0);
      points.push_back(at(h.angle, x));
    }
    return points;
  }
  double shortest_loop(const Handle& h) const {
    double length = 0;
    for (std::size_t i = h.low; i < h.high; ++i) length += (wall[i + 1] - wall[i]).norm();
    const std::vector<Vector3> points = line(h);
    for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    return length;
  }
  double distance(const Vector3& p) const {
    const Vector3 q(std::hypot(p.x(), p.y()), 0, p.z());
    double shell = 1e9, inside_of_wall = 1e9;
    for (std::size_t i = 1; i < wall.size(); ++i) {
      const Vector3 a(wall[i - 1].x(), 0, wall[i - 1].y()), b(wall[i].x(), 0, wall[i].y());
      shell = std::min(shell, round_cone_distance(q, {a, kWall / 2}, {b, kWall / 2}));
    }
    // Handles and spouts end in the wall: what stands before it, seen from the axis, is cut off.
    for (std::size_t i = 1; i < wall.size(); ++i)
      if (std::min(wall[i - 1].y(), wall[i].y()) <= p.z() &&
          p.z() <= std::max(wall[i - 1].y(), wall[i].y()) && wall[i].y() != wall[i - 1].y()) {
        const double share = (p.z() - wall[i - 1].y()) / (wall[i].y() - wall[i - 1].y());
        inside_of_wall =
            std::min(inside_of_wall, q.x() - (wall[i - 1].x() + share * (wall[i].x() - wall[i - 1].x())));
      }
    double tubes = 1e9;
    for (const Handle& h : handles) {
      const std::vector<Vector3> points = line(h);
      for (std::size_t i = 1; i < points.size(); ++i)
        tubes = std::min(tubes, round_cone_distance(p, {points[i - 1], h.radius}, {points[i], h.radius}));
    }
    for (const auto& [from, to] : spouts) tubes = std::min(tubes, round_cone_distance(p, from, to));
    return std::min(shell, std::max(tubes, -inside_of_wall));
  }
  DefaultMesh mesh(Index vertices) const {
    ImplicitSolid solid;
    solid.low = {-2.6, -2.6, -0.3};
    solid.high = {2.6, 2.6, 2.3};
    solid.value = [this](const Vector3& p) { return distance(p); };
    return to_mesh(polygonise(solid, vertices, kWall / 2));
  }
};

// Of the shortest cycle through the edge nearest to a place, model units.
double loop_through(const CurveSkeleton& skeleton, const Vector3& place) {
  const auto length = [&](const std::array<Index, 2>& e) {
    return (skeleton.nodes[e[0]].position - skeleton.nodes[e[1]].position).norm();
  };
  const auto away = [&](const std::array<Index, 2>& e) {
    return ((skeleton.nodes[e[0]].position + skeleton.nodes[e[1]].position) / 2 - place).norm();
  };
  const std::array<Index, 2> cut =
      *std::min_element(skeleton.edges.begin(), skeleton.edges.end(),
                        [&](const auto& a, const auto& b) { return away(a) < away(b); });
  std::vector<double> way(skeleton.nodes.size(), 1e9);
  way[cut[0]] = 0;
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (const auto& edge : skeleton.edges)
      for (const int end : {0, 1})
        if (edge != cut && way[edge[end]] + length(edge) < way[edge[1 - end]]) {
          way[edge[1 - end]] = way[edge[end]] + length(edge);
          shorter = true;
        }
  }
  return way[cut[1]] + length(cut);
}

}  // namespace

TEST_CASE("Loops of mugs, vases and teapots are at most 1.3 times as long as the shortest of their class") {
  const Vessel mug{{{0, 0}, {0.8, 0}, {0.8, 0.4}, {0.8, 1.3}, {0.8, 1.7}}, {{0.4, 2, 3, 0.6, 0.13}}, {}};
  const Vessel vase{
      {{0, 0}, {0.5, 0}, {0.9, 0.6}, {0.9, 1.0}, {0.5, 1.5}, {0.6, 2.0}}, {{0, 3, 5, 0.5, 0.1}}, {}};
  const Vessel teapot{{{0, 0}, {0.6, 0}, {1, 0.5}, {0.9, 1.0}, {0.6, 1.4}, {0.6, 1.7}},
                      {{0, 2, 4, 0.8, 0.12}},
                      {{{{-0.9, 0, 0.6}, 0.2}, {{-1.9, 0, 1.3}, 0.12}}}};
  Vessel amphora = vase, pair = mug;
  amphora.handles.push_back({kPi, 3, 5, 0.5, 0.1});
  pair.handles.push_back({2.0, 2, 3, 0.6, 0.13});
  for (const Vessel& vessel : {mug, vase, teapot, amphora, pair}) {
    const ExtractResult result = extract_skeleton(vessel.mesh(7000));
    CHECK(count_graph(result.skeleton).cycles == static_cast<Index>(vessel.handles.size()));
    for (const Vessel::Handle& handle : vessel.handles) {
      const std::vector<Vector3> line = vessel.line(handle);
      const double loop = loop_through(result.skeleton, line[line.size() / 2]);
      INFO("handle at " << handle.angle << " of a vessel with " << vessel.wall.size() << " points");
      CHECK(loop <= 1.3 * vessel.shortest_loop(handle));
      CHECK(loop >= 0.8 * vessel.shortest_loop(handle));
    }
  }
}

TEST_CASE("A cup's loop runs straight down the wall, and an arc leads on to the middle of the floor") {
  for (const Index vertices : {4000, 7000}) {
    const std::uint64_t seed = vertices == 4000 ? 0 : 7;
    DefaultMesh mesh = sample("cup", vertices);
    if (seed > 0) mesh = renumbered(jittered(mesh, seed, 0.01), seed);
    const ExtractResult result = extract_skeleton(mesh);
    const GraphCounts counts = count_graph(result.skeleton);
    CHECK(counts.leaves == 1);
    CHECK(counts.cycles == 1);
    // The sample stands on the y axis and its handle lies in the plane z = 0, which no arc leaves by more
    // than half the wall.
    for (const SkeletonNode& node : result.skeleton.nodes) CHECK(std::abs(node.position.z()) < 0.07);
    // Handle 2.0, wall 1.2, down to the floor 0.5, along it 0.8.
    CHECK(counts.length < 5.0);
    const auto next = adjacency(result.skeleton);
    for (std::size_t i = 0; i < next.size(); ++i)
      if (next[i].size() == 1) CHECK((result.skeleton.nodes[i].position - Vector3(0, -1, 0)).norm() < 0.3);
  }
}

TEST_CASE("A loop round the far side of a cup's wall is drawn to the near one") {
  const Solid solid(sample("cup", 4000));
  const auto& frame = solid.surface.frame;
  // From the top of the handle down it, then once round the wall and back up to the top.
  std::vector<Vector3> points;
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = kPi * (0.5 - static_cast<double>(i) / kSteps);
    points.emplace_back(0.97 + 0.65 * std::cos(angle), 0.05 + 0.6 * std::sin(angle), 0);
  }
  for (int i = 1; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps, angle = 2 * kPi * share, y = 1.2 * share - 0.55,
                 radius = 0.9 + 0.1 * y;
    points.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
  }
  for (Vector3& x : points) x = frame.to_normalised(x);
  points.push_back(points.front());
  ArcGraph graph;
  const Index hub = graph.add_hub(points.front());
  graph.arcs.push_back({{hub, hub}, points, true});
  graph.arc_of_vertex.assign(solid.surface.position.size(), 0);
  graph.hub_of_vertex.assign(solid.surface.position.size(), kNone);
  const CrossingLabels crossings(compute_volume_cocycles(solid.surface));
  REQUIRE(arc_length(graph.arcs[0]) * frame.scale > 7);
  mspskel::detail::InnerGraph inner(solid.surface, solid.hierarchy);
  tighten_in_walls(graph, inner, {true}, 0.008, crossings);
  CHECK(cycle_rank(graph, crossings).rank == 1);
  double loop = 0;
  for (const Arc& arc : graph.arcs)
    if (arc.alive && graph.incidence()[arc.hub[1]].size() > 1) loop += arc_length(arc) * frame.scale;
  // Handle 2.0, wall 1.2.
  CHECK(loop < 1.3 * 3.2);
}

TEST_CASE("Tips in the wall of a shell are dropped, and a solid limb's is not") {
  const Solid solid(pan(6000));
  const VertexSlices slices = solid.slices();
  const std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, slices, {});
  REQUIRE(tips.size() == 1);
  CHECK((solid.model(tips.front().position) - Vector3(3.66, 0, 0.8)).norm() < 0.2);
  // The end of the rod is also far from the middle of a shell that is none.
  std::vector<LimbTip> all = tips;
  LimbTip rim;
  for (Index v = 0; v < solid.surface.vertex_count(); ++v) {
    const Vector3 x = solid.model(solid.surface.position[v]);
    if (x.z() > 1.5 && x.x() < -0.7) rim.cap.push_back(v);
  }
  rim.vertex = rim.cap.front();
  rim.measures.depth = 0.2;
  rim.measures.half_width = 0.2;
  all.push_back(rim);
  drop_tips_in_walls(solid.surface, solid.hierarchy, {false}, all);
  CHECK(all.size() == 2);
  drop_tips_in_walls(solid.surface, solid.hierarchy, {true}, all);
  REQUIRE(all.size() == 1);
  CHECK(all.front().vertex == tips.front().vertex);
}
