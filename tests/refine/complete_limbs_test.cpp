// Limbs without an arc get one, each once.
#include "mspskel/refine/complete_limbs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "mspskel/arcs/detail/arc_editor.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/refine/detail/arc_leaves.h"
#include "mspskel/refine/detail/equal_limbs.h"
#include "mspskel/refine/prune_branches.h"
#include "mspskel/refine/refine_arcs.h"
#include "mspskel/samples/blocks.h"
#include "mspskel/samples/polygonise.h"
#include "mspskel/samples/samples.h"
#include "mspskel/samples/skin_graph.h"
#include "refine/tripod_arcs.h"
#include "support/arc_graphs.h"
#include "support/solids.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Fins on a body: slabs in the shape of half discs, in planes through the x axis, at these angles about it.
ImplicitSolid finned(const std::vector<double>& angles) {
  constexpr double kHalfLength = 3, kFin = 0.75, kHalfThickness = 0.12, kRoot = 0.95;
  ImplicitSolid solid;
  solid.low = Vector3(-4.1, -2, -2);
  solid.high = -solid.low;
  solid.value = [=](const Vector3& x) {
    const Vector3 axis(std::max(0.0, std::abs(x.x()) - kHalfLength), x.y(), x.z());
    double value = axis.norm() - 1;
    for (const double angle : angles) {
      const Vector3 out(0, std::cos(angle), std::sin(angle)), across(0, -std::sin(angle), std::cos(angle));
      const double along = std::hypot(x.x(), x.dot(out) - kRoot);
      value = std::min(value, std::hypot(std::max(0.0, along - kFin), x.dot(across)) - kHalfThickness);
    }
    return value;
  };
  return solid;
}

// An arc along the x axis.
ArcGraph straight_axis(const Solid& solid, double from, double to) {
  ArcGraph graph;
  graph.add_hub(solid.at({from, 0, 0}));
  graph.add_hub(solid.at({to, 0, 0}));
  line(graph, 0, 1);
  map_to_nearest(graph, solid.surface.position);
  return graph;
}

// A ring of outer radius 1, inner radius `bore` and thickness 0.4 round the z axis, with teeth of length 0.5
// and width 0.45 on its outside.
DefaultMesh ring_gear(Index teeth, double bore) {
  constexpr Index kBetween = 4;  // points of the rim between two teeth
  constexpr double kHalfWidth = 0.225, kTip = 1.5, kHalfThickness = 0.2;
  const double half_angle = std::asin(kHalfWidth), pitch = 2 * kPi / teeth;
  std::vector<Vector3> outer;
  for (Index t = 0; t < teeth; ++t) {
    const Vector3 out(std::cos(t * pitch), std::sin(t * pitch), 0), across(-out.y(), out.x(), 0);
    for (const double side : {-1.0, 1.0}) {
      const Vector3 root = std::cos(half_angle) * out + side * kHalfWidth * across;
      const Vector3 tip = kTip * out + side * kHalfWidth * across;
      outer.push_back(side < 0 ? root : tip);
      outer.push_back(side < 0 ? tip : root);
    }
    for (Index i = 1; i <= kBetween; ++i) {
      const double angle = t * pitch + half_angle + i * (pitch - 2 * half_angle) / (kBetween + 1);
      outer.push_back({std::cos(angle), std::sin(angle), 0});
    }
  }
  PolygonSoup soup;
  const Vector3 up(0, 0, kHalfThickness);
  for (const Vector3& x : outer) {
    const Vector3 inner = bore * x.normalized();
    for (const Vector3& corner : {Vector3(inner - up), Vector3(x - up), Vector3(x + up), Vector3(inner + up)})
      soup.points.push_back(corner);
  }
  const auto count = static_cast<Index>(outer.size());
  for (Index i = 0; i < count; ++i)
    for (Index k = 0; k < 4; ++k) {
      const Index j = (i + 1) % count, l = (k + 1) % 4;
      soup.add_triangle(4 * i + k, 4 * i + l, 4 * j + l);
      soup.add_triangle(4 * i + k, 4 * j + l, 4 * j + k);
    }
  return to_mesh(soup);
}

