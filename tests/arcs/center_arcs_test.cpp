// Arcs come to the middle of the solid and never leave it on the way.
#include "mspskel/arcs/center_arcs.h"

#include <catch2/catch.hpp>

#include "mspskel/arcs/detail/arc_points.h"
#include "mspskel/arcs/detail/waver.h"
#include "mspskel/io/write_mesh.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/samples/samples.h"
#include "mspskel/samples/skin_graph.h"
#include "support/arc_graphs.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

struct Solid {
  SurfaceSnapshot surface;
  BoundingVolumeHierarchy hierarchy;
  explicit Solid(const DefaultMesh& mesh) : surface(make_snapshot(mesh)), hierarchy(surface) {}
  Vector3 at(double x, double y, double z) const { return surface.frame.to_normalised({x, y, z}); }
  double scale() const { return surface.frame.scale; }
};

double off_axis(const Vector3& x) { return std::hypot(x.x(), x.y()); }

// An arc through a tube of radius 1 round the z axis, through (x(z), y(z), z).
ArcGraph arc_along_tube(const Solid& solid, const std::function<Vector3(double)>& at) {
  ArcGraph graph;
  graph.add_hub(solid.surface.frame.to_normalised(at(2)));
  graph.add_hub(solid.surface.frame.to_normalised(at(10)));
  std::vector<Vector3> between;
  for (int i = 1; i < 80; ++i) between.push_back(solid.surface.frame.to_normalised(at(2 + 0.1 * i)));
  add_arc(graph, 0, 1, between);
  return graph;
}

}  // namespace

TEST_CASE("An arc beside the axis of a tube ends on it, its ends at their height") {
  const Solid solid(tube(1, 12, 24, 24));
  const std::vector<std::function<Vector3(double)>> arcs{
      [](double z) { return Vector3(0.5, -0.3, z); },
      [](double z) { return Vector3(0.4 * std::sin(z), 0.3, z); },
      [](double z) { return Vector3(0.1 * (z - 6), 0, z); },
  };
  for (const auto& line : arcs) {
    ArcGraph graph = arc_along_tube(solid, line);
    CenteringOptions options;
    options.rounds = 30;
    center_arcs(graph, solid.hierarchy, options);
    REQUIRE(arcs_meet_hubs(graph));
    for (const Vector3& p : graph.arcs[0].points) CHECK(off_axis(solid.surface.frame.to_model(p)) < 0.01);
    CHECK(solid.surface.frame.to_model(graph.hub_position[0]).z() == Approx(2).margin(0.15));
    CHECK(solid.surface.frame.to_model(graph.hub_position[1]).z() == Approx(10).margin(0.15));
  }
}

TEST_CASE("An end that is held stays where it is, and the arc comes to the axis between") {
  const Solid solid(tube(1, 12, 24, 24));
  // Its last third is a straight line from beside the axis to the end on it.
  const auto line = [](double z) { return Vector3(std::min(0.5, 0.2 * (10 - z)), 0, z); };
  for (const bool held : {false, true}) {
    ArcGraph graph = arc_along_tube(solid, line);
    const Vector3 target = solid.at(0, 0.3, 11);
    graph.move_hub(1, target);
    CenteringOptions options;
    options.rounds = 30;
    center_arcs(graph, solid.hierarchy, options, {}, {}, held ? std::vector<Index>{1} : std::vector<Index>{});
    REQUIRE(arcs_meet_hubs(graph));
    CHECK((graph.hub_position[1] == target) == held);
    for (const Vector3& p : graph.arcs[0].points) {
      const Vector3 x = solid.surface.frame.to_model(p);
      if (x.z() < 9) CHECK(off_axis(x) < 0.02);
    }
  }
}

TEST_CASE("A joint that is held stays where it is, beside the axis to which its arcs come") {
  const Solid solid(tube(1, 12, 24, 24));
  for (const bool held : {false, true}) {
    ArcGraph graph = arc_along_tube(solid, [](double z) { return Vector3(0.4, 0.3, z); });
    const Index joint = split_arc(graph, 0, 40);
    const Vector3 place = graph.hub_position[joint];
    CenteringOptions options;
    options.rounds = 30;
    center_arcs(graph, solid.hierarchy, options, {}, {},
                held ? std::vector<Index>{joint} : std::vector<Index>{});
    REQUIRE(arcs_meet_hubs(graph));
    CHECK((graph.hub_position[joint] == place) == held);
    for (const Index end : {0, 1})
      CHECK(off_axis(solid.surface.frame.to_model(graph.hub_position[end])) < 0.02);
  }
}

