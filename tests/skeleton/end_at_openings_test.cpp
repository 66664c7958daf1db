// Arcs end in the middle of open ends, and their radii are the wall's.
#include "mspskel/skeleton/end_at_openings.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

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

namespace {

// An opening of a given radius round the vertex nearest to a place on the side of a tube about the z axis.
Opening opening_at(const SurfaceSnapshot& surface, const Vector3& at, double radius) {
  Opening opening;
  opening.radius = radius;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    const Vector3 p = surface.frame.to_model(surface.position[v]);
    if (opening.vertex != kNone && (p - at).norm() >= (opening.centre - at).norm()) continue;
    opening.vertex = v;
    opening.centre = p;
  }
  opening.normal = Vector3(opening.centre.x(), opening.centre.y(), 0).normalized();
  return opening;
}

// The sharpest turn at a node with two neighbours, radians.
double sharpest_turn(const CurveSkeleton& skeleton) {
  double sharpest = 0;
  const auto neighbours = adjacency(skeleton);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    if (neighbours[i].size() != 2) continue;
    const Vector3& here = skeleton.nodes[i].position;
    const Vector3 in = here - skeleton.nodes[neighbours[i][0]].position,
                  out = skeleton.nodes[neighbours[i][1]].position - here;
    sharpest = std::max(sharpest, std::atan2(in.cross(out).norm(), in.dot(out)));
  }
  return sharpest;
}

}  // namespace

TEST_CASE("an arc that passes a hole in the side of its end turns into it, and not back") {
  ExtractResult result = extract_skeleton(tube(1, 8, 24, 32));
  const BoundingVolumeHierarchy solid(result.surface);
  double top = 0;
  for (const SkeletonNode& node : result.skeleton.nodes) top = std::max(top, node.position.z());
  const Opening side = opening_at(result.surface, {1, 0, top - 1.2}, 0.9);
  REQUIRE(end_at_openings(result.skeleton, result.surface, solid, {side}, 0.008).led == 1);
  CHECK(nearest_leaf(result.skeleton, side.centre) < 0.05);
  CHECK(count_graph(result.skeleton).leaves == 2);
  CHECK(sharpest_turn(result.skeleton) < 1.1);
  CHECK(report_surface_map(result.surface, result.skeleton).partition);
}

TEST_CASE("an opening without a leaf gets an arc that leaves the ends at other openings alone") {
  ExtractResult result = extract_skeleton(tube(1, 5, 24, 20));
  const BoundingVolumeHierarchy solid(result.surface);
  double top = 0;
  for (const SkeletonNode& node : result.skeleton.nodes) top = std::max(top, node.position.z());
  const std::vector<Opening> openings{opening_at(result.surface, {1, 0, top - 0.5}, 1),
                                      opening_at(result.surface, {0.75, 0.66, top - 0.5}, 1)};
  REQUIRE(end_at_openings(result.skeleton, result.surface, solid, openings, 0.008).added == 1);
  for (const Opening& opening : openings) CHECK(nearest_leaf(result.skeleton, opening.centre) < 0.05);
  CHECK(count_graph(result.skeleton).leaves == 3);
  const auto neighbours = adjacency(result.skeleton);
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    if (neighbours[i].size() > 2)
      CHECK((result.skeleton.nodes[i].position - openings[0].centre).norm() > 0.75);
}

TEST_CASE("without openings nothing changes") {
  ExtractResult result = extract_skeleton(tube(1, 6, 24, 12));
  const BoundingVolumeHierarchy solid(result.surface);
  const std::size_t nodes = result.skeleton.nodes.size();
  const OpeningEnds ends = end_at_openings(result.skeleton, result.surface, solid, {}, 0.008);
  REQUIRE(ends.led + ends.added + ends.missing == 0);
  REQUIRE(result.skeleton.nodes.size() == nodes);
}