// A horn along the x axis whose radius falls from 1 to 1/20, with a spike of one vertex on a face of every
// fourth ring, as long as `spike` radii there.
PolygonSoup horn_with_spikes(double spike, int& spikes) {
  constexpr Index kRings = 60, kRound = 8;
  PolygonSoup soup;
  double x = 0;
  std::vector<double> radii;
  for (Index i = 0; i < kRings; ++i) {
    const double radius = std::pow(0.05, i / (kRings - 1.0));
    radii.push_back(radius);
    for (Index k = 0; k < kRound; ++k) {
      const double turn = 2 * kPi * (k + 0.5 * (i % 2)) / kRound;
      soup.points.push_back({x, radius * std::cos(turn), radius * std::sin(turn)});
    }
    x += 0.7 * radius;
  }
  const auto add = [&](Index a, Index b, Index c, bool has_spike, double length) {
    if (!has_spike) return soup.add_triangle(a, b, c);
    const Vector3 middle = (soup.points[a] + soup.points[b] + soup.points[c]) / 3;
    const Vector3 normal = (soup.points[b] - soup.points[a]).cross(soup.points[c] - soup.points[a]);
    const auto top = static_cast<Index>(soup.points.size());
    soup.points.push_back(middle + length * normal.normalized());
    soup.add_triangle(a, b, top);
    soup.add_triangle(b, c, top);
    soup.add_triangle(c, a, top);
    ++spikes;
  };
  for (Index i = 0; i + 1 < kRings; ++i)
    for (Index k = 0; k < kRound; ++k) {
      const Index next = (k + 1) % kRound, a = kRound * i + k, b = kRound * i + next, c = a + kRound,
                  d = b + kRound;
      const bool here = i % 4 == 2 && k == (3 * i / 4) % kRound;
      if (i % 2 == 0) {
        add(a, b, c, here, spike * radii[i]);
        soup.add_triangle(b, d, c);
      } else {
        soup.add_triangle(a, d, c);
        soup.add_triangle(a, b, d);
      }
    }
  for (const Index ring : {0, kRings - 1}) {
    const auto middle = static_cast<Index>(soup.points.size());
    soup.points.push_back({soup.points[kRound * ring].x(), 0, 0});
    for (Index k = 0; k < kRound; ++k) {
      const Index a = kRound * ring + k, b = kRound * ring + (k + 1) % kRound;
      ring == 0 ? soup.add_triangle(b, a, middle) : soup.add_triangle(a, b, middle);
    }
  }
  return soup;
}

}  // namespace

TEST_CASE("The head of a hammer has both its ends, however short it is") {
  for (const double half_length : {1.6, 1.8, 2.4}) {
    ImplicitSolid hammer;
    hammer.low = Vector3(-1.2, -half_length - 0.2, -1.2);
    hammer.high = Vector3(5, half_length + 0.2, 1.2);
    hammer.value = [=](const Vector3& x) {
      const Vector3 beyond = x.cwiseAbs() - Vector3(1, half_length, 1);
      const double handle = std::max(std::hypot(x.y(), x.z()) - 0.35, std::max(-x.x(), x.x() - 4.5));
      return std::min(beyond.maxCoeff(), handle);
    };
    const ExtractResult result = extract_skeleton(to_mesh(polygonise(hammer, 3000, 0.2)));
    const auto neighbours = adjacency(result.skeleton);
    int left = 0, right = 0;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      if (neighbours[i].size() != 1) continue;
      left += result.skeleton.nodes[i].position.y() < -0.5 * half_length;
      right += result.skeleton.nodes[i].position.y() > 0.5 * half_length;
    }
    INFO("half length " << half_length);
    CHECK(left == 1);
    CHECK(right == 1);
  }
}

