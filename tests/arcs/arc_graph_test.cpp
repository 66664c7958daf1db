// Changes of an arc graph keep its homotopy type and pass every vertex on.
#include "mspskel/arcs/arc_graph.h"

#include <catch2/catch.hpp>

#include "mspskel/arcs/detail/arc_editor.h"
#include "support/arc_graphs.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

Arc straight_arc(const Vector3& a, const Vector3& b, Random& random) {
  std::vector<double> places;
  for (Index i = random.below(6); i > 0; --i) places.push_back(random.uniform());
  std::sort(places.begin(), places.end());
  Arc arc;
  arc.hub = {0, 1};
  arc.points.push_back(a);
  for (const double t : places) arc.points.push_back(a + t * (b - a));
  arc.points.push_back(b);
  return arc;
}

}  // namespace

TEST_CASE("Resampling a straight line keeps its ends and its length, in even steps below the wanted one") {
  Random random(1);
  for (int run = 0; run < 200; ++run) {
    const Vector3 a = random.in_ball(), b = random.in_ball();
    const Arc arc = straight_arc(a, b, random);
    const double step = random.uniform(0.01, 1);
    const Index least = 1 + random.below(5);
    Arc even = arc;
    even.points = resampled(arc, step, least);
    const auto edges = static_cast<double>(even.points.size() - 1);
    REQUIRE(even.points.front() == a);
    REQUIRE(even.points.back() == b);
    REQUIRE(edges >= least);
    REQUIRE(arc_length(even) == Approx((b - a).norm()));
    for (std::size_t i = 1; i < even.points.size(); ++i) {
      const double length = (even.points[i] - even.points[i - 1]).norm();
      REQUIRE(length == Approx((b - a).norm() / edges).margin(1e-12));
      REQUIRE(length <= step * (1 + 1e-8));
    }
    // No more edges than the step or the least number asks for.
    REQUIRE(edges <= std::max<double>(least, std::ceil((b - a).norm() / step)));
  }
}

TEST_CASE("Resampled points lie on the polyline") {
  Random random(2);
  for (int run = 0; run < 50; ++run) {
    const ArcGraph graph = random_arc_graph(random);
    for (const Arc& arc : graph.arcs) {
      double before = 0;
      for (const Vector3& x : resampled(arc, random.uniform(0.05, 2))) {
        double nearest = 1e9;
        for (std::size_t i = 1; i < arc.points.size(); ++i) {
          const Vector3 edge = arc.points[i] - arc.points[i - 1];
          const double square = edge.squaredNorm();
          const double t =
              square > 0 ? std::clamp((x - arc.points[i - 1]).dot(edge) / square, 0.0, 1.0) : 0.0;
          nearest = std::min(nearest, (arc.points[i - 1] + t * edge - x).norm());
        }
        REQUIRE(nearest < 1e-9);
        before += 1;
      }
      REQUIRE(before >= (arc.hub[0] == arc.hub[1] ? 4 : 2));
    }
  }
}

TEST_CASE("An arc without length is resampled to its place") {
  Arc arc;
  arc.hub = {0, 0};
  arc.points = {Vector3::Ones(), Vector3::Ones()};
  const auto points = resampled(arc, 0.1);
  REQUIRE(points.size() == 4);
  for (const Vector3& p : points) REQUIRE(p == Vector3::Ones());
}

TEST_CASE("Dissolving hubs keeps the homotopy type, the length and the map") {
  Random random(3);
  for (int run = 0; run < 500; ++run) {
    ArcGraph graph = random_arc_graph(random);
    const GraphType before = type_of(graph);
    double length = 0, length_after = 0;
    for (const Arc& arc : graph.arcs) length += arc_length(arc);
    const Index leaves = leaf_count(graph);
    dissolve_through_hubs(graph);
    for (const Arc& arc : graph.arcs)
      if (arc.alive) length_after += arc_length(arc);
    REQUIRE(type_of(graph) == before);
    REQUIRE(arcs_meet_hubs(graph));
    REQUIRE(map_is_partition(graph));
    REQUIRE(leaf_count(graph) == leaves);
    REQUIRE(length_after == Approx(length));
    // What is left of two arc ends is the one hub of a closed chain.
    for (const auto& arcs : graph.incidence())
      if (arcs.size() == 2) REQUIRE(arcs[0] == arcs[1]);
  }
}

TEST_CASE("A closed chain of arcs dissolves to one loop") {
  ArcGraph graph;
  for (Index i = 0; i < 5; ++i) graph.add_hub({std::cos(2 * kPi * i / 5), std::sin(2 * kPi * i / 5), 0});
  for (Index i = 0; i < 5; ++i) i % 2 ? add_arc(graph, i, (i + 1) % 5) : add_arc(graph, (i + 1) % 5, i);
  graph.hub_of_vertex = {0, 1, 2, kNone};
  graph.arc_of_vertex = {kNone, kNone, kNone, 4};
  dissolve_through_hubs(graph);
  REQUIRE(living_arcs(graph) == 1);
  REQUIRE(type_of(graph) == GraphType{1, 1});
  REQUIRE(map_is_partition(graph));
}

