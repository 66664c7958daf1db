// What the skeleton does not represent, and limbs that are found on sparse surfaces.
#include "mspskel/limbs/coverage.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "limbs/armchair.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/detail/slender_parts.h"
#include "mspskel/samples/shapes.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"
#include "support/meshes.h"
#include "support/pipes.h"
#include "support/solids.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

double length_of(const CurveSkeleton& skeleton, const std::vector<Index>& nodes) {
  double length = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    length += (skeleton.nodes[nodes[i]].position - skeleton.nodes[nodes[i - 1]].position).norm();
  return length;
}

// Without its longest branch that ends in a leaf and begins at a joint.
CurveSkeleton without_a_limb(const CurveSkeleton& skeleton, Vector3& tip) {
  const auto next = adjacency(skeleton);
  std::vector<Index> longest;
  for (const Branch& branch : branches(skeleton)) {
    std::vector<Index> nodes = branch.nodes;
    if (next[nodes.front()].size() != 1) std::reverse(nodes.begin(), nodes.end());
    if (next[nodes.front()].size() != 1 || next[nodes.back()].size() < 3) continue;
    if (length_of(skeleton, nodes) > length_of(skeleton, longest)) longest = nodes;
  }
  REQUIRE(longest.size() > 1);
  tip = skeleton.nodes[longest.front()].position;
  longest.pop_back();
  std::vector<Index> moved(skeleton.nodes.size(), 0);
  for (const Index n : longest) moved[n] = kNone;
  CurveSkeleton rest;
  for (std::size_t n = 0; n < moved.size(); ++n) {
    if (moved[n] == kNone) continue;
    moved[n] = static_cast<Index>(rest.nodes.size());
    rest.nodes.push_back(skeleton.nodes[n]);
  }
  for (const auto& [a, b] : skeleton.edges)
    if (moved[a] != kNone && moved[b] != kNone) rest.edges.push_back({moved[a], moved[b]});
  return rest;
}

std::vector<UncoveredPart> uncovered(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                                     int threads = 0) {
  return find_uncovered_parts(surface, BoundingVolumeHierarchy(surface), skeleton, {}, {threads, {}});
}

}  // namespace

TEST_CASE("Nothing is uncovered where every limb has its arc, and a limb that loses it is, at its tip") {
  const DefaultMesh mesh = to_mesh(skin_graph(tripod(), 3000));
  const ExtractResult result = extract_skeleton(mesh);
  CHECK(uncovered(result.surface, result.skeleton).empty());
  Vector3 tip;
  const CurveSkeleton rest = without_a_limb(result.skeleton, tip);
  const std::vector<UncoveredPart> parts = uncovered(result.surface, rest);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].widths >= kMissedWidths);
  CHECK((parts[0].position - tip).norm() < parts[0].depth / 4);
  CHECK(uncovered(result.surface, rest, 1)[0].vertex == parts[0].vertex);
  // It turns along.
  const DefaultMesh turned = rotated(mesh, {1, 2, 3}, 1.1);
  const ExtractResult other = extract_skeleton(turned);
  CHECK(uncovered(other.surface, other.skeleton).empty());
}

TEST_CASE("What has no arc is told, also where it is most of the surface") {
  // A lamp with an arc in its base alone, from the middle to the rim.
  const SurfaceSnapshot surface = make_snapshot(united(
      {{{0, 0, 0}, {0, 0, 0.25}, 0.9}, {{0, 0, 0.1}, {0, 0, 6}, 0.12}, {{0, 0, 5.5}, {0, 0, 7}, 1.1}}, 0.12));
  CurveSkeleton skeleton;
  skeleton.nodes.resize(5);
  for (std::size_t i = 0; i < 5; ++i) skeleton.nodes[i].position = {0.2 * static_cast<double>(i), 0, 0.125};
  skeleton.node_of_vertex.assign(surface.position.size(), 0);
  skeleton.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  const std::vector<UncoveredPart> parts = uncovered(surface, skeleton);
  REQUIRE(parts.size() == 1);
  CHECK_FALSE(parts[0].is_plate);
  CHECK(parts[0].position.z() > 6.9);
}

TEST_CASE("Blocks and balls and plates have nothing that people would call a limb without an arc") {
  for (const char* name : {"sphere", "prism", "plate", "cup", "vase", "table", "box"}) {
    const ExtractResult result = extract_skeleton(sample(name, 4000));
    CAPTURE(name);
    CHECK(uncovered(result.surface, result.skeleton).empty());
  }
}