TEST_CASE("Equal teeth of a ring are told alike") {
  // The middle of a ring lies in no material, so that the distance from some place in it tells the teeth.
  for (const Index teeth : {3, 5, 8})
    for (const double bore : {0.5, 0.7})
      for (const double angle : {0.0, 1.1}) {
        const DefaultMesh gear = rotated(ring_gear(teeth, bore), Vector3(1, 2, 0.5).normalized(), angle);
        const GraphCounts counts = count_graph(extract_skeleton(gear).skeleton);
        INFO(teeth << " teeth, bore " << bore << ", turned by " << angle);
        CHECK(counts.cycles == 1);
        CHECK(counts.leaves == teeth);
      }
}

TEST_CASE(
    "Fins on a rod have a leaf each and their corners none, and so have boards at the ends of an upright") {
  for (const int fins : {1, 2}) {
    VoxelSolid rod;
    rod.box({0, 0, 0}, {3, 3, 30});
    rod.box({3, 1, 3}, {9, 2, 13});
    if (fins == 2) rod.box({-6, 1, 3}, {0, 2, 13});
    for (const double noise : {0.0, 0.1}) {
      CAPTURE(fins, noise);
      const DefaultMesh mesh = jittered(to_mesh(boundary(rod, 2)), 11, noise);
      CHECK(count_graph(extract_skeleton(mesh).skeleton).leaves == 2 + fins);
    }
  }
  VoxelSolid shelf;
  shelf.box({0, 0, 0}, {1, 16, 31});
  for (int i = 0; i < 4; ++i) shelf.box({1, 0, 10 * i}, {10, 16, 10 * i + 1});
  CHECK(count_graph(extract_skeleton(to_mesh(boundary(shelf, 2))).skeleton).leaves == 4);
}

TEST_CASE("The arc of a mushroom or a tack ends in the middle of its head") {
  for (const double half_height : {0.3, 0.5})
    for (const double stem : {0.1, 0.2}) {
      ImplicitSolid mushroom;
      mushroom.low = Vector3(-1.1, -1.1, -1.7);
      mushroom.high = Vector3(1.1, 1.1, 0.7);
      mushroom.value = [=](const Vector3& x) {
        const double head = Vector3(x.x(), x.y(), x.z() / half_height).norm() - 1;
        return std::min(half_height * head,
                        std::max(std::hypot(x.x(), x.y()) - stem, std::abs(x.z() + 0.75) - 0.75));
      };
      const ExtractResult result = extract_skeleton(to_mesh(polygonise(mushroom, 4000, 0.2)));
      CAPTURE(half_height, stem);
      CHECK(count_graph(result.skeleton).leaves == 2);
      const auto next = adjacency(result.skeleton);
      double nearest = 1e9;
      for (std::size_t n = 0; n < next.size(); ++n)
        if (next[n].size() == 1) nearest = std::min(nearest, result.skeleton.nodes[n].position.norm());
      CHECK(nearest < 0.3 * half_height);
    }
}

TEST_CASE("What is as a told part is told, and blunt parts do as most of their like") {
  // Sizes of parts, alike within a fifth, and what was told of them.
  const std::vector<double> size{1.0, 1.1, 1.25, 3.0, 3.1, 3.2, 9.0};
  const auto alike = [&](std::size_t i, std::size_t j) { return about_equal(size[i], size[j]); };
  const std::vector<bool> told{true, false, false, true, false, false, false};
  const auto is_told = [&](std::size_t i) { return static_cast<bool>(told[i]); };
  const auto answers = [&](bool blunt) {
    return detail::equal_answers(size.size(), is_told, alike, [&](std::size_t) { return blunt; });
  };
  CHECK(answers(false) == std::vector<bool>{true, true, false, true, true, true, false});
  CHECK(answers(true) == std::vector<bool>(size.size(), false));
  const std::vector<bool> most{true, true, false};
  CHECK(detail::equal_answers(
            3, [&](std::size_t i) { return static_cast<bool>(most[i]); },
            [](std::size_t, std::size_t) { return true; },
            [](std::size_t) { return true; }) == std::vector<bool>(3, true));
}

