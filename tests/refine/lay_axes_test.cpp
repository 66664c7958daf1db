// Straight arcs for solids without limbs.
#include "mspskel/refine/lay_axes.h"

#include <catch2/catch.hpp>

#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/default_mesh.h"
#include "mspskel/mesh/detail/solid_moments.h"
#include "mspskel/samples/blocks.h"
#include "support/arc_graphs.h"
#include "support/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// One crooked arc that stands for the whole surface.
ArcGraph crooked(const Solid& solid) {
  ArcGraph graph;
  graph.add_hub(solid.surface.position.front() * 0.5);
  graph.add_hub(solid.surface.position.back() * 0.5);
  graph.arcs.push_back({{0, 1}, graph.hub_position, true});
  graph.arc_of_vertex.assign(solid.surface.position.size(), 0);
  graph.hub_of_vertex.assign(solid.surface.position.size(), kNone);
  return graph;
}

// Both meshes as one.
DefaultMesh beside(DefaultMesh a, const DefaultMesh& b) {
  std::vector<DefaultMesh::VertexHandle> corner;
  for (const auto v : b.vertices()) corner.push_back(a.add_vertex(b.point(v)));
  for (const auto f : b.faces()) {
    std::vector<DefaultMesh::VertexHandle> face;
    for (const auto v : b.fv_range(f)) face.push_back(corner[static_cast<std::size_t>(v.idx())]);
    a.add_face(face);
  }
  return a;
}

// The tip of a limb at the vertex nearest to x, model units.
LimbTip tip_at(const Solid& solid, const Vector3& x) {
  const SurfaceSnapshot& s = solid.surface;
  LimbTip tip;
  tip.vertex = 0;
  for (Index v = 0; v < s.vertex_count(); ++v)
    if ((s.frame.to_model(s.position[v]) - x).norm() < (s.frame.to_model(s.position[tip.vertex]) - x).norm())
      tip.vertex = v;
  return tip;
}

Solid of_boxes(const std::vector<Block>& boxes) {
  return Solid(to_mesh(make_boxes(boxes, 3000, 0, 1)));
}

// An angle, a channel, a channel with lips, a T: of walls 0.2 thick along the z axis.
std::vector<std::vector<Block>> profiles(double length) {
  const auto wall = [&](double x0, double x1, double y0, double y1) {
    return Block{{x0, y0, 0}, {x1, y1, length}};
  };
  return {{wall(0, 1.2, 0, 0.2), wall(0, 0.2, 0, 0.9)},
          {wall(0, 1, 0, 0.2), wall(0, 0.2, 0, 0.8), wall(0.8, 1, 0, 0.8)},
          {wall(0, 1, 0, 0.2), wall(0, 0.2, 0, 0.9), wall(0.8, 1, 0, 0.9), wall(0, 0.4, 0.7, 0.9),
           wall(0.6, 1, 0.7, 0.9)},
          {wall(0, 1, 0.7, 0.9), wall(0.4, 0.6, 0, 0.9)}};
}

}  // namespace

TEST_CASE("A block gets one arc along its axis, whatever the collapse made of it") {
  for (const double angle : {0.0, 0.7}) {
    const Vector3 turn(0.2, 1, -0.4);
    const Solid solid(rotated(prism(4, 5, 9), turn, angle));
    ArcGraph graph = crooked(solid);
    REQUIRE(lay_axes(graph, solid.surface, solid.hierarchy, {}) == 1);
    CHECK(homotopy_type(graph) == ArcGraphType{1, 0});
    const Arc& axis = graph.arcs.back();
    REQUIRE(axis.alive);
    const Vector3 along = (axis.points.back() - axis.points.front()).normalized();
    const Vector3 expected = Eigen::AngleAxisd(angle, turn.normalized()) * Vector3::UnitZ();
    CHECK(std::abs(along.dot(expected)) == Approx(1).epsilon(1e-6));
    for (const Vector3& x : axis.points) CHECK(solid.hierarchy.inside(x));
    // The prism has radius 1 and length 5, so its inner radius is 1/√2; the ends stop half of that before it
    // ends.
    const double length = (axis.points.back() - axis.points.front()).norm() * solid.surface.frame.scale;
    CHECK(length == Approx(5 - 1 / std::sqrt(2.0)).epsilon(1e-6));
    for (const Index a : graph.arc_of_vertex) CHECK(a == graph.arc_count() - 1);
  }
}

TEST_CASE("Every block gets an axis of its own") {
  const Solid pair(beside(prism(4, 5, 9), translated(prism(4, 5, 9), {20, 0, 0})));
  REQUIRE(pair.surface.component_count == 2);
  ArcGraph graph;
  graph.arc_of_vertex.assign(pair.surface.position.size(), kNone);
  graph.hub_of_vertex = pair.surface.component;
  for (Index v = 0; v < pair.surface.vertex_count(); ++v)
    if (graph.hub_count() == pair.surface.component[v]) graph.add_hub(pair.surface.position[v]);
  CHECK(lay_axes(graph, pair.surface, pair.hierarchy, {}) == 2);
  CHECK(homotopy_type(graph) == ArcGraphType{2, 0});
  for (Index v = 0; v < pair.surface.vertex_count(); ++v)
    CHECK(graph.arc_of_vertex[v] == pair.surface.component[v]);
}