TEST_CASE("Plates that no arc leads into are told, however wide they are, and no others") {
  using namespace armchair;
  for (const int fine : {1, 2}) {
    CAPTURE(fine);
    const SurfaceSnapshot surface = make_snapshot(to_mesh(boundary(cells(), fine)));
    // Of the legs and across the seat.
    CurveSkeleton skeleton;
    const auto add = [&](const Vector3& from, const Vector3& to) {
      for (int i = 0; i <= 20; ++i) {
        skeleton.nodes.emplace_back();
        skeleton.nodes.back().position = from + i / 20.0 * (to - from);
        const auto n = static_cast<Index>(skeleton.nodes.size());
        if (i > 0) skeleton.edges.push_back({n - 2, n - 1});
      }
    };
    const Vector3 middle(0.5 * kWidth, 0.5 * kWidth, 0.5);
    for (const double x : {0.5, kWidth - 0.5})
      for (const double y : {0.5, kWidth - 0.5}) {
        add({x, y, 0.5 - kLeg}, {x, y, 0.5});
        add({x, y, 0.5}, middle);
      }
    const auto plates = [&] {
      std::size_t backs = 0, arms = 0;
      for (const UncoveredPart& part : uncovered(surface, skeleton)) {
        CHECK(part.is_plate);
        ++(part.position.y() > kWidth - 1.5 ? backs : arms);
        CHECK(part.position.z() > kArm);
        CHECK(part.depth > 0.5 * kArm);
      }
      return std::pair(backs, arms);
    };
    CHECK(plates() == std::pair<std::size_t, std::size_t>(1, 2));
    add({0.5 * kWidth, kWidth - 0.5, 0.5}, {0.5 * kWidth, kWidth - 0.5, kBack + 0.5});
    CHECK(plates() == std::pair<std::size_t, std::size_t>(0, 2));
    for (const double x : {0.5, kWidth - 0.5}) add({x, 0.5 * kWidth, 0.5}, {x, 0.3 * kWidth, kArm + 0.5});
    CHECK(plates() == std::pair<std::size_t, std::size_t>(0, 0));
  }
}

TEST_CASE("Depth below the least one is none") {
  const ExtractResult result = extract_skeleton(to_mesh(skin_graph(tripod(), 3000)));
  Vector3 tip;
  const CurveSkeleton rest = without_a_limb(result.skeleton, tip);
  CoverageOptions deep;
  deep.smallest = 1;
  CHECK(find_uncovered_parts(result.surface, BoundingVolumeHierarchy(result.surface), rest, deep).empty());
}

TEST_CASE("A spike without area is no part, and no number is infinite") {
  PolygonSoup soup = to_soup(tube(0.3, 1.0, 12, 20));
  Eigen::AlignedBox3d box;
  for (const Vector3& p : soup.points) box.extend(p);
  // Beyond its middle the tube has no width.
  for (Vector3& p : soup.points)
    if (p.z() > box.center().z()) p.x() = p.y() = 0;
  const ExtractResult result = extract_skeleton(to_mesh(soup));
  CurveSkeleton half;  // a ball at the other end
  half.nodes.emplace_back();
  half.nodes[0].position = Vector3(0, 0, box.min().z() + 0.2);
  for (const CurveSkeleton& skeleton : {result.skeleton, half})
    for (const UncoveredPart& part : uncovered(result.surface, skeleton)) {
      CHECK(std::isfinite(part.widths));
      CHECK(std::isfinite(part.depth));
    }
}

TEST_CASE("What the balls of another component reach is not covered by them") {
  // A needle inside a ball that is turned the same way: the ball's own ball covers all of it.
  PolygonSoup both = to_soup(sphere(800)), needle = to_soup(tube(0.05, 1.2, 12, 40));
  Eigen::AlignedBox3d box;
  for (const Vector3& p : needle.points) box.extend(p);
  for (Vector3& p : needle.points) p -= box.center();
  append(both, needle);
  const SurfaceSnapshot surface = make_snapshot(to_mesh(both));
  CurveSkeleton skeleton;
  skeleton.nodes.resize(3);
  skeleton.nodes[1].position = Vector3(0, 0, -0.5);  // at one end of the needle
  skeleton.nodes[2].position = Vector3(0, 0, -0.45);
  skeleton.edges = {{1, 2}};
  skeleton.node_of_vertex.assign(both.points.size(), 1);
  for (Index v = 0; v < surface.vertex_count(); ++v)
    if (surface.component[v] == 0) skeleton.node_of_vertex[v] = 0;
  const std::vector<UncoveredPart> parts = uncovered(surface, skeleton);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].position.z() == Approx(0.6).epsilon(0.05));
}

TEST_CASE("Parts beyond a level are measured by their area and by their mouth") {
  const double radius = 1, length = 6;
  const Solid solid(to_mesh(make_capsule(radius, length, {0.15, 0.0, 1})));
  std::vector<double> height;
  std::vector<Index> all;
  for (const Vector3& x : solid.surface.position) {
    height.push_back(x.z());
    all.push_back(static_cast<Index>(all.size()));
  }
  const double scale = solid.surface.frame.scale;
  const auto parts = detail::slender_parts(solid.surface, height, all, [&](Index) { return 1.5 / scale; });
  REQUIRE(parts.size() == 1);
  // No more than half of it: the cap and half of the tube.
  const detail::PartLevel& level = parts[0].narrowest;
  CHECK(scale * level.depth == Approx(4).epsilon(0.1));
  CHECK(scale * level.mouth == Approx(2 * kPi).epsilon(0.02));
  CHECK(level.depth_over_mouth() == Approx(4).epsilon(0.1));
  CHECK(level.bulge() == Approx(8).epsilon(0.1));
}

TEST_CASE("The bumps of a rough ball are no parts") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    const DefaultMesh rough =
        moved(sphere(2562), [&](const Vector3& x) { return Vector3(x * (0.9 + 0.2 * random.uniform())); });
    const CurveSkeleton skeleton = extract_skeleton(rough).skeleton;
    const auto next = adjacency(skeleton);
    CHECK(std::count_if(next.begin(), next.end(), [](const auto& n) { return n.size() == 1; }) == 2);
  }
}
