// Skeleton structure filtering: hairs go, limbs stay, near joints combine, and no loop is ever touched.
#include "mspskel/thesis/branch_filter.h"

#include <catch2/catch.hpp>
#include <random>

#include "mspskel/arcs/collapsed_arcs.h"
#include "mspskel/skeleton/make_curve_skeleton.h"

using namespace mspskel;

namespace {

struct Builder {
  CollapsedSkeleton skeleton;

  // A node whose ball has the given radius.
  Index node(double x, double y, double radius) {
    MergingVertex vertex;
    vertex.position = {x, y, 0};
    vertex.perimeter = 2 * kPi * radius;
    vertex.area = 1.0;
    vertex.normal = Vector3::UnitX();
    const MergingSet set(vertex);
    const Index id = static_cast<Index>(skeleton.nodes.size());
    skeleton.nodes.push_back({set.position(), set.area(), set.perimeter(), set.error(), set.axis(), set});
    skeleton.node_of_vertex.push_back(id);
    return id;
  }
  void edge(Index a, Index b, CocycleLabel label = {}) {
    skeleton.edges.push_back({std::min(a, b), std::max(a, b), a < b ? label : -label});
    std::sort(skeleton.edges.begin(), skeleton.edges.end(),
              [](const CollapsedEdge& p, const CollapsedEdge& q) {
                return std::make_pair(p.first, p.second) < std::make_pair(q.first, q.second);
              });
  }
};

double total_area(const CollapsedSkeleton& skeleton) {
  double sum = 0;
  for (const CollapsedNode& node : skeleton.nodes) sum += node.area;
  return sum;
}

GraphCounts counts_of(const CollapsedSkeleton& skeleton) {
  return count_graph(make_curve_skeleton(skeleton, NormalisedFrame{}));
}

}  // namespace

TEST_CASE("a branch inside the ball of its joint goes, one that leaves it stays") {
  Builder b;
  const Index joint = b.node(0, 0, 1.0);
  b.edge(joint, b.node(5, 0, 1.0));
  b.edge(joint, b.node(-5, 0, 1.0));
  b.edge(joint, b.node(0, 4, 0.2));
  const Index middle = b.node(0, -0.4, 1.0), hair = b.node(0, -0.8, 1.0);
  b.edge(joint, middle);
  b.edge(middle, hair);
  const BranchFilterResult filtered = filter_branches(b.skeleton);
  CHECK(filtered.dropped_branches == 1);
  CHECK(filtered.dropped_nodes == 2);
  CHECK(filtered.skeleton.nodes.size() == 4);
  CHECK(filtered.skeleton.edges.size() == 3);
  CHECK(filtered.skeleton.node_of_vertex[hair] == filtered.skeleton.node_of_vertex[joint]);
  CHECK(filtered.skeleton.nodes[joint].position.norm() == 0.0);
  CHECK(filtered.skeleton.nodes[joint].area == Approx(3.0));
  CHECK(total_area(filtered.skeleton) == Approx(6.0));
}

TEST_CASE("a path keeps both its ends however short it is") {
  Builder b;
  b.edge(b.node(0, 0, 10), b.node(0.1, 0, 10));
  CHECK(filter_branches(b.skeleton).skeleton.nodes.size() == 2);
}

TEST_CASE("three hairs at one joint leave a path") {
  Builder b;
  const Index joint = b.node(0, 0, 10);
  for (const double x : {1.0, 2.0, 3.0}) b.edge(joint, b.node(x, 0, 10));
  const BranchFilterResult filtered = filter_branches(b.skeleton);
  CHECK(filtered.dropped_branches == 1);
  CHECK(counts_of(filtered.skeleton).leaves == 2);
}

