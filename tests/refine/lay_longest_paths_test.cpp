// Bent bodies, plates and bowls: a skeleton as long as they are, or a word.
#include "mspskel/refine/lay_longest_paths.h"

#include <catch2/catch.hpp>

#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/component_extents.h"
#include "mspskel/skeleton/check_skeleton.h"
#include "mspskel/skeleton/useless_pieces.h"
#include "mspskel/solid/detail/inner_graph.h"
#include "support/solids.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

using Planes = std::array<std::map<double, double>, 3>;

const std::vector<std::vector<std::string>>& profiles() {
  static const std::vector<std::vector<std::string>> all{
      {"x.x", "x.x", "xxx"},  // U
      {"x..", "x..", "xxx"},  // L
      {"xxx", ".x.", ".x."},  // T
      {"x.x", "xxx", "x.x"},  // H
      {".x.", "xxx", ".x."},  // plus
  };
  return all;
}

DefaultMesh random_profile(const std::vector<std::string>& rows, test::Random& random) {
  constexpr int kFine = 3;
  Planes place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double at = 0;
    for (int plane = 0; plane <= (axis < 2 ? 3 : 1); ++plane) {
      place[axis][plane] = at;
      at += std::exp(random.uniform(std::log(0.08), std::log(3.0)));
    }
  }
  return to_mesh(with_planes_at(boundary(drawn(rows), kFine), kFine, place));
}

// The longest way of a branch between two of its nodes that lie in one ball, in radii of that ball.
double longest_return(const CurveSkeleton& skeleton, const SurfaceSnapshot& surface,
                      const BoundingVolumeHierarchy& solid) {
  double longest = 0;
  for (const Branch& branch : branches(skeleton)) {
    std::vector<Vector3> at;
    std::vector<double> walked;
    for (const Index node : branch.nodes) {
      const Vector3 x = surface.frame.to_normalised(skeleton.nodes[node].position);
      walked.push_back(at.empty() ? 0.0 : walked.back() + (x - at.back()).norm());
      at.push_back(x);
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      const double radius = solid.distance(at[i]);
      for (std::size_t j = 0; j < at.size(); ++j)
        if ((at[j] - at[i]).norm() < radius)
          longest = std::max(longest, std::abs(walked[j] - walked[i]) / radius);
    }
  }
  return longest;
}

// It has a length, keeps off the surface, does not wind, and nothing is wrong with it.
void check_useful(const DefaultMesh& mesh) {
  const ExtractResult result = extract_skeleton(mesh);
  CHECK(result.warnings.empty());
  const BoundingVolumeHierarchy solid(result.surface);
  const SkeletonChecks checks = check_skeleton(result.surface, solid, result.skeleton);
  CHECK(checks.topology);
  CHECK(checks.contained);
  CHECK(checks.length * checks.diagonal >= kLeastPieceLength * result.surface.frame.scale);
  CHECK(longest_return(result.skeleton, result.surface, solid) < 4);
  for (const SkeletonNode& node : result.skeleton.nodes) {
    CHECK(node.position.allFinite());
    CHECK(node.radius > 1e-6 * result.surface.frame.scale);
  }
}

}  // namespace

TEST_CASE("Random U, L, T, H and plus profiles have skeletons as long as they are") {
  test::Random random(15);
  for (int round = 0; round < 8; ++round)
    for (const auto& rows : profiles()) {
      CAPTURE(rows, round);
      check_useful(random_profile(rows, random));
    }
}

TEST_CASE("Ways to ends round a corner stay inside") {
  // A thin plus: its long arm starts beside the middle of what carries it.
  const Planes place{{{{0, 0}, {1, 1.82}, {2, 4.32}, {3, 4.52}},
                      {{0, 0}, {1, 0.106}, {2, 0.186}, {3, 0.825}},
                      {{0, 0}, {1, 0.071}}}};
  const DefaultMesh mesh = to_mesh(with_planes_at(boundary(drawn(profiles()[4]), 2), 2, place));
  check_useful(mesh);
  double least = 1;
  for (const SkeletonNode& node : extract_skeleton(mesh).skeleton.nodes)
    least = std::min(least, node.position.x());
  CHECK(least < 0.1);
}

TEST_CASE("Grooves between sheets are no vessels, however deep or long they are") {
  const Planes angle{{{{0, 0}, {1, 0.08}, {2, 0.32}, {3, 1.07}},
                      {{0, 0}, {1, 0.08}, {2, 0.95}, {3, 1.03}},
                      {{0, 0}, {1, 2.1}}}};
  const Planes tee{{{{0, 0}, {1, 0.18}, {2, 0.24}, {3, 1.05}},
                    {{0, 0}, {1, 1.19}, {2, 1.44}, {3, 1.5}},
                    {{0, 0}, {1, 1.9}}}};
  const Planes channel{
      {{{0, 0}, {1, 0.11}, {2, 0.3}, {3, 0.5}}, {{0, 0}, {1, 0.6}, {2, 0.8}, {3, 2.2}}, {{0, 0}, {1, 7.7}}}};
  for (const int fine : {1, 4}) {
    check_useful(to_mesh(with_planes_at(boundary(drawn(profiles()[1]), fine), fine, angle)));
    check_useful(to_mesh(with_planes_at(boundary(drawn(profiles()[2]), fine), fine, tee)));
    check_useful(to_mesh(with_planes_at(boundary(drawn(profiles()[0]), fine), fine, channel)));
  }
}