TEST_CASE("The fins of a heat sink have a leaf each, in the middle of their ends, and their corners none") {
  constexpr int kLength = 12, kHeight = 8, kGap = 2;
  for (const int fins : {2, 3, 5})
    for (const int higher : {0, 1}) {  // every second one
      VoxelSolid sink;
      sink.box({0, 0, 0}, {kLength, fins + kGap * (fins - 1), 1});
      for (int i = 0; i < fins; ++i)
        sink.box({0, (1 + kGap) * i, 0}, {kLength, (1 + kGap) * i + 1, 1 + kHeight + i % 2 * higher});
      const ExtractResult result = extract_skeleton(to_mesh(boundary(sink, 2)));
      const auto next = adjacency(result.skeleton);
      CAPTURE(fins, higher);
      CHECK(count_graph(result.skeleton).leaves == fins);
      for (std::size_t i = 0; i < next.size(); ++i) {
        if (next[i].size() != 1) continue;
        const Vector3& end = result.skeleton.nodes[i].position;
        CHECK(std::abs(end.x() - 0.5 * kLength) < 0.1 * kLength);
        CHECK(end.z() > 0.9 * kHeight);
      }
    }
}

TEST_CASE("Most spikes of one vertex on an input get their arcs, and stubs none") {
  int spikes = 0;
  const Solid solid(build_mesh(horn_with_spikes(2.5, spikes)));
  REQUIRE(solid.surface.component_count == 1);
  double far = 0;
  for (const Vector3& x : solid.surface.position) far = std::max(far, solid.model(x).x());
  const auto added = [&](const Solid& on, detail::InnerSurface kind) {
    ArcGraph graph;
    graph.add_hub(on.at({0.3, 0, 0}));
    graph.add_hub(on.at({far - 0.03, 0, 0}));
    line(graph, 0, 1);
    subdivide(graph, 0.002);
    map_to_nearest(graph, on.surface.position);
    detail::InnerGraph inner(on.surface, on.hierarchy, {}, kind);
    std::vector<LimbTip> tips;
    const Index count = complete_limbs(graph, inner, tips, {}, 0.004);
    CHECK(type_of(graph) == GraphType{1, 0});
    CHECK(crossings(graph, on.hierarchy) == 0);
    return count;
  };
  const Index of_input = added(solid, detail::InnerSurface::kInput);
  CHECK(2 * of_input > spikes);
  CHECK(of_input > added(solid, detail::InnerSurface::kCoarser));
  int stubs = 0;
  const Solid stubby(build_mesh(horn_with_spikes(0.4, stubs)));
  REQUIRE(stubs == spikes);
  CHECK(added(stubby, detail::InnerSurface::kInput) == 0);
}

