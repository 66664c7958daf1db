// Arcs end in the middle of open ends, and their radii are the wall's.
#include "mspskel/skeleton/end_at_openings.h"

#include <catch2/catch.hpp>

#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/repair/mend_soup.h"
#include "mspskel/skeleton/surface_map.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// A tube of radius 1 without its ends.
MendedSoup open_tube(double length) {
  const PolygonSoup clean = to_soup(tube(1, length, 24, static_cast<Index>(4 * length)));
  double low = 0, high = 0;
  for (const Vector3& p : clean.points) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  PolygonSoup open;
  open.points = clean.points;
  for (std::size_t f = 0; f < clean.polygon_count(); ++f) {
    const Index* c = clean.corners.data() + 3 * f;
    const double z = (open.points[c[0]] + open.points[c[1]] + open.points[c[2]]).z() / 3;
    if (z > low + 1e-9 && z < high - 1e-9) open.add_triangle(c[0], c[1], c[2]);
  }
  return mend_soup(open);
}

double nearest_leaf(const CurveSkeleton& skeleton, const Vector3& place) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto neighbours = adjacency(skeleton);
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (neighbours[i].size() == 1) nearest = std::min(nearest, (skeleton.nodes[i].position - place).norm());
  return nearest;
}

}  // namespace

TEST_CASE("a tube's skeleton ends at the centres of both openings, with the tube's radius") {
  const double length = GENERATE(3.0, 8.0);
  const MendedSoup mended = open_tube(length);
  REQUIRE(mended.openings.size() == 2);
  ExtractResult result = extract_skeleton(build_mesh(mended.soup));
  const GraphCounts before = count_graph(result.skeleton);
  const BoundingVolumeHierarchy solid(result.surface);
  const OpeningEnds ends = end_at_openings(result.skeleton, result.surface, solid, mended.openings, 0.008);
  REQUIRE(ends.led + ends.added == 2);
  REQUIRE(ends.missing == 0);
  for (const Opening& opening : mended.openings)
    REQUIRE(nearest_leaf(result.skeleton, opening.centre) < 0.05 * opening.radius);
  const GraphCounts after = count_graph(result.skeleton);
  REQUIRE(after.components == before.components);
  REQUIRE(after.cycles == before.cycles);
  REQUIRE(after.leaves == 2);
  for (const SkeletonNode& node : result.skeleton.nodes) {
    REQUIRE(node.radius == Approx(1).epsilon(0.05));
    REQUIRE(solid.inside(result.surface.frame.to_normalised(node.position)));
  }
  REQUIRE(report_surface_map(result.surface, result.skeleton).partition);
}

TEST_CASE("without openings nothing changes") {
  ExtractResult result = extract_skeleton(tube(1, 6, 24, 12));
  const BoundingVolumeHierarchy solid(result.surface);
  const std::size_t nodes = result.skeleton.nodes.size();
  const OpeningEnds ends = end_at_openings(result.skeleton, result.surface, solid, {}, 0.008);
  REQUIRE(ends.led + ends.added + ends.missing == 0);
  REQUIRE(result.skeleton.nodes.size() == nodes);
}
