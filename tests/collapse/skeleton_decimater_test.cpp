// Laws of the collapse loop: it ends, keeps a partition, and keeps exactly the loops that the labels count.
#include "mspskel/collapse/skeleton_decimater.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "collapse/complexes.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

std::vector<MergingSet> random_sets(Index count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<MergingSet> sets;
  for (Index v = 0; v < count; ++v) {
    MergingVertex vertex;
    vertex.position = {uniform(random), uniform(random), uniform(random)};
    vertex.perimeter = 0.1 + uniform(random);
    vertex.normal = Vector3{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5}.normalized();
    vertex.error = uniform(random);
    vertex.area = uniform(random);
    vertex.valid = v % 7 != 3;
    sets.emplace_back(vertex);
  }
  return sets;
}

std::vector<CollapseOptions> option_variants() {
  std::vector<CollapseOptions> variants(6);
  variants[1].one_dimensional = EdgePolicy::kKeep;
  variants[2].saturation_threshold = 1e9;
  variants[3].dead_end = DeadEnd::kParallelEdges;
  variants[4].order = CollapseOrder::kShortestFirst;
  variants[4].one_dimensional = EdgePolicy::kKeep;
  variants[5].lambda = 0;
  variants[5].angle_floor = 0.1;
  variants[5].dead_end = DeadEnd::kParallelEdges;
  variants[5].one_dimensional = EdgePolicy::kKeep;
  return variants;
}

// By a look at everything: the longest edge with one face and the largest face, kNone if there are none; of
// equal ones the first.
std::pair<Index, Index> rest_of_sheets(const SkeletonDecimater& decimater) {
  const SkeletonComplex& c = decimater.complex();
  const auto at = [&](Index v) { return decimater.merging_set(v).position(); };
  std::pair<Index, Index> rest{kNone, kNone};
  float longest = 0;
  for (Index e = 0; e < c.edge_capacity(); ++e) {
    if (!c.is_edge(e) || c.face_count(e) != 1) continue;
    const auto length = static_cast<float>((at(c.ends(e)[0]) - at(c.ends(e)[1])).norm() + 1e-10);
    if (length > longest) longest = length, rest.first = e;
  }
  double largest = -1;
  for (Index f = 0; f < c.face_capacity(); ++f) {
    if (!c.is_face(f)) continue;
    const auto darts = c.face_darts(f);
    const Vector3 p = at(c.origin(darts[0]));
    const double area = (at(c.origin(darts[1])) - p).cross(at(c.origin(darts[2])) - p).norm();
    if (area > largest) largest = area, rest.second = f;
  }
  return rest;
}

// Steps to the end and checks after every operation; returns the topology at the end.
ComplexTopology collapse_checked(SkeletonComplex complex, std::vector<MergingSet> sets,
                                 const CollapseOptions& options) {
  const ComplexTopology before = complex_topology(complex);
  const Index vertices = complex.vertex_count();
  double area = 0;
  for (Index v = 0; v < complex.vertex_capacity(); ++v)
    if (complex.is_vertex(v)) area += sets[v].area();
  SkeletonDecimater decimater(std::move(complex), std::move(sets), options);
  const SkeletonComplex& c = decimater.complex();
  int steps = 0;
  CollapseCounts counts;
  std::pair<Index, Index> rest{kNone, kNone};
  do {
    if (decimater.counts().thinned_faces > counts.thinned_faces) {
      REQUIRE(rest.first != kNone);
      REQUIRE_FALSE(c.is_edge(rest.first));
    } else if (decimater.counts().deleted_faces > counts.deleted_faces) {
      REQUIRE(rest.first == kNone);
      REQUIRE_FALSE(c.is_face(rest.second));
    }
    counts = decimater.counts();
    rest = rest_of_sheets(decimater);
    REQUIRE(c.find_violation() == "");
    std::vector<Index> members(static_cast<std::size_t>(c.vertex_capacity()), 0);
    for (Index v = 0; v < c.vertex_capacity(); ++v) ++members[decimater.node_of(v)];
    double covered = 0;
    Index total = 0;
    for (Index v = 0; v < c.vertex_capacity(); ++v) {
      if (!c.is_vertex(v)) continue;
      REQUIRE(members[v] == decimater.merging_set(v).count());
      covered += decimater.merging_set(v).area();
      total += members[v];
    }
    REQUIRE(total == vertices);
    REQUIRE(covered == Approx(area));
    const ComplexTopology topology = complex_topology(c);
    REQUIRE(topology.components == before.components);
    if (options.keep_topology) REQUIRE(topology.label_rank == before.label_rank);
    REQUIRE(++steps < 100000);
  } while (decimater.step());
  const ComplexTopology after = complex_topology(c);
  CHECK(c.face_count() == 0);
  if (options.keep_topology) CHECK(after.cycles == before.label_rank);
  return after;
}