TEST_CASE("A fin of few triangles is a limb of what is thicker") {
  // A triangle upright on a bar, a fifth as thick as the bar: as sharp as the corner of a plate.
  const Solid solid(
      from_triangles({{0, 0, 0},
                      {4, 0, 0},
                      {4, 1, 0},
                      {0, 1, 0},
                      {0, 0, 1},
                      {4, 0, 1},
                      {4, 1, 1},
                      {0, 1, 1},
                      {1.4, 0.4, 1},
                      {2.6, 0.4, 1},
                      {2.6, 0.6, 1},
                      {1.4, 0.6, 1},
                      {2, 0.4, 1.7},
                      {2, 0.6, 1.7}},
                     {{0, 2, 1},  {0, 3, 2},   {0, 1, 5},   {0, 5, 4},    {1, 2, 6},   {1, 6, 5},
                      {2, 3, 7},  {2, 7, 6},   {3, 0, 4},   {3, 4, 7},    {4, 5, 9},   {4, 9, 8},
                      {5, 6, 10}, {5, 10, 9},  {6, 7, 11},  {6, 11, 10},  {7, 4, 8},   {7, 8, 11},
                      {8, 9, 12}, {9, 10, 13}, {9, 13, 12}, {10, 11, 13}, {11, 8, 12}, {11, 12, 13}}));
  REQUIRE(solid.surface.component_count == 1);
  ArcGraph graph;
  graph.add_hub(solid.at({0.2, 0.5, 0.5}));
  graph.add_hub(solid.at({3.8, 0.5, 0.5}));
  line(graph, 0, 1);
  map_to_nearest(graph, solid.surface.position);
  detail::InnerGraph inner(solid.surface, solid.hierarchy, {}, detail::InnerSurface::kInput);
  std::vector<LimbTip> tips;
  REQUIRE(complete_limbs(graph, inner, tips, {}, 0.008) == 1);
  CHECK((solid.model(tips[0].position) - Vector3(2, 0.5, 1.7)).norm() < 0.11);
  CHECK(crossings(graph, solid.hierarchy) == 0);
}

TEST_CASE("What lies flat between the legs of a table of few triangles is no twig") {
  SampleOptions options;
  options.sparse = true;
  options.count = 8;
  options.ratio = 0.7;
  options.section = Section::kRound;
  const ExtractResult result = extract_skeleton(build_mesh(make_sample("table", options)));
  std::vector<int> degree(result.skeleton.nodes.size(), 0);
  for (const auto& [a, b] : result.skeleton.edges) {
    ++degree[a];
    ++degree[b];
  }
  CHECK(std::count(degree.begin(), degree.end(), 1) == 8);
}

TEST_CASE("A limb without an arc gets one, and nothing is added where all have theirs") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  const VertexSlices slices = solid.slices();
  std::vector<LimbTip> tips = tripod_tips(solid);
  ArcGraph whole = tripod_arcs(solid, 0.97);
  CHECK(complete_limbs(whole, solid.surface, solid.hierarchy, tips, {}, 0.01) == 0);
  ArcGraph graph = whole;
  detail::ArcEditor(graph).remove_leaf_arc(2, 0);
  dissolve_through_hubs(graph);
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 1);
  CHECK(leaf_count(graph) == 3);
  CHECK(type_of(graph) == GraphType{1, 0});
  CHECK(arcs_meet_hubs(graph));
  CHECK(map_is_partition(graph));
  CHECK(crossings(graph, solid.hierarchy) == 0);
  double nearest = 10;
  const auto at = graph.incidence();
  for (Index h = 0; h < graph.hub_count(); ++h)
    if (at[h].size() == 1)
      nearest = std::min(nearest, (solid.model(graph.hub_position[h]) - tripod().nodes[3].position).norm());
  CHECK(nearest < 0.5);
}

TEST_CASE("What no arc comes near gets an arc and a tip, whatever other limbs were told") {
  BallGraph horned = tripod();
  horned.nodes.push_back({{0, 0, 1.5}, 0.2});
  horned.nodes.push_back({{0, 1.2, 1.5}, 0.15});
  horned.edges.push_back({4, 5});
  const Solid solid(to_mesh(skin_graph(horned, 2500)));
  ArcGraph graph = tripod_arcs(solid, 0.97);
  std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), {});
  const auto is_horn = [&](const LimbTip& tip) {
    return (solid.model(tip.position) - horned.nodes[5].position).norm() < 0.4;
  };
  tips.erase(std::remove_if(tips.begin(), tips.end(), is_horn), tips.end());
  REQUIRE(tips.size() == 3);
  ArcGraph limbless = graph;
  std::vector<LimbTip> none;
  CHECK(complete_limbs(limbless, solid.surface, solid.hierarchy, none, {}, 0.01) == 1);
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 1);
  CHECK(leaf_count(graph) == 4);
  REQUIRE(tips.size() == 4);
  CHECK(is_horn(tips.back()));
  CHECK(crossings(graph, solid.hierarchy) == 0);
  CHECK(map_is_partition(graph));
}

