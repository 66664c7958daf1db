#include <cmath>

#include "families.h"
#include "mspskel/samples/skin_graph.h"
#include "noise.h"
#include "truth.h"

namespace mspskel::detail {

namespace {

// Adds a chain of nodes that starts at node `from`; returns the last one's number.
Index grow(BallGraph& graph, Index from, const std::vector<BallNode>& nodes) {
  for (const BallNode& node : nodes) {
    graph.nodes.push_back(node);
    graph.edges.emplace_back(from, static_cast<Index>(graph.nodes.size()) - 1);
    from = graph.edges.back().second;
  }
  return from;
}

using BuildGraph = BallGraph (*)(const SampleOptions&);

// The skin of a graph, which is its skeleton too.
Family skin_family(const SampleInfo& info, BuildGraph build,
                   const std::function<void(SampleInfo&, const SampleOptions&)>& adapt = {}) {
  return {info, [build](const SampleOptions& o) { return skin_graph(build(o), o.resolution); }, adapt,
          [build](const SampleOptions& o) { return truth_of(build(o)); }};
}
Family y_tube() {
  const auto build = [](const SampleOptions&) {
    BallGraph graph;
    graph.blend = 0.3;
    graph.nodes.push_back({{0, 0, 0}, 0.6});
    grow(graph, 0, {{{0.1, 0.2, -3.4}, 0.6}});
    grow(graph, 0, {{{2.3, -0.1, 2.2}, 0.55}});
    grow(graph, 0, {{{-2.0, 0.1, 2.9}, 0.5}});
    return graph;
  };
  return skin_family(facts("y-tube", "three tubes that meet", 0, 3, 2000, 200), build);
}

Family quadruped() {
  const auto build = [](const SampleOptions&) {
    BallGraph g;
    g.blend = 0.25;
    g.nodes = {{{-2.0, 0, 0.05}, 0.72}, {{-0.4, 0.02, -0.08}, 0.68}, {{1.2, 0, 0.05}, 0.74}};
    g.edges = {{0, 1}, {1, 2}};
    for (const double side : {-1.0, 1.0}) {
      // Neither pair of legs stands in step, so that left and right do not tie.
      const double step = side < 0 ? 0.25 : -0.15;
      grow(g, 2,
           {{{1.35, 0.42 * side, -0.6}, 0.42},
            {{1.35 + step, 0.5 * side, -1.6}, 0.25},
            {{1.2 + 1.3 * step, 0.5 * side, -2.6}, 0.2},
            {{1.42 + 1.3 * step, 0.5 * side, -2.75}, 0.2}});
      grow(g, 0,
           {{{-2.1, 0.42 * side, -0.5}, 0.46},
            {{-2.15 - step, 0.5 * side, -1.5}, 0.28},
            {{-2.5 - 1.2 * step, 0.5 * side, -2.6}, 0.2},
            {{-2.28 - 1.2 * step, 0.5 * side, -2.75}, 0.2}});
    }
    const Index nape = grow(g, 2, {{{1.9, 0.03, 0.75}, 0.46}, {{2.5, 0.06, 1.6}, 0.36}});
    grow(g, nape, {{{3.0, 0.1, 1.62}, 0.34}, {{3.6, 0.14, 1.3}, 0.24}});
    for (const double side : {-1.0, 1.0})
      grow(g, nape,
           {{{2.5, 0.06 + 0.24 * side, 1.95}, 0.15}, {{2.42, 0.08 + 0.34 * side, 2.45 + 0.05 * side}, 0.11}});
    grow(g, 0, {{{-2.75, -0.05, 0.4}, 0.2}, {{-3.4, -0.15, 0.1}, 0.15}, {{-3.75, -0.3, -0.7}, 0.13}});
    return g;
  };
  return standing(skin_family(
      facts("quadruped", "four-legged creature: legs, snout, two ears and a tail round a given skeleton", 0,
            8, 5000, 2500),
      build));
}

Family octoped() {
  const auto build = [](const SampleOptions&) {
    BallGraph g;
    g.blend = 0.2;
    g.nodes = {{{0, 0, 0}, 0.75}};
    grow(g, 0, {{{0.1, -0.05, 0.9}, 0.85}, {{0.25, -0.1, 1.9}, 0.8}});
    for (Index arm = 0; arm < 8; ++arm) {
      const auto id = static_cast<std::uint64_t>(arm);
      const double start = 2 * kPi * (arm + 0.12 * noise(5, id)) / 8, curl = 0.9 + 0.25 * noise(6, id);
      std::vector<BallNode> nodes;
      constexpr Index kPieces = 10;
      for (Index i = 1; i <= kPieces; ++i) {
        const double s = static_cast<double>(i) / kPieces, angle = start + curl * s * s * 0.9;
        const double reach = 0.45 + 3.3 * s, height = -0.35 - 0.9 * std::sin(2.2 * s) + 0.9 * s * s;
        nodes.push_back(
            {{reach * std::cos(angle), reach * std::sin(angle), height}, 0.34 * (1 - s) + 0.12 * s});
      }
      grow(g, 0, nodes);
    }
    return g;
  };
  return standing(skin_family(
      facts("octoped", "eight curled arms and a head round a given skeleton", 0, 9, 6000, 2500), build));
}

// A scaffold on a torus: 3 rails wound once round the tube while they go round the axis, tied together in
// `count` triangles. With 7 triangles it has 42 bars, 21 joints and so 22 loops, as many handles as the
// heptoroid of the thesis.
Family heptoroid() {
  const SampleInfo info = with_count(
      facts("heptoroid", "twisted scaffold on a torus, 22 handles for 7 sectors", 22, 0, 8000, 3000),
      "sectors", 7, 4, 40);
  const auto build = [](const SampleOptions& o) {
    BallGraph g;
    g.blend = 0.15;
    const double major = 0.45 * std::max<Index>(o.count, 6);
    for (Index i = 0; i < o.count; ++i)
      for (Index j = 0; j < 3; ++j) {
        const auto id = static_cast<std::uint64_t>(3 * i + j);
        const double u = 2 * kPi * (i + 0.02 * noise(8, id)) / o.count;
        const double v = 2 * kPi * (j + (i + 0.03 * noise(9, id)) / o.count) / 3,
                     rho = major + 1.2 * std::cos(v);
        g.nodes.push_back(
            {{rho * std::cos(u), rho * std::sin(u), 1.2 * std::sin(v)}, 0.24 + 0.02 * noise(10, id)});
        g.edges.emplace_back(3 * i + j, 3 * i + (j + 1) % 3);
        // After one way round the axis each rail goes on as the next one.
        g.edges.emplace_back(3 * i + j, i + 1 < o.count ? 3 * (i + 1) + j : (j + 1) % 3);
      }
    return g;
  };
  return skin_family(info, build, [](SampleInfo& i, const SampleOptions& o) {
    i.genus = 3 * o.count + 1;
    i.resolution = 1200 * o.count;
    i.least_resolution = 450 * o.count;
  });
}

}  // namespace

std::vector<Family> skin_families() { return {y_tube(), quadruped(), octoped(), heptoroid()}; }

}  // namespace mspskel::detail