TEST_CASE("Removing a leaf arc keeps the homotopy type and gives its vertices to the joint") {
  Random random(4);
  Index removed = 0;
  for (int run = 0; run < 300; ++run) {
    ArcGraph graph = random_arc_graph(random);
    const GraphType before = type_of(graph);
    for (Index a = 0; a < graph.arc_count(); ++a) {
      const auto at = graph.incidence();
      const auto hub = graph.arcs[a].hub;
      const int tip = at[hub[0]].size() == 1 ? 0 : 1;
      if (at[hub[tip]].size() != 1) continue;
      std::vector<std::size_t> own;
      for (std::size_t v = 0; v < graph.arc_of_vertex.size(); ++v)
        if (graph.arc_of_vertex[v] == a || graph.hub_of_vertex[v] == hub[tip]) own.push_back(v);
      detail::ArcEditor(graph).remove_leaf_arc(a, hub[1 - tip]);
      ++removed;
      for (const std::size_t v : own) REQUIRE(graph.hub_of_vertex[v] == hub[1 - tip]);
      REQUIRE(type_of(graph) == before);
      REQUIRE(map_is_partition(graph));
    }
  }
  REQUIRE(removed > 100);
}

TEST_CASE("An editor changes a graph as the whole graph would be, and knows what meets at each hub") {
  Random random(6);
  int removed = 0, dissolved = 0;
  for (int run = 0; run < 600; ++run) {
    ArcGraph graph = random_arc_graph(random);
    if (graph.arcs.empty()) continue;
    const GraphType before = type_of(graph);
    detail::ArcEditor editor(graph);
    for (int change = 0; change < 20; ++change) {
      const auto a = random.below(graph.arc_count());
      if (!graph.arcs[a].alive) continue;
      const auto [from, to] = graph.arcs[a].hub;
      if (editor.at(to).size() == 1 && editor.at(from).size() > 1) {
        editor.remove_leaf_arc(a, from);
        ++removed;
      }
      ArcGraph whole = graph;
      if (editor.at(from).size() == 2 && editor.dissolve(from) != kNone) {
        ++dissolved;
        join_at(whole, from, whole.incidence()[from][0], whole.incidence()[from][1]);
        for (Index b = 0; b < graph.arc_count(); ++b) REQUIRE(whole.arcs[b].points == graph.arcs[b].points);
      }
      const auto at = graph.incidence();
      for (Index h = 0; h < graph.hub_count(); ++h) REQUIRE(at[h] == editor.at(h));
      REQUIRE(type_of(graph) == before);
      REQUIRE(arcs_meet_hubs(graph));
      REQUIRE(map_is_partition(graph));
    }
  }
  REQUIRE(removed > 100);
  REQUIRE(dissolved > 100);
}

TEST_CASE("Contracting arcs that are no loops keeps the homotopy type and the map") {
  Random random(5);
  Index contracted = 0;
  for (int run = 0; run < 300; ++run) {
    ArcGraph graph = random_arc_graph(random);
    const GraphType before = type_of(graph);
    for (Index a = 0; a < graph.arc_count(); ++a) {
      if (graph.arcs[a].hub[0] == graph.arcs[a].hub[1] || random.below(2)) continue;
      const Vector3 place = random.in_ball();
      const Index kept = graph.arcs[a].hub[0];
      contract_arc(graph, a, place);
      ++contracted;
      REQUIRE(graph.hub_position[kept] == place);
      REQUIRE(type_of(graph) == before);
      REQUIRE(arcs_meet_hubs(graph));
      REQUIRE(map_is_partition(graph));
    }
  }
  REQUIRE(contracted > 100);
}

TEST_CASE("The points from either end are each other's reverse, and a moved hub takes its arc ends along") {
  ArcGraph graph;
  graph.add_hub({0, 0, 0});
  graph.add_hub({1, 0, 0});
  const Index way = add_arc(graph, 0, 1, {{0.5, 1, 0}}), loop = add_arc(graph, 1, 1, {{1, 1, 0}, {2, 1, 0}});
  auto back = points_from(graph.arcs[way], 1);
  REQUIRE(back.front() == Vector3(1, 0, 0));
  std::reverse(back.begin(), back.end());
  REQUIRE(back == points_from(graph.arcs[way], 0));
  graph.move_hub(1, {3, 3, 3});
  REQUIRE(arcs_meet_hubs(graph));
  REQUIRE(graph.arcs[loop].points.back() == Vector3(3, 3, 3));
  REQUIRE(graph.incidence()[1] == std::vector<Index>{way, loop, loop});
}
