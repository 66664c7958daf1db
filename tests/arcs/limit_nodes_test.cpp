// The node budget keeps topology, ends and containment.
#include "mspskel/arcs/limit_nodes.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "support/meshes.h"

using namespace mspskel;

namespace {

ArcGraph straight_line(const Vector3& from, const Vector3& to, int pieces) {
  ArcGraph graph;
  graph.add_hub(from);
  graph.add_hub(to);
  Arc arc;
  arc.hub = {0, 1};
  for (int i = 0; i <= pieces; ++i)
    arc.points.push_back(from + (to - from) * (static_cast<double>(i) / pieces));
  graph.arcs.push_back(arc);
  return graph;
}

}  // namespace

TEST_CASE("A straight arc needs its two ends only") {
  const SurfaceSnapshot surface = make_snapshot(test::sphere(500));
  const BoundingVolumeHierarchy solid(surface);
  ArcGraph graph = straight_line({-0.2, 0, 0}, {0.2, 0, 0}, 40);
  CHECK(limit_nodes(graph, solid, 7) == 7);
  CHECK(graph.arcs[0].points.size() == 7);
  CHECK(limit_nodes(graph, solid, 2) == 2);
  CHECK((graph.arcs[0].points.front() - Vector3(-0.2, 0, 0)).norm() == 0);
  CHECK((graph.arcs[0].points.back() - Vector3(0.2, 0, 0)).norm() == 0);
}

TEST_CASE("A loop keeps three edges whatever the budget") {
  const SurfaceSnapshot surface = make_snapshot(test::sphere(500));
  const BoundingVolumeHierarchy solid(surface);
  ArcGraph graph;
  graph.add_hub({0.2, 0, 0});
  Arc loop;
  loop.hub = {0, 0};
  for (int i = 0; i <= 24; ++i)
    loop.points.push_back({0.2 * std::cos(2 * kPi * i / 24), 0.2 * std::sin(2 * kPi * i / 24), 0});
  loop.points.back() = loop.points.front();
  graph.arcs.push_back(loop);
  CHECK(limit_nodes(graph, solid, 1) == 3);
  CHECK(graph.arcs[0].points.size() == 4);
}

TEST_CASE("No chord of the budget meets the surface") {
  const SurfaceSnapshot surface = make_snapshot(test::torus(1.0, 0.2, 60, 20));
  const BoundingVolumeHierarchy solid(surface);
  ArcGraph graph;
  const double r = 1.0 / surface.frame.scale;
  graph.add_hub({r, 0, 0});
  Arc loop;
  loop.hub = {0, 0};
  for (int i = 0; i <= 60; ++i)
    loop.points.push_back({r * std::cos(2 * kPi * i / 60), r * std::sin(2 * kPi * i / 60), 0});
  loop.points.back() = loop.points.front();
  graph.arcs.push_back(loop);
  const bool lies_flat = solid.inside(loop.points[7]);
  REQUIRE(lies_flat);
  CHECK(limit_nodes(graph, solid, 4) > 4);
  for (std::size_t i = 1; i < graph.arcs[0].points.size(); ++i)
    CHECK_FALSE(solid.segment_crosses(graph.arcs[0].points[i - 1], graph.arcs[0].points[i]));
}