TEST_CASE("Arc points lie at most a step apart") {
  const Solid solid(tube(1, 12, 24, 24));
  ArcGraph graph = arc_along_tube(solid, [](double z) { return Vector3(0.4 * std::sin(z), 0.3, z); });
  CenteringOptions options;
  center_arcs(graph, solid.hierarchy, options);
  const auto& points = graph.arcs[0].points;
  for (std::size_t i = 1; i < points.size(); ++i)
    CHECK((points[i] - points[i - 1]).norm() < 1.2 * options.step);
}

TEST_CASE("Without rounds arcs are resampled and stay where they are") {
  const Solid solid(tube(1, 12, 24, 24));
  ArcGraph graph = arc_along_tube(solid, [](double z) { return Vector3(0.4, 0.3, z); });
  CenteringOptions options;
  options.rounds = 0;
  options.step = 0.02;
  center_arcs(graph, solid.hierarchy, options);
  const auto& points = graph.arcs[0].points;
  for (std::size_t i = 1; i < points.size(); ++i)
    CHECK((points[i] - points[i - 1]).norm() < (1 + 1e-6) * options.step);
  for (const Vector3& p : points) CHECK(off_axis(solid.surface.frame.to_model(p)) == Approx(0.5));
}

TEST_CASE("The arc of a thin limb becomes straight where it runs through the thick bar that carries it") {
  SampleOptions made;
  made.section = Section::kRound;
  made.ratio = 0.4;
  const CurveSkeleton truth = sample_truth("tee", made);
  const Solid solid(to_mesh(make_sample("tee", made)));
  std::vector<Index> degree(truth.nodes.size(), 0);
  for (const auto& [i, j] : truth.edges) ++degree[i], ++degree[j];
  Index joint = 0, tip = kNone;
  for (Index i = 0; i < static_cast<Index>(truth.nodes.size()); ++i)
    if (degree[i] == 3) joint = i;
  ArcGraph graph;
  for (const SkeletonNode& node : truth.nodes)
    graph.add_hub(solid.surface.frame.to_normalised(node.position));
  Vector3 along_bar = Vector3::Zero();
  for (Index i = 0; i < static_cast<Index>(truth.nodes.size()); ++i) {
    if (i == joint) continue;
    if (tip == kNone || truth.nodes[i].radius < truth.nodes[tip].radius) tip = i;
  }
  for (Index i = 0; i < static_cast<Index>(truth.nodes.size()); ++i)
    if (i != joint && i != tip) {
      add_arc(graph, joint, i, {});
      along_bar = (graph.hub_position[i] - graph.hub_position[joint]).normalized();
    }
  const Vector3 from = graph.hub_position[joint], way = graph.hub_position[tip] - from;
  const double half_width = truth.nodes[tip].radius / solid.scale();
  std::vector<Vector3> wavering;
  for (int k = 1; k < 60; ++k)
    wavering.push_back(from + k / 60.0 * way + 0.5 * half_width * std::sin(0.2 * k) * along_bar);
  add_arc(graph, joint, tip, wavering);
  CenteringOptions options;
  options.rounds = 20;
  center_arcs(graph, solid.hierarchy, options);
  const Vector3 start = graph.hub_position[joint], axis = (graph.hub_position[tip] - start).normalized();
  double farthest = 0;
  for (const Vector3& p : graph.arcs[2].points) farthest = std::max(farthest, (p - start).cross(axis).norm());
  CHECK(farthest < 0.015 * half_width);
}

TEST_CASE("A line wavers as much as it turns back, and a corner and an even bend do not") {
  std::vector<Vector3> corner, bend, wave;
  for (int i = -30; i <= 30; ++i) {
    const double t = 0.1 * i;
    corner.push_back(t < 0 ? Vector3(t, 0, 0) : Vector3(0, t, 0));
    bend.push_back({std::cos(t / 3), std::sin(t / 3), 0});
    wave.push_back({t, 0.5 * std::sin(2 * t), 0});
  }
  CHECK(detail::waver(corner, 30, 12) == Approx(0).margin(1e-9));
  CHECK(detail::waver(bend, 30, 30) == Approx(0).margin(1e-9));
  CHECK(detail::waver(wave, 30, 30) > 2);
  CHECK(detail::waver(wave, 38, 6) < 0.1);  // one bend of it
}