TEST_CASE("What has limbs, a handle, or air in its middle keeps its arcs") {
  const Solid block(prism(4, 5, 9));
  ArcGraph graph = crooked(block);
  CHECK(lay_axes(graph, block.surface, block.hierarchy, {tip_at(block, {0, 0, 2.5})}) == 0);
  CHECK(graph.arcs.front().alive);
  const Solid ring(torus(3, 1, 40, 20));
  graph = crooked(ring);
  CHECK(lay_axes(graph, ring.surface, ring.hierarchy, {}) == 0);
  CHECK(graph.arcs.front().alive);
}

TEST_CASE("What is longer than wide has its axis along its length, however flat it is") {
  for (const Vector3& sides : {Vector3(3, 2, 1), Vector3(5, 4, 1), Vector3(10, 5, 2)}) {
    DefaultMesh ellipsoid = sphere(1200);
    for (const auto v : ellipsoid.vertices())
      ellipsoid.set_point(v, {ellipsoid.point(v)[0] * sides.x(), ellipsoid.point(v)[1] * sides.y(),
                              ellipsoid.point(v)[2] * sides.z()});
    const Vector3 axis = detail::solid_moments(make_snapshot(ellipsoid))[0].axis();
    CHECK(std::abs(axis.x()) > 0.999);
  }
}

TEST_CASE("A profile has its axis along its length, in a wall where its centroid lies in air") {
  for (const double length : {3.0, 6.0})
    for (const std::vector<Block>& profile : profiles(length)) {
      const Solid solid = of_boxes(profile);
      // What reaches farthest are corners of its ends.
      for (const std::vector<LimbTip>& tips :
           {std::vector<LimbTip>{}, {tip_at(solid, {0, 0, 0}), tip_at(solid, {1, 1, length})}}) {
        ArcGraph graph = crooked(solid);
        REQUIRE(lay_axes(graph, solid.surface, solid.hierarchy, tips) == 1);
        const Arc& axis = graph.arcs.back();
        for (std::size_t i = 1; i < axis.points.size(); ++i)
          CHECK_FALSE(solid.hierarchy.segment_crosses(axis.points[i - 1], axis.points[i]));
        const Vector3 along = solid.surface.frame.scale * (axis.points.back() - axis.points.front());
        CHECK(std::hypot(along.x(), along.y()) < 0.01);
        CHECK(std::abs(along.z()) > length - 0.2);
        CHECK(solid.hierarchy.distance(axis.points[1]) * solid.surface.frame.scale > 0.09);
      }
    }
}

TEST_CASE("A bench is no prism") {
  const Solid bench = of_boxes({{{0, 0, 0}, {6, 2, 0.3}},
                                {{0, 0, -1}, {0.3, 0.3, 0}},
                                {{5.7, 0, -1}, {6, 0.3, 0}},
                                {{0, 1.7, -1}, {0.3, 2, 0}},
                                {{5.7, 1.7, -1}, {6, 2, 0}}});
  const std::vector<LimbTip> feet{tip_at(bench, {0, 0, -1}), tip_at(bench, {6, 0, -1}),
                                  tip_at(bench, {0, 2, -1}), tip_at(bench, {6, 2, -1})};
  ArcGraph graph = crooked(bench);
  CHECK(lay_axes(graph, bench.surface, bench.hierarchy, feet) == 0);
  // Two legs as wide as the bench leave one tip an end, and weigh there.
  const Solid staple =
      of_boxes({{{0, 0, 0}, {6, 1, 0.3}}, {{0, 0, -1}, {0.5, 1, 0}}, {{5.5, 0, -1}, {6, 1, 0}}});
  graph = crooked(staple);
  CHECK(lay_axes(graph, staple.surface, staple.hierarchy,
                 {tip_at(staple, {0, 0, -1}), tip_at(staple, {6, 1, -1})}) == 0);
}

TEST_CASE("A cube has its axis across its sides, however it lies, and a plate along its longer one") {
  for (const double angle : {0.0, 0.7, 2.1}) {
    const Eigen::Matrix3d turn(Eigen::AngleAxisd(angle, Vector3(0.3, -1, 0.5).normalized()));
    for (const Vector3& sides : {Vector3(1, 1, 1), Vector3(1.05, 1, 1), Vector3(2, 1.9, 0.2)}) {
      DefaultMesh box = cube();
      for (const auto v : box.vertices()) {
        const Vector3 x =
            turn * Vector3(box.point(v)[0], box.point(v)[1], box.point(v)[2]).cwiseProduct(sides);
        box.set_point(v, {x[0], x[1], x[2]});
      }
      const Solid solid(box);
      ArcGraph graph = crooked(solid);
      REQUIRE(lay_axes(graph, solid.surface, solid.hierarchy, {}) == 1);
      const Arc& axis = graph.arcs.back();
      const Vector3 along =
          (turn.transpose() * (axis.points.back() - axis.points.front()).normalized()).cwiseAbs();
      CHECK(along.maxCoeff() == Approx(1).epsilon(1e-9));
      if (sides.x() > 1) CHECK(along.x() > 0.999);
    }
  }
}

TEST_CASE("The skeleton of a block does not depend on its triangles") {
  const auto ends = [](Index rings) {
    const ExtractResult result = extract_skeleton(prism(4, 1.7, rings));
    CHECK(result.refinement.axes == 1);
    std::vector<double> heights;
    for (const auto& node : result.skeleton.nodes) {
      CHECK(std::hypot(node.position.x(), node.position.y()) < 0.02);
      heights.push_back(node.position.z());
    }
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    return std::array<double, 2>{*low, *high};
  };
  const auto coarse = ends(9), fine = ends(13);
  CHECK(coarse[0] == Approx(fine[0]).margin(0.02));
  CHECK(coarse[1] == Approx(fine[1]).margin(0.02));
}
