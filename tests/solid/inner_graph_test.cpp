// Ways inside where few triangles stand round a limb.
#include "mspskel/solid/detail/inner_graph.h"

#include <catch2/catch.hpp>

#include "mspskel/base/error.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/repair/mend_soup.h"
#include "mspskel/samples/samples.h"
#include "support/questions.h"
#include "support/soups.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// A bar and a chain of two cubes that hangs on it by an edge, so that bridges of three edges join them.
SurfaceSnapshot bar_with_chain() {
  VoxelSolid solid;
  for (int x = 0; x < 9; ++x)
    for (const auto& [y, z] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) solid.cells.insert({x, y, z});
  for (const Cell& c : {Cell{4, 2, 2}, {5, 3, 2}}) solid.cells.insert(c);
  return make_snapshot(build_mesh(mend_soup(boundary(solid)).soup));
}

}  // namespace

TEST_CASE("three edges that close up and are no face are a gate, and a path leads through it") {
  const SurfaceSnapshot surface = bar_with_chain();
  REQUIRE(surface.component_count == 1);
  CHECK(detail::find_gates(surface).size() >= 2);
  const BoundingVolumeHierarchy solid(surface);
  const Vector3 end = surface.frame.to_normalised({5.5, 3.5, 2.5}),
                bar = surface.frame.to_normalised({4.5, 1, 1});
  detail::InnerPaths paths(surface, solid, {}, detail::InnerSurface::kInput);
  paths.prepare();
  std::vector<Vector3> way;
  REQUIRE(paths.path(end, bar, way));
  way.insert(way.begin(), end);
  way.push_back(bar);
  for (std::size_t i = 1; i < way.size(); ++i) CHECK_FALSE(solid.segment_crosses(way[i - 1], way[i]));
}

TEST_CASE("a search among the ways of a class asks whether to stop") {
  const SurfaceSnapshot surface = bar_with_chain();
  const BoundingVolumeHierarchy solid(surface);
  bool goes_on = true;
  Execution execution;
  execution.progress = [&](const char*, double) { return goes_on; };
  detail::InnerPaths paths(surface, solid, execution);
  paths.prepare();
  const Vector3 a = surface.frame.to_normalised({0.5, 1, 1}), b = surface.frame.to_normalised({8.5, 1, 1});
  std::vector<Vector3> way;
  CHECK(paths.path_of_class(a, b, CrossingLabels(), CocycleLabel(), way));
  goes_on = false;
  CHECK_THROWS_AS(paths.path_of_class(a, b, CrossingLabels(), CocycleLabel(), way), Cancelled);
}

TEST_CASE("a long search, and one that sets landmarks, asks whether to stop") {
  SampleOptions options;
  options.resolution = 8000;
  const SurfaceSnapshot surface = make_snapshot(build_mesh(make_sample("torus", options)));
  const BoundingVolumeHierarchy solid(surface);
  ProgressCallback progress;
  Execution execution;
  execution.threads = 1;
  execution.progress = [&](const char* stage, double share) { return !progress || progress(stage, share); };
  const auto questions = [&](int searches) {
    return questions_of([&](const ProgressCallback& asked) {
      progress = {};
      detail::InnerGraph paths(surface, solid, execution);
      paths.prepare();
      progress = asked;
      Index far = 0;
      for (Index v = 0; v < surface.vertex_count(); ++v)
        if ((paths.point(v) - paths.point(0)).norm() > (paths.point(far) - paths.point(0)).norm()) far = v;
      std::vector<Vector3> way;
      for (int i = 0; i < searches; ++i)
        paths.path(paths.point(i % 2 == 0 ? 0 : far), paths.point(i % 2 == 0 ? far : 0), way);
    });
  };
  // The first one prepares, eight of the whole graph set the landmarks.
  CHECK(questions(8) > questions(1) + 40);
}

TEST_CASE("the surface of a voxel block of many faces has no gates") {
  VoxelSolid solid;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y) solid.cells.insert({x, y, 0});
  CHECK(detail::find_gates(make_snapshot(build_mesh(boundary(solid)))).empty());
}

// Chords from the rim of a disc all have their middles in the middle of the disc.
TEST_CASE("the way from a leg to the middle of a round plate is not by the rim") {
  SampleOptions options;
  options.count = 4;
  options.ratio = 0.6;
  options.section = Section::kRound;
  const CurveSkeleton truth = sample_truth("table", options);
  const SurfaceSnapshot surface = make_snapshot(build_mesh(make_sample("table", options)));
  const BoundingVolumeHierarchy solid(surface);
  detail::InnerPaths paths(surface, solid);
  paths.prepare();
  // The middle of the plate is the first node; from it arcs lead to the tops of the legs, and on down.
  const auto [top, foot] = truth.edges.back();
  const Vector3 middle = truth.nodes[0].position;
  const Vector3 in_leg = 0.5 * (truth.nodes[top].position + truth.nodes[foot].position);
  REQUIRE((truth.nodes[top].position - middle).norm() > 1);
  std::vector<Vector3> way;
  REQUIRE(paths.path(surface.frame.to_normalised(in_leg), surface.frame.to_normalised(middle), way));
  way.insert(way.begin(), surface.frame.to_normalised(in_leg));
  way.push_back(surface.frame.to_normalised(middle));
  double length = 0;
  for (std::size_t i = 1; i < way.size(); ++i) length += surface.frame.scale * (way[i] - way[i - 1]).norm();
  const double shortest =
      (truth.nodes[top].position - middle).norm() + (truth.nodes[top].position - in_leg).norm();
  CHECK(length < 1.2 * shortest);
}

// Every step in a thin bar is dear, so from its root all of the block is nearer than its end.
TEST_CASE(
    "a search into a thin bar comes by few vertices of the block that it leaves, whichever way it goes") {
  VoxelSolid solid;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = -20; z < 12; ++z) solid.cells.insert({x, y, z});
  for (int z = 12; z < 17; ++z) solid.cells.insert({6, 6, z});
  const SurfaceSnapshot surface = make_snapshot(build_mesh(boundary(solid)));
  const BoundingVolumeHierarchy faces(surface);
  const Vector3 root = surface.frame.to_normalised({6.1, 6.2, 10.3}),
                end = surface.frame.to_normalised({6.5, 6.5, 16.5});
  for (const bool outward : {false, true}) {
    detail::InnerPaths paths(surface, faces);
    paths.prepare();
    std::vector<Vector3> way;
    REQUIRE(paths.path(outward ? root : end, outward ? end : root, way));
    CHECK(paths.came_by() < static_cast<std::size_t>(surface.vertex_count()) / 4);
  }
}
