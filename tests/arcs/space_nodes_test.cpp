// Spacing moves no arc: nodes at even distances on the line, and never across the surface.
#include "mspskel/arcs/space_nodes.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/build_mesh.h"
#include "mspskel/samples/samples.h"

using namespace mspskel;

namespace {

SurfaceSnapshot sample(const std::string& name, Index resolution) {
  SampleOptions options;
  options.resolution = resolution;
  return make_snapshot(build_mesh(make_sample(name, options)));
}

ArcGraph ring(double radius, Index count) {
  ArcGraph graph;
  std::vector<Vector3> points;
  for (Index i = 0; i <= count; ++i) {
    const double angle = 2 * kPi * (i % count) / count;
    points.push_back(radius * Vector3(std::cos(angle), std::sin(angle), 0));
  }
  const Index hub = graph.add_hub(points.front());
  graph.arcs.push_back({{hub, hub}, points, true});
  return graph;
}

}  // namespace

TEST_CASE("a straight arc gets even steps of at most the spacing") {
  const SurfaceSnapshot surface = sample("sphere", 200);
  const BoundingVolumeHierarchy solid(surface);
  for (const double spacing : {0.001, 0.03, 0.1, 0.25, 0.5}) {
    ArcGraph graph;
    const Vector3 from(-0.2, 0, 0), to(0.2, 0, 0);
    const Index a = graph.add_hub(from), b = graph.add_hub(to);
    graph.arcs.push_back({{a, b}, {from, {-0.17, 0, 0}, {0.05, 0, 0}, {0.1, 0, 0}, to}, true});
    space_nodes(graph, solid, spacing);
    const auto& points = graph.arcs[0].points;
    const auto count = static_cast<std::size_t>(std::ceil(0.4 / spacing - 1e-9));
    REQUIRE(points.size() == count + 1);
    CHECK(points.front() == from);
    CHECK(points.back() == to);
    for (std::size_t i = 1; i < points.size(); ++i)
      CHECK((points[i] - points[i - 1]).norm() == Approx(0.4 / static_cast<double>(count)));
  }
}

TEST_CASE("a ring keeps its way round the hole, at any spacing") {
  const SurfaceSnapshot surface = sample("torus", 2000);
  const BoundingVolumeHierarchy solid(surface);
  const double radius = 1 / surface.frame.scale;
  for (const double spacing : {0.0005, 0.01, 0.1, 0.26, 0.5}) {
    ArcGraph graph = ring(radius, 120);
    space_nodes(graph, solid, spacing);
    const auto& points = graph.arcs[0].points;
    CHECK(points.size() >= 4);
    CHECK(points.front() == points.back());
    double angle = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      CHECK_FALSE(solid.segment_crosses(points[i - 1], points[i]));
      const Vector3 &p = points[i - 1], &q = points[i];
      angle += std::atan2(p.x() * q.y() - p.y() * q.x(), p.x() * q.x() + p.y() * q.y());
    }
    CHECK(angle == Approx(2 * kPi));
  }
}

TEST_CASE("a way round a hole is not cut short on its other side") {
  const SurfaceSnapshot surface = sample("torus", 2000);
  const BoundingVolumeHierarchy solid(surface);
  ArcGraph loop = ring(1 / surface.frame.scale, 120);
  // All of the ring but a piece short enough for one straight step: the chord alone would close it.
  std::vector<Vector3> points(loop.arcs[0].points.begin(), loop.arcs[0].points.end() - 4);
  ArcGraph graph;
  const Index a = graph.add_hub(points.front()), b = graph.add_hub(points.back());
  REQUIRE_FALSE(solid.segment_crosses(points.front(), points.back()));
  graph.arcs.push_back({{a, b}, points, true});
  space_nodes(graph, solid, 100.0);
  CHECK(graph.arcs[0].points.size() >= 4);
}

TEST_CASE("parallel arcs and loops stay a simple graph") {
  const SurfaceSnapshot surface = sample("sphere", 200);
  const BoundingVolumeHierarchy solid(surface);
  ArcGraph graph;
  const Vector3 from(-0.1, 0, 0), to(0.1, 0, 0);
  const Index a = graph.add_hub(from), b = graph.add_hub(to);
  graph.arcs.push_back({{a, b}, {from, {0, 0.1, 0}, to}, true});
  graph.arcs.push_back({{b, a}, {to, {0, -0.1, 0}, from}, true});
  graph.arcs.push_back({{b, b}, {to, {0.15, 0.05, 0}, {0.15, -0.05, 0}, to}, true});
  space_nodes(graph, solid, 0.5);
  CHECK(graph.arcs[0].points.size() == 3);
  CHECK(graph.arcs[1].points.size() == 3);
  CHECK(graph.arcs[2].points.size() == 4);
}