TEST_CASE("No arc begins in the end of another limb, which would lose its leaf") {
  BallGraph body;
  body.blend = 0.05;
  body.nodes = {{{-3, 0, 0}, 2}, {{3, 0, 0}, 2}, {{3, 0, 1.6}, 0.8}, {{4.2, 0, 1}, 0.45}, {{8, 0, 1}, 0.45}};
  body.edges = {{0, 1}, {1, 2}, {3, 4}};
  const Solid solid(to_mesh(skin_graph(body, 3000)));
  ArcGraph graph;
  for (const Vector3& x : {Vector3(2, 0, 0), Vector3(-3, 0, 0), Vector3(3, 0, 1.2), Vector3(2.2, 0, -1)})
    graph.add_hub(solid.at(x));
  for (const Index end : {1, 2, 3}) line(graph, 0, end);
  map_to_nearest(graph, solid.surface.position);
  std::vector<LimbTip> tips = {LimbTip()};
  LimbTip& bump = tips.front();
  for (Index v = 0; v < solid.surface.vertex_count(); ++v) {
    const Vector3 x = solid.model(solid.surface.position[v]);
    if (x.x() > 4) {  // the horn is the body's
      graph.arc_of_vertex[v] = 0;
      graph.hub_of_vertex[v] = kNone;
    }
    if ((x - Vector3(3, 0, 2.4)).norm() > 0.6) continue;
    bump.cap.push_back(v);
    if (bump.vertex == kNone || x.z() > solid.model(solid.surface.position[bump.vertex]).z()) bump.vertex = v;
  }
  bump.position = bump.target = solid.surface.position[bump.vertex];
  bump.measures.depth = 0.8 / solid.surface.frame.scale;
  bump.measures.half_width = 0.4 / solid.surface.frame.scale;
  bump.measures.slenderness = 2;
  const auto leaf_of_bump = [&] {
    const auto at = graph.incidence();
    return at[2].size() == 1 &&
           detail::leaves_of_tips(graph, detail::ArcLeaves(graph, at), {bump})[0] != detail::kNoLeaf;
  };
  REQUIRE(leaf_of_bump());
  const Index leaves = leaf_count(graph);
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) >= 1);
  CHECK(leaf_of_bump());
  CHECK(leaf_count(graph) > leaves);
}

TEST_CASE("A leaning horn that no arc comes near is reached to its tip") {
  BallGraph leaning;
  leaning.blend = 0.05;
  leaning.nodes = {{{0, 0, -3}, 0.5}, {{0, 0, 3}, 0.5}, {{0, 0, 0}, 0.12}, {{0, 1.5, 1.5}, 0.09}};
  leaning.edges = {{0, 1}, {2, 3}};
  const Solid solid(to_mesh(skin_graph(leaning, 4000)));
  const auto of_horn = [&](const LimbTip& tip) {
    return (solid.model(tip.position) - leaning.nodes[3].position).norm() < 0.3;
  };
  std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), {});
  tips.erase(std::remove_if(tips.begin(), tips.end(), of_horn), tips.end());
  REQUIRE(tips.size() == 2);
  for (const Index count : {300, 700}) {
    ArcGraph graph;
    graph.add_hub(solid.at({0, 0, -3}));
    graph.add_hub(solid.at({0, 0, 3}));
    line(graph, 0, 1, count);
    map_to_nearest(graph, solid.surface.position);
    std::vector<LimbTip> found = tips;
    CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, found, {}, 0.008) == 1);
    CHECK(of_horn(found.back()));
    CHECK((solid.model(graph.hub_position.back()) - leaning.nodes[3].position).norm() < 0.3);
  }
}