TEST_CASE("The path of a channel does not wind between its walls") {
  const Planes place{
      {{{0, 0}, {1, 0.5}, {2, 3.5}, {3, 4}}, {{0, 0}, {1, 1}, {2, 2}, {3, 3}}, {{0, 0}, {1, 4}}}};
  for (const int fine : {1, 2, 4})
    check_useful(to_mesh(with_planes_at(boundary(drawn(profiles()[0]), fine), fine, place)));
  // Of the one with the fewest vertices it goes up both walls, from the base whose middle is at y = 2.5.
  std::array<double, 2> least{3, 3};
  for (const SkeletonNode& node :
       extract_skeleton(to_mesh(with_planes_at(boundary(drawn(profiles()[0])), 1, place))).skeleton.nodes)
    for (const int wall : {0, 1})
      if (std::abs(node.position.x() - (wall == 0 ? 0.25 : 3.75)) < 0.25)
        least[wall] = std::min(least[wall], node.position.y());
  CHECK(least[0] < 1.6);
  CHECK(least[1] < 1.6);
}

TEST_CASE("A plate has a skeleton as long as it is wide") {
  const Planes place{{{{0, 0}, {1, 1}}, {{0, 0}, {1, 1}}, {{0, 0}, {1, 0.01}}}};
  check_useful(to_mesh(with_planes_at(boundary(drawn({"x"}), 4), 4, place)));
}

TEST_CASE("A body whose centroid lies in its surface has finite numbers and a length") {
  // A base of height 1 over the whole width of 4, arms of width 1 and height √2 on it: the centroid is in the
  // base's upper face.
  const double base = 1, arm = std::sqrt(2.0);
  const Planes place{{{{0, 0}, {1, 1}, {2, 3}, {3, 4}},
                      {{0, 0}, {1, arm / 2}, {2, arm}, {3, arm + base}},
                      {{0, 0}, {1, 5}}}};
  for (const int fine : {1, 3})
    check_useful(to_mesh(with_planes_at(boundary(drawn(profiles()[0]), fine), fine, place)));
}

TEST_CASE("A stub gives way to a path from end to end; what is long enough stays") {
  const Solid bar(prism(6, 20, 30));
  detail::InnerGraph inner(bar.surface, bar.hierarchy);
  const auto arc_between = [&](double from, double to) {
    ArcGraph graph;
    graph.add_hub(bar.at({0, 0, from}));
    graph.add_hub(bar.at({0, 0, to}));
    graph.arcs.push_back({{0, 1}, graph.hub_position, true});
    graph.arc_of_vertex.assign(bar.surface.position.size(), 0);
    graph.hub_of_vertex.assign(bar.surface.position.size(), kNone);
    return graph;
  };
  ArcGraph stub = arc_between(9, 10);
  REQUIRE(lay_longest_paths(stub, inner, {false}, 0.008) == 1);
  CHECK(homotopy_type(stub) == ArcGraphType{1, 0});
  const Arc& path = stub.arcs.back();
  CHECK(arc_length(path) * bar.surface.frame.scale > 16);
  for (std::size_t i = 1; i < path.points.size(); ++i)
    CHECK_FALSE(bar.hierarchy.segment_crosses(path.points[i - 1], path.points[i]));
  ArcGraph whole = arc_between(2, 18);
  CHECK(lay_longest_paths(whole, inner, {false}, 0.008) == 0);
}

TEST_CASE("Stubs and nodes on the surface are told by component") {
  SurfaceSnapshot surface = make_snapshot(prism(6, 20, 30));
  CurveSkeleton skeleton;
  const auto node = [](double z, double radius) {
    SkeletonNode n;
    n.position = {0, 0, z};
    n.radius = radius;
    return n;
  };
  skeleton.nodes = {node(5, 0.8), node(15, 0.8)};
  skeleton.edges = {{0, 1}};
  skeleton.node_of_vertex.assign(surface.position.size(), 0);
  CHECK(component_extents(surface)[0] == Approx(1));
  CHECK(find_useless_pieces(surface, skeleton).stubs == 0);
  CHECK(find_useless_pieces(surface, skeleton).on_surface == 0);
  skeleton.nodes[1] = node(6, 0);
  CHECK(find_useless_pieces(surface, skeleton).stubs == 1);
  CHECK(find_useless_pieces(surface, skeleton).on_surface == 1);
}

TEST_CASE("A sheet without thickness has no skeleton in it, and is said to have none") {
  const ExtractResult sheet =
      extract_skeleton(moved(cube(), [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); }));
  CHECK_FALSE(sheet.warnings.empty());
}