// Triangles on random vertices, with labels φ(v) − φ(u) of a random potential, which are null, plus loops:
// vertices are split into sheets of a covering, so that every face closes.
SkeletonComplex random_complex(std::mt19937& random, Index vertices, int faces, Index genus) {
  std::vector<CocycleLabel> potential(static_cast<std::size_t>(vertices));
  const auto random_label = [&] {
    CocycleLabel label;
    for (Index i = 0; i < genus; ++i) label += CocycleLabel::unit(i, static_cast<int>(random() % 5) - 2);
    return label;
  };
  for (CocycleLabel& label : potential) label = random_label();
  SkeletonComplex complex(vertices);
  const auto edge = [&](Index u, Index v, const CocycleLabel& loop) {
    return complex.add_edge(u, v, potential[v] - potential[u] + loop);
  };
  for (int f = 0; f < faces; ++f) {
    std::array<Index, 3> corner;
    do {
      for (Index& v : corner) v = static_cast<Index>(random() % static_cast<unsigned>(vertices));
    } while (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]);
    const CocycleLabel a = random() % 3 == 0 ? random_label() : CocycleLabel(),
                       b = random() % 3 == 0 ? random_label() : CocycleLabel();
    const Index e0 = edge(corner[0], corner[1], a), e1 = edge(corner[1], corner[2], b),
                e2 = edge(corner[2], corner[0], -(a + b));
    complex.add_face(2 * e0, 2 * e1, 2 * e2);
  }
  for (int e = 0; e < faces / 4; ++e) {
    const Index u = static_cast<Index>(random() % static_cast<unsigned>(vertices));
    const Index v = static_cast<Index>((u + 1 + random() % static_cast<unsigned>(vertices - 1)) %
                                       static_cast<unsigned>(vertices));
    edge(u, v, random_label());
  }
  complex.merge_parallel_edges();
  return complex;
}

}  // namespace

TEST_CASE("a tetrahedron ends as a tree") {
  for (const CollapseOptions& options : option_variants())
    CHECK(collapse_checked(tetrahedron_complex(), random_sets(4, 1), options).cycles == 0);
}

TEST_CASE("the loop ends on all-equal costs, equal positions and vanishing weights") {
  for (const CollapseOptions& options : option_variants())
    for (const bool valid : {true, false})
      for (const double error : {0.0, 1.0}) {
        MergingVertex vertex;
        vertex.error = error;
        vertex.valid = valid;
        vertex.area = error;  // without any area too
        const std::vector<MergingSet> sets(7, MergingSet(vertex));
        collapse_checked(seven_vertex_torus(CocycleLabel::unit(0), {}), sets, options);
        CollapseOptions hooked = options;
        hooked.cost = [](const CostTerms&) { return std::nan(""); };
        collapse_checked(seven_vertex_torus({}, CocycleLabel::unit(0)), sets, hooked);
      }
}

