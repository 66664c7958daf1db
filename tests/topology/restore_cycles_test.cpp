// Arcs on the wrong side of a handle are led round it, and nothing else moves.
#include "mspskel/graph/restore_cycles.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// Two square rings that share a side.
VoxelSolid two_rings() {
  VoxelSolid solid;
  for (int i = 0; i < 2; ++i)
    solid.add(VoxelSolid::path(
        {{0, 4 * i, 0}, {4, 4 * i, 0}, {4, 4 * i + 4, 0}, {0, 4 * i + 4, 0}, {0, 4 * i, 0}}));
  return solid;
}

Arc arc(const SurfaceSnapshot& s, Index from, Index to, const std::vector<Vector3>& cells) {
  Arc result;
  result.hub = {from, to};
  for (const Vector3& c : cells) result.points.push_back(s.frame.to_normalised(c + Vector3(0.5, 0.5, 0.5)));
  return result;
}

bool inside(const Arc& a, const BoundingVolumeHierarchy& solid) {
  for (std::size_t i = 1; i < a.points.size(); ++i)
    if (solid.segment_crosses(a.points[i - 1], a.points[i])) return false;
  return true;
}

}  // namespace

TEST_CASE("a cycle that goes round nothing is led round the handle that is missing") {
  const SurfaceSnapshot s = snapshot_of(two_rings(), 2);
  const BoundingVolumeHierarchy solid(s);
  const VolumeCocycles cocycles = compute_volume_cocycles(s);
  REQUIRE(cocycles.rank == 2);
  ArcGraph graph;
  graph.add_hub(s.frame.to_normalised({0.5, 4.5, 0.5}));
  graph.add_hub(s.frame.to_normalised({4.5, 4.5, 0.5}));
  // Both outer arcs take the first ring's far side.
  graph.arcs = {arc(s, 0, 1, {{0, 4, 0}, {4, 4, 0}}),
                arc(s, 0, 1, {{0, 4, 0}, {0, 0, 0}, {4, 0, 0}, {4, 4, 0}}),
                arc(s, 0, 1, {{0, 4, 0}, {0, 0.1, 0.1}, {4, 0.1, 0}, {4, 4, 0}})};
  for (const Arc& a : graph.arcs) REQUIRE(inside(a, solid));
  const ArcGraph before = graph;
  const CycleRestoration done = restore_cycles(graph, s, solid, cocycles, {false, false, true});
  CHECK(done.cycles == 2);
  CHECK(done.rank == 2);
  CHECK(done.restored == 1);
  CHECK(graph.arcs[0].points == before.arcs[0].points);
  CHECK(graph.arcs[1].points == before.arcs[1].points);
  CHECK(inside(graph.arcs[2], solid));
  CHECK(graph.arcs[2].points.front() == before.arcs[2].points.front());
  CHECK(graph.arcs[2].points.back() == before.arcs[2].points.back());
  const CycleRestoration again = restore_cycles(graph, s, solid, cocycles);
  CHECK(again.rank == 2);
  CHECK(again.restored == 0);
}

TEST_CASE("a loop that shrank to nothing goes round the tunnel, with linking numbers too") {
  const SurfaceSnapshot s = snapshot_of(knotted_tunnel(2, 3), 1);
  const BoundingVolumeHierarchy solid(s);
  CocycleOptions options;
  options.use_discs = options.use_holed_regions = GENERATE(true, false);
  const VolumeCocycles cocycles = compute_volume_cocycles(s, {}, options);
  ArcGraph graph;
  graph.add_hub(s.frame.to_normalised({9.5, 9.5, 3.5}));
  graph.arcs = {arc(s, 0, 0, {{9, 9, 3}, {9, 8, 3}, {8, 8, 3}, {9, 9, 3}})};
  const CycleRestoration done = restore_cycles(graph, s, solid, cocycles);
  CHECK(done.rank == 1);
  CHECK(done.restored == 1);
  CHECK(inside(graph.arcs[0], solid));
}

TEST_CASE("labels of segments add up to zero round a null loop and to one round a handle") {
  VoxelSolid ring;
  ring.add(VoxelSolid::path({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}}));
  const SurfaceSnapshot s = snapshot_of(ring, 2);
  for (const bool slices : {true, false}) {
    CocycleOptions options;
    options.use_discs = options.use_holed_regions = slices;
    const CrossingLabels label(compute_volume_cocycles(s, {}, options));
    const Arc round = arc(s, 0, 0, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}});
    const Arc null = arc(s, 0, 0, {{0, 0, 0}, {4, 0, 0}, {4, 0.2, 0}, {0, 0.2, 0}, {0, 0, 0}});
    CHECK(std::abs(detail::label_along(label, round.points)[0]) == 1);
    CHECK(detail::label_along(label, null.points).is_zero());
  }
}
