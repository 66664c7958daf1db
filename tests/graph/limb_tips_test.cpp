// The tips of limbs: as many as there are limbs, at their ends, whatever the pose, the place and the
// triangles.
#include "mspskel/graph/limb_tips.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "graph/solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

std::vector<LimbTip> tips_of(const Solid& solid, double significance = PruningOptions().significance) {
  PruningOptions options;
  options.significance = significance;
  return find_limb_tips(solid.surface, solid.hierarchy, solid.slices(), options);
}

}  // namespace

TEST_CASE("Each limb of a tripod has a tip at its end") {
  const BallGraph limbs = tripod();
  for (const Index vertices : {400, 1200, 4000}) {
    const Solid solid(to_mesh(skin_graph(limbs, vertices)));
    const std::vector<LimbTip> tips = tips_of(solid);
    REQUIRE(tips.size() == 3);
    std::set<Index> reached;
    for (const LimbTip& tip : tips) {
      const Vector3 at = solid.model(solid.surface.position[tip.vertex]);
      for (Index i = 1; i < 4; ++i)
        if ((at - limbs.nodes[i].position).norm() < 1.1 * limbs.nodes[i].radius) reached.insert(i);
      CHECK(tip.significance.depth > 0.2);
      CHECK_FALSE(tip.cap.empty());
    }
    CHECK(reached.size() == 3);
  }
}

TEST_CASE("Samples have the tips that they were made with") {
  CHECK(tips_of(Solid(sample("octoped", 3000))).size() == 9);
  CHECK(tips_of(Solid(sample("y-tube", 1500))).size() == 3);
  CHECK(tips_of(Solid(sample("capsule", 1000))).size() == 2);
}

TEST_CASE("A shape without limbs has the ends of its longest way, of no depth") {
  const Solid solid(sphere(500));
  const std::vector<LimbTip> tips = tips_of(solid);
  REQUIRE(tips.size() == 2);
  for (const LimbTip& tip : tips) {
    CHECK(tip.significance.depth == 0);
    CHECK_FALSE(tip.cap.empty());
  }
  const auto at = [&](int i) { return solid.surface.position[tips[i].vertex].normalized(); };
  CHECK(at(0).dot(at(1)) < -0.95);
}

TEST_CASE("Fewer tips are significant where more is asked") {
  const Solid solid(to_mesh(skin_graph(tripod(), 1200)));
  std::size_t before = solid.surface.position.size();
  for (const double significance : {0.01, 0.3, 1.0, 3.0, 10.0, 100.0}) {
    const std::vector<LimbTip> tips = tips_of(solid, significance);
    const auto limbs = static_cast<std::size_t>(std::count_if(
        tips.begin(), tips.end(), [](const LimbTip& tip) { return tip.significance.depth > 0; }));
    CHECK(limbs <= before);
    before = limbs;
  }
  CHECK(before == 0);
}

TEST_CASE("Tips stay the same vertices when the model is turned, moved and scaled") {
  const DefaultMesh mesh = sample("octoped", 2600);
  const DefaultMesh moved = translated(scaled(rotated(mesh, {0.3, -0.8, 0.5}, 1.1), 37.5), {10, -20, 5});
  std::set<Index> here, there;
  for (const LimbTip& tip : tips_of(Solid(mesh))) here.insert(tip.vertex);
  for (const LimbTip& tip : tips_of(Solid(moved))) there.insert(tip.vertex);
  CHECK(here == there);
}

TEST_CASE("Pieces have tips of their own, and nothing to measure gives none") {
  const Solid rings(sample("hopf-link", 2000));
  PruningOptions all;
  all.significance = 0;
  all.smallest = 0;
  std::set<Index> components;
  for (const LimbTip& tip : find_limb_tips(rings.surface, rings.hierarchy, rings.slices(), all))
    components.insert(rings.surface.component[tip.vertex]);
  CHECK(static_cast<Index>(components.size()) == rings.surface.component_count);
  CHECK(find_limb_tips(rings.surface, rings.hierarchy, rings.no_slices(), all).empty());
}
