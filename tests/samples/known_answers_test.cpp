// Skeletons of samples that are made round a given one: the same ends, loops and ways.
// scripts/known_answers.py runs many more.
#include <catch2/catch.hpp>

#include "mspskel/extract_skeleton.h"
#include "mspskel/samples/samples.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {
struct Case {
  const char* name;
  Index count = kNone;
  Section section = Section::kOwn;
  bool sparse = false;
};

std::vector<Index> nodes_of_degree(const CurveSkeleton& skeleton, bool (*wanted)(std::size_t)) {
  std::vector<Index> result;
  const auto neighbours = adjacency(skeleton);
  for (Index i = 0; i < static_cast<Index>(neighbours.size()); ++i)
    if (wanted(neighbours[i].size())) result.push_back(i);
  return result;
}

bool is_leaf(std::size_t degree) { return degree == 1; }
bool is_joint(std::size_t degree) { return degree > 2; }

// Distance to the nearest edge, in half widths of the part there.
double distance_in_radii(const CurveSkeleton& truth, const Vector3& p) {
  double least = 1e300, radius = 1;
  for (const auto& [i, j] : truth.edges) {
    const SkeletonNode &a = truth.nodes[i], &b = truth.nodes[j];
    const Vector3 axis = b.position - a.position;
    const double t = std::clamp((p - a.position).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    const double distance = (p - a.position - t * axis).norm();
    if (distance >= least) continue;
    least = distance;
    radius = (1 - t) * a.radius + t * b.radius;
  }
  return least / radius;
}

// Mean over the nodes that lie outside of 1.5 radii of the truth's joints.
double mean_distance(const CurveSkeleton& truth, const CurveSkeleton& made) {
  const std::vector<Index> joints = nodes_of_degree(truth, is_joint);
  double sum = 0, count = 0;
  for (const SkeletonNode& node : made.nodes) {
    const bool near = std::any_of(joints.begin(), joints.end(), [&](Index j) {
      return (truth.nodes[j].position - node.position).norm() < 1.5 * truth.nodes[j].radius;
    });
    if (near) continue;
    sum += distance_in_radii(truth, node.position);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}
}  // namespace

TEST_CASE("a skeleton has the ends and loops and the course of the one that the sample is made round") {
  constexpr Section kSquare = Section::kSquare, kRound = Section::kRound;
  for (const Case& c : std::vector<Case>{{"tee", kNone, kRound},
                                         {"cross", 4, kSquare, true},
                                         {"cross", 6, kSquare},
                                         {"cube-rods", 6, kRound},
                                         {"comb", 5, kSquare},
                                         {"ladder", 3, kRound},
                                         {"lattice", 2, kSquare},
                                         {"table", 4, kSquare},
                                         {"table", 3, kRound},
                                         {"chair"},
                                         {"box"},
                                         {"ellipsoid"},
                                         {"airway", 2},
                                         {"y-tube"},
                                         {"capsule"}}) {
    INFO(c.name << " " << c.count
                << (c.section == kRound    ? " round"
                    : c.section == kSquare ? " square"
                                           : "")
                << (c.sparse ? " sparse" : ""));
    SampleOptions options;
    options.count = c.count;
    options.section = c.section;
    options.sparse = c.sparse;
    const CurveSkeleton truth = sample_truth(c.name, options);
    const CurveSkeleton made = extract_skeleton(to_mesh(make_sample(c.name, options))).skeleton;
    CHECK(count_graph(made).cycles == count_graph(truth).cycles);
    const std::vector<Index> tips = nodes_of_degree(truth, is_leaf), leaves = nodes_of_degree(made, is_leaf);
    CHECK(leaves.size() == tips.size());
    for (const Index tip : tips) {
      double nearest = 1e300;
      for (const Index leaf : leaves)
        nearest = std::min(nearest, (truth.nodes[tip].position - made.nodes[leaf].position).norm());
      INFO("tip at " << truth.nodes[tip].position.transpose());
      CHECK(nearest <= 0.5 * truth.nodes[tip].radius);
    }
    CHECK(mean_distance(truth, made) <= 0.25);
  }
}

TEST_CASE("rails end beyond the last rung, and neither corners of plates nor rough faces are limbs") {
  constexpr Section kSquare = Section::kSquare, kRound = Section::kRound;
  struct Rough {
    const char* name;
    Index count;
    Section section;
    double ratio, jitter;
    bool sparse;
  };
  for (const Rough& c : std::vector<Rough>{{"ladder", 6, kSquare, 0, 0, true},
                                           {"ladder", 6, kRound, 0, 0, true},
                                           {"table", 3, kSquare, 1, 0, false},
                                           {"table", 3, kSquare, 0.7, 0, false},
                                           {"table", 5, kSquare, 1, 0, true},
                                           {"table", 5, kSquare, 0.7, 0, false},
                                           {"table", 6, kSquare, 0.7, 0, true},
                                           {"hammer", kNone, kSquare, 0.2, 0.2, false}}) {
    SampleOptions options;
    options.count = c.count;
    options.section = c.section;
    options.ratio = c.ratio;
    options.jitter = c.jitter;
    options.sparse = c.sparse;
    INFO(c.name << " " << c.count << (c.section == kRound ? " round" : " square") << " " << c.ratio);
    const CurveSkeleton made = extract_skeleton(to_mesh(make_sample(c.name, options))).skeleton;
    CHECK(nodes_of_degree(made, is_leaf).size() ==
          nodes_of_degree(sample_truth(c.name, options), is_leaf).size());
  }
}

TEST_CASE("each tip of a tree whose widths differ by a factor of 20 gets a leaf, and nothing else does") {
  for (const std::uint64_t seed : {1, 20}) {
    SampleOptions options;
    options.seed = seed;
    if (seed == 20) options.count = 20;
    INFO("seed " << seed);
    const CurveSkeleton truth = sample_truth("tree", options);
    const CurveSkeleton made = extract_skeleton(to_mesh(make_sample("tree", options))).skeleton;
    const std::vector<Index> tips = nodes_of_degree(truth, is_leaf), leaves = nodes_of_degree(made, is_leaf);
    CHECK(leaves.size() == tips.size());
    for (const Index tip : tips)
      CHECK(std::any_of(leaves.begin(), leaves.end(), [&](Index leaf) {
        return (truth.nodes[tip].position - made.nodes[leaf].position).norm() <= truth.nodes[tip].radius;
      }));
  }
}
