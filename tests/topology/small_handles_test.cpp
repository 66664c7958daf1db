// Small handles: whose short loops are filled, what the labels that are left tell apart, and that the
// finished skeleton has the other cycles and no more.
#include <catch2/catch.hpp>

#include "mspskel/collapse/crossing_labels.h"
#include "mspskel/collapse/topology_certificate.h"
#include "mspskel/extract_skeleton.h"
#include "topology/certificate_of.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

// A frame of bars three cells wide, with a hole of one cell in the middle of one of them.
const std::vector<std::string> kFrame{"xxxxxxxxxxx", "xxxxxxxxxxx", "xxxxxxxxxxx", "xxx     xxx",
                                      "xxx     xxx", "x x     xxx", "xxx     xxx", "xxx     xxx",
                                      "xxxxxxxxxxx", "xxxxxxxxxxx", "xxxxxxxxxxx"};

SurfaceSnapshot frame_with_hole() { return snapshot_of(drawn(kFrame), 1, 0.0); }

CocycleOptions leaving_out(double cells, const SurfaceSnapshot& s, bool slices = true) {
  CocycleOptions options;
  options.smallest_handle = cells / s.frame.scale;
  options.use_discs = options.use_holed_regions = slices;
  return options;
}

Vector3 cell(const SurfaceSnapshot& s, double x, double y) {
  return s.frame.to_normalised(Vector3(x + 0.5, y + 0.5, 0.45));
}

std::vector<Vector3> round_the_frame(const SurfaceSnapshot& s, double left) {
  return {cell(s, left, 1), cell(s, 9, 1), cell(s, 9, 9), cell(s, left, 9), cell(s, left, 1)};
}

Index genus_of(const SurfaceSnapshot& s) {
  Index genus = 0;
  for (const Index twice : twice_euler_characteristics(s)) genus += (4 - twice) / 4;
  return genus;
}

}  // namespace

TEST_CASE("a handle is small if a shorter loop goes round it") {
  const SurfaceSnapshot s = frame_with_hole();
  for (const bool slices : {true, false}) {
    CHECK(compute_volume_cocycles(s, {}, leaving_out(3.9, s, slices)).rank == 2);
    const VolumeCocycles one = compute_volume_cocycles(s, {}, leaving_out(4.1, s, slices));
    CHECK(one.rank == 1);
    REQUIRE(one.small_handles.size() == 1);
    CHECK(one.small_handles[0].length * s.frame.scale == Approx(4));
    const Vector3 at = s.frame.to_model(one.small_handles[0].at);
    CHECK((at.x() >= 1 && at.x() <= 2 && at.y() >= 5 && at.y() <= 6));
    CHECK(compute_volume_cocycles(s, {}, leaving_out(15, s, slices)).rank == 1);
  }
}

TEST_CASE("the labels that are left are closed, and equal on both sides of a small handle") {
  const SurfaceSnapshot s = frame_with_hole();
  for (const bool slices : {true, false}) {
    const VolumeCocycles cocycles = compute_volume_cocycles(s, {}, leaving_out(4.1, s, slices));
    for (Index f = 0; f < s.face_count(); ++f)
      CHECK((cocycles.label[3 * f] + cocycles.label[3 * f + 1] + cocycles.label[3 * f + 2]).is_zero());
    const CrossingLabels label(cocycles);
    REQUIRE(label.rank() == 1);
    const CocycleLabel left = label.along(round_the_frame(s, 0)), right = label.along(round_the_frame(s, 2));
    CHECK_FALSE(left.is_zero());
    CHECK(left == right);
    CHECK(label.along({cell(s, 0, 4), cell(s, 2, 4), cell(s, 2, 6), cell(s, 0, 6), cell(s, 0, 4)}).is_zero());
  }
}

TEST_CASE("a thin ring is no small handle") {
  const SurfaceSnapshot s = make_snapshot(torus(1, 0.02, 100, 6));
  CocycleOptions options;
  options.smallest_handle = 0.9;
  CHECK(compute_volume_cocycles(s, {}, options).rank == 1);
}

TEST_CASE("skeletons have all other cycles, and the certificate counts the small handles") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    mspskel::test::Random random(seed);
    VoxelSolid solid;
    solid.box({-1, -1, -1}, {4, 4, 3});
    solid.remove(random_lattice(2, 0.9, random));
    const SurfaceSnapshot s = snapshot_of(solid, 1, 0.1, seed);
    Index before = 0;
    for (const double share : {0.4, 0.8}) {
      ExtractOptions options = default_options();
      options.coarsening.vertices = 300;
      options.execution.threads = 1;
      options.cocycles.smallest_handle = share;
      options.cocycles.use_discs = options.cocycles.use_holed_regions = seed % 2 == 0;
      const ExtractResult result = extract_skeleton_of_snapshot(s, options);
      const TopologyCertificate certificate = certificate_of(result);
      INFO("seed " << seed << ", share " << share << ": " << certificate.reason);
      CHECK(certificate.verdict == TopologyVerdict::kProved);
      CHECK(certificate.b1 == genus_of(s) - certificate.small_handles);
      CHECK(certificate.crossing_rank == certificate.b1);
      CHECK(certificate.small_handles >= before);
      before = certificate.small_handles;
    }
    CHECK(before > 0);
  }
}

TEST_CASE("each component has small handles by its own extent") {
  PolygonSoup soup = boundary(drawn(kFrame));
  const PolygonSoup ring = boundary(drawn({"xxx", "x x", "xxx"}));
  const auto first = static_cast<Index>(soup.points.size());
  for (const Vector3& p : ring.points) soup.points.push_back(p + Vector3(30, 0, 0));
  for (std::size_t i = 0; i < ring.corners.size(); i += 3)
    soup.add_triangle(first + ring.corners[i], first + ring.corners[i + 1], first + ring.corners[i + 2]);
  ExtractOptions options = default_options();
  options.cocycles.smallest_handle = 0.5;  // the ring's loop is longer than it is wide
  const ExtractResult result = extract_skeleton(to_mesh(soup), options);
  CHECK(result.cocycles.genus == std::vector<Index>{2, 1});
  CHECK(result.cocycles.rank == 2);
  const TopologyCertificate certificate = certificate_of(result);
  INFO(certificate.reason);
  CHECK(certificate.verdict == TopologyVerdict::kProved);
  CHECK(certificate.small_handles == 1);
  // The same by the whole surface.
  CHECK(compute_volume_cocycles(result.surface, {}, options.cocycles).rank == 2);
}