TEST_CASE("joints within each other's ball combine, others do not") {
  for (const double gap : {0.5, 2.0}) {
    Builder b;
    const Index left = b.node(0, 0, 1.0), right = b.node(gap, 0, 1.0);
    b.edge(left, right);
    for (const double y : {-4.0, 4.0}) {
      b.edge(left, b.node(-3, y, 0.1));
      b.edge(right, b.node(3, y, 0.1));
    }
    const BranchFilterResult filtered = filter_branches(b.skeleton);
    CHECK(filtered.combined_joints == (gap < 1 ? 1 : 0));
    CHECK(counts_of(filtered.skeleton).joints == (gap < 1 ? 1 : 2));
    CHECK(counts_of(filtered.skeleton).leaves == 4);
  }
}

TEST_CASE("a handle stays a triangle however near its joints are") {
  Builder b;
  Index corner[3];
  for (int i = 0; i < 3; ++i) corner[i] = b.node(0.1 * i, 0.1 * (i % 2), 5.0);
  for (int i = 0; i < 3; ++i) b.edge(corner[i], b.node(20, 20.0 * i, 0.1));
  b.edge(corner[0], corner[1], CocycleLabel::unit(0));
  b.edge(corner[1], corner[2]);
  b.edge(corner[0], corner[2]);
  const BranchFilterResult filtered = filter_branches(b.skeleton);
  CHECK(filtered.refused_joints > 0);
  CHECK(counts_of(filtered.skeleton).cycles == 1);
  CHECK(filtered.skeleton.nodes.size() == 6);
}

TEST_CASE("filtering random graphs keeps components, cycles and the map") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 40; ++round) {
    Builder b;
    const int n = 20;
    for (int i = 0; i < n; ++i) {
      const Vector3 p{uniform(random), uniform(random), 0.5 * uniform(random)};
      b.node(p.x(), p.y(), p.z());
    }
    for (Index i = 1; i < n; ++i)
      if (i != n / 2) b.edge(static_cast<Index>(random() % static_cast<unsigned>(i)), i);
    Index genus = 0;
    for (int extra = 0; extra < 3; ++extra) {
      const Index u = static_cast<Index>(random() % n), v = static_cast<Index>(random() % n);
      if (u != v) b.edge(u, v, CocycleLabel::unit(genus++));
    }
    const GraphCounts before = counts_of(b.skeleton);
    const BranchFilterResult filtered = filter_branches(b.skeleton);
    const GraphCounts after = counts_of(filtered.skeleton);
    CHECK(after.components == before.components);
    CHECK(after.cycles == before.cycles);
    CHECK(total_area(filtered.skeleton) == Approx(n));
    std::vector<Index> members(filtered.skeleton.nodes.size(), 0);
    for (const Index node : filtered.skeleton.node_of_vertex) ++members.at(static_cast<std::size_t>(node));
    for (std::size_t i = 0; i < members.size(); ++i)
      CHECK(members[i] == filtered.skeleton.nodes[i].set.count());
  }
}

TEST_CASE("parallel edges and loops are split, so the result is a simple graph with the same cycles") {
  Builder b;
  const Index u = b.node(0, 0, 1), v = b.node(2, 0, 1);
  b.edge(u, v);
  b.edge(u, v, CocycleLabel::unit(0));
  b.edge(u, v, CocycleLabel::unit(1));
  b.edge(v, v, CocycleLabel::unit(2));
  NormalisedFrame frame;
  frame.scale = 2.0;
  frame.origin = {1, 1, 1};
  const CurveSkeleton skeleton = make_curve_skeleton(b.skeleton, frame);
  CHECK(skeleton.nodes.size() == 6);
  CHECK(count_graph(skeleton).cycles == 3);
  CHECK(std::adjacent_find(skeleton.edges.begin(), skeleton.edges.end()) == skeleton.edges.end());
  for (const auto& [a, c] : skeleton.edges) CHECK(a < c);
  CHECK(skeleton.nodes[1].position.x() == Approx(5.0));
  CHECK(skeleton.nodes[1].area == Approx(4.0));
}

TEST_CASE("a ball scale out of range is refused by name") {
  BranchFilterOptions options;
  options.ball_scale = -1;
  CHECK_THROWS_WITH(filter_branches({}, options), Catch::Contains("ball_scale"));
}