TEST_CASE("the 7-vertex torus ends with the labels' rank of loops, whatever the labels") {
  for (const CollapseOptions& options : option_variants())
    for (int a = -3; a <= 3; ++a)
      for (int b = -3; b <= 3; ++b) {
        const SkeletonComplex complex =
            seven_vertex_torus(CocycleLabel::unit(0, a), CocycleLabel::unit(0, b));
        CHECK(collapse_checked(complex, random_sets(7, 3), options).cycles == (a != 0 || b != 0 ? 1 : 0));
      }
  for (const CollapseOptions& options : option_variants()) {
    const SkeletonComplex complex = seven_vertex_torus(CocycleLabel::unit(0), CocycleLabel::unit(1));
    CHECK(collapse_checked(complex, random_sets(7, 4), options).cycles == 2);
  }
}

TEST_CASE("random complexes with random cocycles end with b1 = rank") {
  std::mt19937 random(11);
  const auto variants = option_variants();
  for (unsigned round = 0; round < 60; ++round) {
    const Index vertices = 4 + static_cast<Index>(random() % 20);
    const int triangles = static_cast<int>(random() % 60);
    const Index genus = static_cast<Index>(random() % 4);
    const SkeletonComplex complex = random_complex(random, vertices, triangles, genus);
    collapse_checked(complex, random_sets(vertices, round), variants[round % variants.size()]);
  }
}

TEST_CASE("without the rule every loop may be lost, and the collapse still ends") {
  CollapseOptions literal;
  literal.keep_topology = false;
  literal.one_dimensional = EdgePolicy::kKeep;
  std::mt19937 random(12);
  bool lost = false;
  for (unsigned round = 0; round < 20; ++round) {
    SkeletonComplex complex = random_complex(random, 12, 20, 2);
    const Index rank = complex_topology(complex).label_rank;
    complex.forget_labels();
    lost = collapse_checked(complex, random_sets(12, round), literal).cycles < rank || lost;
  }
  CHECK(lost);
}

TEST_CASE("equal input gives equal bytes") {
  std::mt19937 random(13);
  const SkeletonComplex complex = random_complex(random, 30, 80, 2);
  const CollapsedSkeleton a = collapse_complex(complex, random_sets(30, 9)),
                          b = collapse_complex(complex, random_sets(30, 9));
  REQUIRE(a.nodes.size() == b.nodes.size());
  REQUIRE(a.edges.size() == b.edges.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    CHECK(std::memcmp(a.nodes[i].position.data(), b.nodes[i].position.data(), 3 * sizeof(double)) == 0);
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    CHECK(a.edges[i].first == b.edges[i].first);
    CHECK(a.edges[i].second == b.edges[i].second);
    CHECK(a.edges[i].label == b.edges[i].label);
  }
  CHECK(a.node_of_vertex == b.node_of_vertex);
}

TEST_CASE("the cheapest edge goes first and the merged node lies at the weighted mean") {
  SkeletonComplex complex = tetrahedron_complex();
  std::vector<MergingSet> sets = random_sets(4, 21);
  SkeletonDecimater decimater(complex, sets);
  Index cheapest = 0;
  for (Index e = 1; e < 6; ++e)
    if (decimater.cost(e) < decimater.cost(cheapest)) cheapest = e;
  const auto [u, v] = complex.ends(cheapest);
  REQUIRE(decimater.step());
  CHECK(decimater.node_of(u) == decimater.node_of(v));
  sets[u].merge(sets[v]);
  CHECK((decimater.merging_set(decimater.node_of(u)).position() - sets[u].position()).norm() < 1e-12);
}

TEST_CASE("noise is what lies below the saturation threshold") {
  // A path a-b-c: b covers ten times a's area, c as much as b, all perimeters equal.
  const auto path = [](double threshold) {
    SkeletonComplex complex(3);
    complex.add_edge(0, 1);
    complex.add_edge(1, 2);
    std::vector<MergingSet> sets;
    for (const double area : {0.1, 1.0, 1.0}) {
      MergingVertex vertex;
      vertex.position = {static_cast<double>(sets.size()), 0, 0};
      vertex.perimeter = 1.0;
      vertex.area = area;
      sets.emplace_back(vertex);
    }
    CollapseOptions options;
    options.saturation_threshold = threshold;
    return collapse_complex(complex, sets, options);
  };
  CHECK(path(0.05).nodes.size() == 3);
  CHECK(path(0.15).nodes.size() == 2);
  CHECK(path(1.5).nodes.size() == 1);
  CHECK(path(0.15).counts.one_dimensional_collapses == 1);
}