TEST_CASE("The bumps of a thick body do not make an arc turn to and fro in it") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    BallGraph body;
    body.blend = 0.1;
    body.nodes = {{Vector3(0, 0, 0), 1.0}, {Vector3(2.2, 0.3, 0.2), 0.15}, {Vector3(-2.2, 0.1, -0.2), 0.15}};
    body.edges = {{0, 1}, {0, 2}};
    for (int bump = 0; bump < 16; ++bump) {
      body.edges.emplace_back(0, static_cast<Index>(body.nodes.size()));
      body.nodes.push_back({0.9 * random.in_ball().normalized(), 0.42});
    }
    const Solid solid(to_mesh(skin_graph(body, 3000)));
    ArcGraph graph;
    graph.add_hub(solid.at(2.2, 0.3, 0.2));
    graph.add_hub(solid.at(-2.2, 0.1, -0.2));
    add_arc(graph, 0, 1, {solid.at(0.6, 0.25, 0.1), solid.at(-0.6, -0.2, 0.2)});
    CenteringOptions options;
    options.rounds = 30;
    center_arcs(graph, solid.hierarchy, options);
    const std::vector<Vector3>& line = graph.arcs[0].points;
    double waver = 0;
    for (std::size_t i = 20; i + 20 < line.size(); i += 20) waver += detail::waver(line, i, 20);
    CHECK(waver < 0.65);
  }
}

TEST_CASE("An arc follows near walls rather than far ones, however flat the solid is") {
  // One side of a flat bar wavers, and so does its thickness' middle, by the same.
  const auto waver = [](double z) { return 0.12 * std::sin(3 * z); };
  for (const double flatness : {3.0, 8.0}) {
    PolygonSoup flat = to_polygon_soup(tube(1, 12, 24, 96));
    for (Vector3& p : flat.points)
      p = Vector3(p.x() + (p.x() > 0 ? 2 * p.x() * waver(p.z()) : 0), p.y() / flatness + waver(p.z()), p.z());
    const Solid solid(to_mesh(flat));
    ArcGraph graph = arc_along_tube(solid, [](double z) { return Vector3(0, 0, z); });
    CenteringOptions options;
    options.rounds = 20;
    center_arcs(graph, solid.hierarchy, options);
    double wide = 0, narrow = 0;
    for (const Vector3& p : graph.arcs[0].points) {
      const Vector3 x = solid.surface.frame.to_model(p);
      if (std::abs(x.z() - 6) > 4) continue;
      wide = std::max(wide, std::abs(x.x()));
      narrow = std::max(narrow, std::abs(x.y() - waver(x.z())));
    }
    CAPTURE(flatness);
    CHECK(wide < 0.1);
    CHECK(narrow < 0.07 / flatness);
  }
}

TEST_CASE("The centre line of a torus keeps its loop") {
  const Solid solid(torus(1, 0.3, 40, 16));
  ArcGraph graph;
  graph.add_hub(solid.at(1.1, 0, 0.1));
  std::vector<Vector3> ring;
  for (int i = 1; i < 40; ++i) {
    const double a = 2 * kPi * i / 40;
    ring.push_back(solid.at(1.1 * std::cos(a), 1.1 * std::sin(a), 0.1));
  }
  add_arc(graph, 0, 0, ring);
  center_arcs(graph, solid.hierarchy, {});
  REQUIRE(type_of(graph) == GraphType{1, 1});
  REQUIRE(crossings(graph, solid.hierarchy) == 0);
  for (const Vector3& p : graph.arcs[0].points)
    CHECK(off_axis(solid.surface.frame.to_model(p)) == Approx(1).margin(0.03));
}

TEST_CASE("A step longer than a limb is wide does not cut its corners") {
  BallGraph zigzag;
  zigzag.blend = 0;
  for (int i = 0; i < 6; ++i) zigzag.nodes.push_back({{0.5 * i, i % 2 ? 1.0 : 0.0, 0}, 0.08});
  for (int i = 0; i < 5; ++i) zigzag.edges.push_back({i, i + 1});
  const Solid solid(to_mesh(skin_graph(zigzag, 900)));
  ArcGraph graph;
  graph.add_hub(solid.surface.frame.to_normalised(zigzag.nodes.front().position));
  graph.add_hub(solid.surface.frame.to_normalised(zigzag.nodes.back().position));
  std::vector<Vector3> corners;
  for (int i = 1; i < 5; ++i) corners.push_back(solid.surface.frame.to_normalised(zigzag.nodes[i].position));
  add_arc(graph, 0, 1, corners);
  REQUIRE(crossings(graph, solid.hierarchy) == 0);
  for (const double step : {0.01, 0.05, 0.2, 0.5})
    for (const int rounds : {1, 5}) {
      ArcGraph moved = graph;
      CenteringOptions options;
      options.step = step;
      options.rounds = rounds;
      center_arcs(moved, solid.hierarchy, options);
      INFO(step << ", " << rounds << " rounds");
      CHECK(crossings(moved, solid.hierarchy) == 0);
      CHECK(arcs_meet_hubs(moved));
    }
}

