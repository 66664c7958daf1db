// Leaf arcs are led to the ends of their limbs.
#include "mspskel/refine/aim_ends.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/limb_tips.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/samples/skin_graph.h"
#include "refine/tripod_arcs.h"
#include "support/arc_graphs.h"
#include "support/solids.h"
#include "support/soups.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// The vertex nearest to a place, as a tip to which an arc is to lead, with the vertices within `reach` of it.
LimbTip tip_at(const Solid& solid, const Vector3& place, double half_width, double reach) {
  LimbTip tip;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index v = 0; v < solid.surface.vertex_count(); ++v) {
    const double distance = (solid.model(solid.surface.position[v]) - place).norm();
    if (distance <= reach) tip.cap.push_back(v);
    if (distance >= nearest) continue;
    nearest = distance;
    tip.vertex = v;
  }
  tip.position = tip.target = solid.surface.position[tip.vertex];
  tip.measures.half_width = solid.at({half_width, 0, 0}).x() - solid.at({0, 0, 0}).x();
  return tip;
}

}  // namespace

TEST_CASE("Short leaf arcs are aimed at the end of their limb, and ends that reach it stay") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  ArcGraph graph = tripod_arcs(solid, 0.5);
  CHECK(aim_ends(graph, solid.surface, solid.hierarchy, 0.01) == 3);
  CHECK(crossings(graph, solid.hierarchy) == 0);
  for (Index i = 1; i < 4; ++i) {
    const Vector3 tip = tripod().nodes[i].position;
    CHECK((solid.model(graph.hub_position[i]) - tip).norm() < 0.3 * tip.norm());
  }
  CHECK(aim_ends(graph, solid.surface, solid.hierarchy, 0.05) == 0);
}

TEST_CASE("A leaf arc that stands for a tip is led to its target") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  ArcGraph graph = tripod_arcs(solid, 0.5, nullptr);
  const std::vector<LimbTip> tips = tripod_tips(solid);
  detail::InnerGraph inner(solid.surface, solid.hierarchy);
  CHECK(aim_at_tips(graph, inner, tips, 0.01).size() == 3);
  const auto at = graph.incidence();
  for (const LimbTip& tip : tips) {
    double nearest = std::numeric_limits<double>::infinity();
    for (Index h = 0; h < graph.hub_count(); ++h)
      if (graph.hub_alive[h] && at[h].size() == 1)
        nearest = std::min(nearest, (graph.hub_position[h] - tip.target).norm());
    CHECK(nearest < 0.02);
  }
  CHECK(crossings(graph, solid.hierarchy) == 0);
}

TEST_CASE("An arc is led into a thin limb by steps of the limb's width") {
  const Solid solid(to_mesh(box({-0.01, -0.01, -4}, {0.01, 0.01, 4})));
  ArcGraph graph;
  graph.add_hub(solid.at({0, 0, 0}));
  for (const Vector3& end : {Vector3(0, 0, 3.945), Vector3(0, 0, -3.9), Vector3(0.005, 0, 0)}) {
    graph.add_hub(solid.at(end));
    line(graph, 0, graph.hub_count() - 1);
  }
  map_to_nearest(graph, solid.surface.position);
  detail::InnerGraph inner(solid.surface, solid.hierarchy);
  LimbTip tip = tip_at(solid, {0, 0, 4}, 0.01, 0.1);
  tip.position = tip.target = solid.at({0, 0, 4});
  // The step of thick limbs is longer than the way that is left.
  CHECK(aim_at_tips(graph, inner, {tip}, 0.008).size() == 1);
  CHECK(solid.model(graph.hub_position[1]).z() > 3.975);
  CHECK(crossings(graph, solid.hierarchy) == 0);
}

TEST_CASE("An arc is led round a bend to a tip out of sight") {
  BallGraph hook = tripod();
  hook.nodes.push_back({{1.6, 0, 3}, 0.3});
  hook.nodes.push_back({{1.6, 0, 1.2}, 0.3});
  hook.edges.push_back({1, 4});
  hook.edges.push_back({4, 5});
  const Solid solid(to_mesh(skin_graph(hook, 1600)));
  ArcGraph graph = tripod_arcs(solid, 0.5);
  const LimbTip tip = tip_at(solid, {1.6, 0, 0.9}, 0.3, 1);
  // Its end has the map's vertices round the tip, as the collapse leaves it.
  for (const Index v : tip.cap) {
    graph.arc_of_vertex[v] = 0;
    graph.hub_of_vertex[v] = kNone;
  }
  detail::InnerGraph inner(solid.surface, solid.hierarchy);
  CHECK(aim_at_tips(graph, inner, {tip}, 0.01) == std::vector<Index>{1});
  CHECK((solid.model(graph.hub_position[1]) - Vector3(1.6, 0, 1.2)).norm() < 0.3);
  CHECK(crossings(graph, solid.hierarchy) == 0);
}

TEST_CASE("The arc of a flat bar ends in the middles of its ends") {
  for (const Vector3& sides :
       {Vector3(5, 1, 0.3), Vector3(6, 1, 0.3), Vector3(6, 2, 0.6), Vector3(6, 1.5, 0.9)}) {
    DefaultMesh bar = cube();
    Vector3 low = Vector3::Constant(1e9), high = -low;
    for (const auto v : bar.vertices()) {
      low = low.cwiseMin(to_vector3(bar.point(v)));
      high = high.cwiseMax(to_vector3(bar.point(v)));
    }
    for (const auto v : bar.vertices()) {
      const Vector3 x =
          (to_vector3(bar.point(v)) - (low + high) / 2).cwiseProduct(sides.cwiseQuotient(high - low));
      bar.set_point(v, {x[0], x[1], x[2]});
    }
    const CurveSkeleton skeleton = extract_skeleton(bar).skeleton;
    const auto neighbours = adjacency(skeleton);
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      if (neighbours[i].size() != 1) continue;
      const Vector3& end = skeleton.nodes[i].position;
      INFO(sides.transpose());
      CHECK(std::abs(end.x()) > 0.4 * sides.x());
      CHECK(std::abs(end.y()) < 0.1 * sides.y());
      CHECK(std::abs(end.z()) < 0.1 * sides.z());
    }
  }
}
