// Limbs that end in something wider than themselves, or in two lobes.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "mspskel/extract_skeleton.h"
#include "mspskel/samples/skin_graph.h"
#include "support/meshes.h"
#include "support/pipes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

std::vector<Vector3> ends_of(const CurveSkeleton& skeleton) {
  const auto next = adjacency(skeleton);
  std::vector<Vector3> ends;
  for (std::size_t n = 0; n < next.size(); ++n)
    if (next[n].size() == 1) ends.push_back(skeleton.nodes[n].position);
  return ends;
}

}  // namespace

TEST_CASE("A pole between discs ends in the middle of each, however thick and wide they are") {
  for (const double radius : {0.6, 0.9, 1.2})
    for (const double thickness : {0.2, 0.35})
      for (const double edge : {0.08, 0.12}) {
        const std::vector<Vector3> ends =
            ends_of(extract_skeleton(united({{{0, 0, 0}, {0, 0, thickness}, radius},
                                             {{0, 0, 0.1}, {0, 0, 4.1}, 0.1},
                                             {{0, 0, 4}, {0, 0, 4 + thickness}, radius}},
                                            edge))
                        .skeleton);
        CAPTURE(radius, thickness, edge);
        REQUIRE(ends.size() == 2);
        for (const Vector3& end : ends) CHECK(end.head<2>().norm() < 0.15);
      }
}

TEST_CASE("Where a disc carries a pin its pole's arc ends in the pin, and nowhere else") {
  for (const double edge : {0.07, 0.1}) {
    const std::vector<Vector3> ends = ends_of(extract_skeleton(united({{{0, 0, 0}, {0, 0, 0.25}, 0.8},
                                                                       {{0, 0, -0.4}, {0, 0, 4.65}, 0.12},
                                                                       {{0, 0, 4}, {0, 0, 4.25}, 0.8}},
                                                                      edge))
                                                  .skeleton);
    CAPTURE(edge);
    REQUIRE(ends.size() == 2);
    for (const Vector3& end : ends) {
      CHECK(end.head<2>().norm() < 0.15);
      CHECK((end.z() < 0 || end.z() > 4.25));
    }
  }
}

TEST_CASE("Both knobs at the end of a bone have an arc, or none") {
  for (const double knob : {0.9, 1.1, 1.3})
    for (const double apart : {0.7, 0.9, 1.2}) {
      BallGraph bone;
      bone.blend = 0.05;
      bone.nodes = {{{0, 0, 0}, 0.75}, {{0, 0, 8}, 0.75}};
      bone.edges = {{0, 1}};
      for (const double z : {0.0, 8.0})
        for (const double side : {-1.0, 1.0}) {
          bone.edges.emplace_back(z > 0 ? 1 : 0, static_cast<Index>(bone.nodes.size()));
          bone.nodes.push_back({{side * apart, 0, z + (z > 0 ? 0.5 : -0.5)}, knob});
        }
      const std::vector<Vector3> ends = ends_of(extract_skeleton(to_mesh(skin_graph(bone, 4000))).skeleton);
      CAPTURE(knob, apart);
      for (const double z : {0.0, 8.0}) {
        std::vector<double> sides;
        for (const Vector3& end : ends)
          if (std::abs(end.z() - z) < 4) sides.push_back(end.x());
        REQUIRE((sides.size() == 1 || sides.size() == 2));
        if (sides.size() == 1)
          CHECK(std::abs(sides[0]) < 0.3);
        else
          CHECK(sides[0] * sides[1] < 0);
      }
    }
}