TEST_CASE("Random graphs in a ball keep their type and stay inside") {
  const Solid solid(sphere(120));
  Random random(9);
  for (int run = 0; run < 20; ++run) {
    ArcGraph graph = random_arc_graph(random, 0.4);
    const GraphType before = type_of(graph);
    REQUIRE(crossings(graph, solid.hierarchy) == 0);
    CenteringOptions options;
    options.step = 0.05;
    options.rounds = 3;
    center_arcs(graph, solid.hierarchy, options);
    CHECK(type_of(graph) == before);
    CHECK(arcs_meet_hubs(graph));
    CHECK(crossings(graph, solid.hierarchy) == 0);
  }
}

TEST_CASE(
    "A section seen from anywhere in a tube has the tube's radius, and its centre lies nearer the axis") {
  const Solid solid(tube(1, 12, 48, 24));
  for (const double x : {0.0, 0.3, 0.7}) {
    const VisibleSection section = visible_section(solid.hierarchy, solid.at(x, 0, 6), Vector3::UnitZ(), 64);
    REQUIRE(section.closed);
    CHECK(section.radius * solid.scale() == Approx(1).margin(0.03));
    CHECK(section.roundness > 0.97);
    CHECK(section.clearance * solid.scale() == Approx(1 - x).margin(0.02));
    CHECK(off_axis(solid.surface.frame.to_model(section.centre)) < 0.3 * x + 0.01);
  }
  CHECK_FALSE(visible_section(solid.hierarchy, solid.at(3, 0, 6), Vector3::UnitZ(), 64).closed);
}

TEST_CASE("A section tells where it is wide, seen from anywhere in it") {
  PolygonSoup ellipse = to_polygon_soup(tube(1, 12, 48, 24));
  for (Vector3& p : ellipse.points) p.y() *= 0.4;
  const Solid solid(to_mesh(ellipse));
  for (const double x : {0.0, 0.3, 0.7}) {
    const VisibleSection section =
        visible_section(solid.hierarchy, solid.at(x, 0.1, 6), Vector3::UnitZ(), 64);
    REQUIRE(section.closed);
    CHECK(section.narrowness == Approx(0.4).margin(0.02));
    CHECK(std::abs(section.wide.x()) > 0.99);
  }
}

TEST_CASE("Centring can be cancelled, and its options are checked") {
  const Solid solid(tube(1, 12, 12, 12));
  ArcGraph graph = arc_along_tube(solid, [](double z) { return Vector3(0.5, 0, z); });
  Execution execution;
  execution.progress = [](const char*, double) { return false; };
  CHECK_THROWS_AS(center_arcs(graph, solid.hierarchy, {}, execution), Cancelled);
  CHECK(arcs_meet_hubs(graph));
  CenteringOptions wrong;
  wrong.step = 0;
  CHECK_THROWS_AS(center_arcs(graph, solid.hierarchy, wrong), UsageError);
}

TEST_CASE("A piece that moves as a whole does not leave the solid") {
  const Solid solid(tube(1, 12, 24, 24));
  const ArcGraph graph = arc_along_tube(solid, [](double z) { return Vector3(0.2, 0, z); });
  // Without an edge across the surface on the way: only the places tell.
  for (const double way : {0.5, 3.0, 100.0}) {
    detail::ArcPoints points(graph);
    std::vector<Vector3> goal;
    for (const Vector3& x : points.x) goal.push_back(x + Vector3(way, way, 0));
    detail::move_inside(points, solid.hierarchy, goal, CrossingLabels(), {});
    for (const Vector3& x : points.x) CHECK(solid.hierarchy.inside(x));
  }
}

TEST_CASE("Arcs stay inside with any weight of straight arcs") {
  SampleOptions small;
  small.resolution = 120;
  const Solid solid(build_mesh(make_sample("torus", small)));
  for (const double smoothness : {0.1, 1e3, 1e6}) {
    ArcGraph graph;
    std::vector<Vector3> ring;
    for (int i = 0; i <= 40; ++i)
      ring.push_back(solid.at(std::cos(2 * kPi * (i % 40) / 40), std::sin(2 * kPi * (i % 40) / 40), 0.1));
    const Index hub = graph.add_hub(ring.front());
    graph.arcs.push_back({{hub, hub}, ring, true});
    CenteringOptions options;
    options.smoothness = smoothness;
    center_arcs(graph, solid.hierarchy, options);
    CHECK(crossings(graph, solid.hierarchy) == 0);
    for (const Vector3& x : graph.arcs[0].points) CHECK(solid.hierarchy.inside(x));
  }
}