TEST_CASE("A limb's tip gets an arc where another one has led through most of the limb") {
  // A forked end: the arc of one prong is that of the limb as well.
  BallGraph fork;
  fork.blend = 0.05;
  fork.nodes = {{{-4, 0, 0}, 0.3}, {{2, 0, 0}, 0.3}, {{2.5, 0.35, 0}, 0.25}, {{2.5, -0.35, 0}, 0.25}};
  fork.edges = {{0, 1}, {1, 2}, {1, 3}};
  const Solid solid(to_mesh(skin_graph(fork, 2000)));
  ArcGraph graph;
  for (const Index i : {0, 1, 2}) graph.add_hub(solid.at(fork.nodes[i].position));
  line(graph, 0, 1);
  line(graph, 1, 2);
  map_to_nearest(graph, solid.surface.position);
  LimbTip tip;
  const Vector3 end = solid.at(fork.nodes[3].position + Vector3(0.2, -0.15, 0));
  for (Index v = 0; v < solid.surface.vertex_count(); ++v)
    if (tip.vertex == kNone ||
        (solid.surface.position[v] - end).norm() < (solid.surface.position[tip.vertex] - end).norm())
      tip.vertex = v;
  tip.position = tip.target = solid.surface.position[tip.vertex];
  tip.cap = {tip.vertex};
  const double unit = solid.surface.frame.scale;
  tip.measures.depth = 6 / unit;  // of the whole limb
  tip.measures.half_width = 0.3 / unit;
  tip.measures.slenderness = 20;
  std::vector<LimbTip> tips = {tip};
  LimbOptions tips_alone;
  tips_alone.smallest = 1;
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, tips_alone, 0.01) == 1);
}

TEST_CASE("Vertices without faces are no limb's") {
  DefaultMesh mesh = to_mesh(skin_graph(tripod(), 1200));
  mesh.add_vertex({9, 9, 9});
  const Solid solid(mesh);
  REQUIRE(solid.surface.component.back() == kNone);
  ArcGraph graph = tripod_arcs(solid, 0.97);
  graph.arc_of_vertex.back() = graph.hub_of_vertex.back() = kNone;
  std::vector<LimbTip> tips = tripod_tips(solid);
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 0);
}

TEST_CASE("No place is completed twice") {
  for (const std::string name : {"plate", "quadruped", "octoped"}) {
    const Solid solid(sample(name, 3200));
    const auto middle = solid.hierarchy.first_hit(solid.surface.position[0] - 1e-6 * solid.surface.normal[0],
                                                  -solid.surface.normal[0]);
    REQUIRE(middle);
    ArcGraph graph;
    graph.add_hub(solid.surface.position[0] - 0.4 * middle->distance * solid.surface.normal[0]);
    graph.add_hub(solid.surface.position[0] - 0.6 * middle->distance * solid.surface.normal[0]);
    line(graph, 0, 1);
    map_to_nearest(graph, solid.surface.position);
    LimbOptions lenient;
    lenient.slenderness = 0.2;
    std::vector<LimbTip> tips = find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), lenient);
    complete_limbs(graph, solid.surface, solid.hierarchy, tips, lenient, 0.01);
    const auto at = graph.incidence();
    std::vector<Vector3> ends;
    for (Index h = 2; h < graph.hub_count(); ++h)
      if (at[h].size() == 1) ends.push_back(graph.hub_position[h]);
    INFO(name << ", " << ends.size() << " ends");
    CHECK_FALSE(ends.empty());
    for (std::size_t i = 0; i < ends.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) CHECK((ends[i] - ends[j]).norm() > 1e-3);
  }
}