TEST_CASE("an edge in the list of skeleton edges comes back when its saturation falls") {
  // a-b is listed with saturation 0.5; then c, larger by far, merges into b over a face.
  SkeletonComplex complex(4);
  complex.add_edge(0, 1);
  const Index e = complex.add_edge(1, 2), f = complex.add_edge(2, 3), g = complex.add_edge(3, 1);
  complex.add_face(2 * e, 2 * f, 2 * g);
  std::vector<MergingSet> sets;
  for (const double area : {0.5, 1.0, 40.0, 40.0}) {
    MergingVertex vertex;
    vertex.position = {area, 0, 0};
    vertex.perimeter = 1.0;
    vertex.area = area;
    vertex.normal = Vector3::UnitX();
    sets.emplace_back(vertex);
  }
  CollapseOptions options;
  options.cost = [](const CostTerms& t) { return t.relative_length; };
  SkeletonDecimater decimater(complex, sets, options);
  decimater.run();
  CHECK(decimater.counts().reopened >= 1);
  CHECK(decimater.result().node_of_vertex[0] == decimater.result().node_of_vertex[1]);
}

TEST_CASE("without one-dimensional collapses every dangling edge stays") {
  SkeletonComplex complex(5);
  for (Index v = 0; v < 4; ++v) complex.add_edge(v, v + 1);
  CollapseOptions options;
  options.one_dimensional = EdgePolicy::kKeep;
  CHECK(collapse_complex(complex, random_sets(5, 2), options).edges.size() == 4);
}

TEST_CASE("a cancelled collapse throws") {
  Execution execution;
  execution.progress = [](const char*, double) { return false; };
  CHECK_THROWS_AS(collapse_complex(tetrahedron_complex(), random_sets(4, 1), {}, execution), Cancelled);
}

TEST_CASE("a wrong number of sets and a position that is not finite are refused") {
  CHECK_THROWS_AS(SkeletonDecimater(tetrahedron_complex(), random_sets(3, 1)), UsageError);
  std::vector<MergingSet> sets = random_sets(4, 1);
  MergingVertex vertex;
  vertex.position.x() = std::nan("");
  sets[2] = MergingSet(vertex);
  CHECK_THROWS_AS(SkeletonDecimater(tetrahedron_complex(), sets), UsageError);
}

TEST_CASE("a regular surface collapses in the same order whatever its rounding") {
  const SurfaceSnapshot surface = make_snapshot(torus(3, 1, 24, 12));
  CollapseOptions options;
  options.lambda = 0;
  options.angle_floor = 0.3;
  options.one_dimensional = EdgePolicy::kKeep;
  const auto collapsed = [&](std::uint64_t seed) {
    Random random(seed);
    const auto noisy = [&](double x) { return x * (1 + 1e-14 * random.uniform(-1, 1)); };
    std::vector<MergingSet> sets;
    for (const Vector3& p : surface.position) {
      const Vector3 centre = 0.3 * Vector3(p.x(), p.y(), 0).normalized();
      MergingVertex vertex;
      vertex.position = centre + 0.1 * (p - centre);
      for (double& x : vertex.position) x = noisy(x);
      vertex.perimeter = noisy(0.5);
      vertex.normal = Vector3(-p.y(), p.x(), 0).normalized();
      vertex.error = noisy(0.2);
      vertex.area = noisy(0.01);
      sets.emplace_back(vertex);
    }
    return collapse_complex(make_complex(surface, {}), sets, options).node_of_vertex;
  };
  for (std::uint64_t seed = 1; seed < 6; ++seed) CHECK(collapsed(seed) == collapsed(seed + 100));
}
