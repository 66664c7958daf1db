// Samples whose skeletons are known: the skeletons are right for their meshes.
#include <catch2/catch.hpp>

#include "mspskel/base/error.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/self_intersection.h"
#include "mspskel/samples/blocks.h"
#include "mspskel/samples/samples.h"
#include "mspskel/skeleton/check_skeleton.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {
SkeletonChecks check_truth(const std::string& name, const SampleOptions& options = {}) {
  const SurfaceSnapshot s = make_snapshot(to_mesh(make_sample(name, options)));
  return check_skeleton(s, BoundingVolumeHierarchy(s), sample_truth(name, options));
}
}  // namespace

TEST_CASE("a sample's true skeleton lies in it and has its pieces, handles and ends") {
  for (const SampleInfo& info : list_samples()) {
    if (!info.has_truth) continue;
    INFO(info.name);
    SampleOptions options;  // thin limbs need vertices round their tips
    options.resolution = std::clamp<Index>(6000, info.least_resolution, info.resolution);
    const SkeletonChecks checks = check_truth(info.name, options);
    CHECK(checks.topology);
    CHECK(checks.contained);
    if (info.leaves != kNone) CHECK(checks.leaves == info.leaves);
  }
}

TEST_CASE("count and section give a true skeleton of their own") {
  for (const char* name : {"cross", "cube-rods", "comb", "ladder", "lattice", "table", "vase", "airway"})
    for (const Section section : {Section::kSquare, Section::kRound}) {
      const SampleInfo info = describe_sample(name);
      if (!info.has_sections && section == Section::kRound) continue;
      SampleOptions options;
      if (info.has_sections) options.section = section;
      options.count = info.least_count == info.count ? info.count + 1 : info.least_count;
      options.resolution = describe_sample(name, options).least_resolution;
      INFO(name << " " << options.count << (section == Section::kRound ? " round" : " square"));
      const SkeletonChecks checks = check_truth(name, options);
      CHECK(checks.topology);
      CHECK(checks.contained);
      CHECK(checks.leaves == describe_sample(name, options).leaves);
    }
}

TEST_CASE("an end of the truth is a quarter of the half width below the surface, on the axis") {
  SampleOptions options;
  options.sides = {2, 3, 12};
  const CurveSkeleton box = sample_truth("box", options);
  const double end = 6 - 0.25 * std::sqrt(6.0) / 2;
  REQUIRE(box.nodes.size() == 2);
  for (const SkeletonNode& node : box.nodes) {
    CHECK(std::abs(node.position.z()) == Approx(end));
    CHECK(node.position.head<2>().norm() == 0);
  }
  const CurveSkeleton hammer = sample_truth("hammer");
  double lowest = 0;
  for (const SkeletonNode& node : hammer.nodes) lowest = std::min(lowest, node.position.z());
  CHECK(lowest == Approx(-9 + 0.25 * 0.4));
  const CurveSkeleton teapot = sample_truth("teapot");
  double highest = 0;
  for (const SkeletonNode& node : teapot.nodes) highest = std::max(highest, node.position.y());
  CHECK(highest == Approx(2 + 0.75 * 0.22));
}

TEST_CASE("long triangles keep the topology, the solid and its sharp edges") {
  for (const char* name : {"hammer", "ladder", "tee", "vase"}) {
    INFO(name);
    SampleOptions options;
    options.resolution = describe_sample(name).least_resolution;
    const DefaultMesh dense = to_mesh(make_sample(name, options));
    options.sparse = true;
    const DefaultMesh mesh = to_mesh(make_sample(name, options));
    const SurfaceSnapshot s = make_snapshot(mesh);
    CHECK(s.vertex_count() < static_cast<Index>(dense.n_vertices()) * 3 / 4);
    CHECK(signed_volume(mesh) == Approx(signed_volume(dense)).epsilon(0.01));
    CHECK(count_self_intersections(s, BoundingVolumeHierarchy(s), 1) == 0);
  }
}

TEST_CASE("a tree's edges follow the width of its limbs") {
  SampleOptions options;
  options.count = 30;
  options.resolution = 8000;
  const PolygonSoup soup = make_sample("tree", options);
  double longest = 0, shortest = 1e300;
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const double length = (soup.points[soup.corners[c]] - soup.points[soup.corners[c + 1]]).norm();
    longest = std::max(longest, length);
    shortest = std::min(shortest, length);
  }
  CHECK(longest > 20 * shortest);
  const CurveSkeleton truth = sample_truth("tree", options);
  double widest = 0, thinnest = 1e300;
  for (const SkeletonNode& node : truth.nodes) {
    widest = std::max(widest, node.radius);
    thinnest = std::min(thinnest, node.radius);
  }
  CHECK(widest / thinnest == Approx(20));
  CHECK(count_graph(truth).leaves == 31);
}

TEST_CASE("where no skeleton is defined the error says so") {
  CHECK_THROWS_WITH(sample_truth("sphere"), Catch::Contains("no defined skeleton"));
  SampleOptions options;
  options.sides = {3, 3, 3};
  CHECK_THROWS_WITH(sample_truth("box", options), Catch::Contains("--sides"));
  CHECK_NOTHROW(make_sample("box", options));
  CHECK_THROWS_AS(make_sample("torus", options), UsageError);
  options = {};
  options.section = Section::kRound;
  CHECK_THROWS_AS(make_sample("torus", options), UsageError);
}

TEST_CASE("boxes keep their volume and their sharp edges at any resolution") {
  for (const Index vertices : {8, 100, 3000}) {
    INFO(vertices);
    const std::vector<Block> blocks{{{0, 0, 0}, {4, 1, 1}}, {{1, 0, 1}, {2, 1, 5}}};
    const DefaultMesh mesh = to_mesh(make_boxes(blocks, vertices, 0.2, 1));
    CHECK(signed_volume(mesh) == Approx(8));
  }
  CHECK_THROWS_AS(bar({0, 0, 0}, {1, 1, 0}, 0.1, false), UsageError);
  CHECK_THROWS_AS(make_boxes({bar({0, 0, 0}, {1, 0, 0}, 0.1, true)}, 100, 0, 1), UsageError);
}