TEST_CASE("Fins on a plain body get an arc each, to their middle") {
  for (const std::vector<double>& angles : {std::vector<double>{0.7}, {0.0, 2.0, 4.0}}) {
    const Solid solid(to_mesh(polygonise(finned(angles), 5000, 0.12)));
    ArcGraph graph = straight_axis(solid, -3, 3);
    std::vector<LimbTip> tips;
    const auto count = static_cast<Index>(angles.size());
    CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == count);
    CHECK(leaf_count(graph) == 2 + count);
    CHECK(crossings(graph, solid.hierarchy) == 0);
    CHECK(map_is_partition(graph));
    const auto at = graph.incidence();
    for (const double angle : angles) {
      double nearest = 10;
      for (Index h = 2; h < graph.hub_count(); ++h)
        if (at[h].size() == 1)
          nearest = std::min(nearest, (solid.model(graph.hub_position[h]) -
                                       1.7 * Vector3(0, std::cos(angle), std::sin(angle)))
                                          .norm());
      CHECK(nearest < 0.3);
    }
  }
}

TEST_CASE("Plates get an arc each where their roots are rounded, to the middles of their ends") {
  // Three that meet in a line along x, with fillets as wide as they are thick.
  const std::vector<Vector3> ends{Vector3(0, 3, 0), Vector3(0, -3, 0), Vector3(0, 0, 3)};
  ImplicitSolid tee;
  tee.low = Vector3(-2.1, -3.3, -0.4);
  tee.high = Vector3(2.1, 3.3, 3.3);
  tee.value = [](const Vector3& x) {
    constexpr double kThick = 0.4, kFillet = 0.4;
    const double flat = rounded_box_distance(x, {1.8, 3, 0.5 * kThick}, 0.1);
    const double web = rounded_box_distance(x - Vector3(0, 0, 1.5), {1.8, 0.5 * kThick, 1.5}, 0.1);
    const double near = std::max(kFillet - std::abs(flat - web), 0.0);
    return std::min(flat, web) - near * near / (4 * kFillet);
  };
  const Solid solid(to_mesh(polygonise(tee, 5000, 0.2)));
  ArcGraph graph = straight_axis(solid, -1.5, 1.5);
  std::vector<LimbTip> tips;
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 3);
  REQUIRE(tips.size() == 3);
  for (const Vector3& end : ends)
    CHECK(std::any_of(tips.begin(), tips.end(),
                      [&](const LimbTip& tip) { return (solid.model(tip.target) - end).norm() < 0.5; }));
  // And none is added where they have one.
  CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 0);
}

TEST_CASE("The foot of a goblet has a rim, and no end beyond its middle") {
  ImplicitSolid goblet;
  goblet.low = Vector3(-0.6, -2.1, -2.1);
  goblet.high = Vector3(13.6, 2.1, 2.1);
  goblet.value = [](const Vector3& x) {
    const double off_axis = std::hypot(x.y(), x.z()), beyond = x.x() - std::clamp(x.x(), 0.0, 13.0);
    const double stem = std::hypot(beyond, off_axis) - 0.35;
    const double foot = std::hypot(std::max(0.0, off_axis - 1.6), x.x()) - 0.15;
    return std::min(stem, foot);
  };
  const Solid solid(to_mesh(polygonise(goblet, 5000, 0.15)));
  for (const double end : {0.0, 0.2, 0.4}) {
    ArcGraph graph = straight_axis(solid, end, 13);
    std::vector<LimbTip> tips;
    CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 0);
  }
}

TEST_CASE("Corners and rims are no bumps") {
  for (const Vector3& half : {Vector3(1, 1, 1), Vector3(2, 1, 1), Vector3(3, 2, 0.2)}) {
    INFO(half.transpose());
    ImplicitSolid block;
    block.low = -1.1 * half;
    block.high = 1.1 * half;
    block.value = [&](const Vector3& x) { return (x.cwiseAbs() - half).maxCoeff(); };
    const Solid solid(to_mesh(polygonise(block, 2500, 0.2)));
    ArcGraph graph = straight_axis(solid, -0.5 * half.x(), 0.5 * half.x());
    std::vector<LimbTip> tips;
    CHECK(complete_limbs(graph, solid.surface, solid.hierarchy, tips, {}, 0.01) == 0);
  }
}
