#include "mspskel/center/skeleton_mesh.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/slice/minimum_slice_perimeter.h"
#include "mspskel/slice/plane_search.h"
#include "mspskel/slice/slice_error.h"
#include "support/meshes.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

constexpr SkeletalPointMethod kMethods[] = {
    SkeletalPointMethod::kCentre,    SkeletalPointMethod::kSampledForce, SkeletalPointMethod::kClosedForm,
    SkeletalPointMethod::kAreaField, SkeletalPointMethod::kVisibleField, SkeletalPointMethod::kNearestValley};

struct Sliced {
  SurfaceSnapshot surface;
  SliceTracer tracer;
  VertexSlices slices;

  explicit Sliced(const DefaultMesh& mesh) : surface(make_snapshot(mesh)), tracer(surface) {
    slices = compute_minimum_slice_perimeters(tracer, {});
    compute_slice_errors(tracer, {}, slices);
  }
  Vector3 model(const Vector3& x) const { return surface.frame.to_model(x); }
};

SkeletonMeshOptions with(SkeletalPointMethod method, HoleSearch holes = HoleSearch::kIgnore) {
  SkeletonMeshOptions options;
  options.point.method = method;
  options.holes = holes;
  return options;
}

// A tube with a closed cavity along its axis: the inner shell faces the other way.
DefaultMesh hollow_tube(double outer, double inner, const Vector3& shift) {
  PolygonSoup soup = to_soup(tube(outer, 12, 24, 24));
  const PolygonSoup core = to_soup(translated(tube(inner, 10, 24, 20), Vector3(0, 0, 1) + shift));
  const auto base = static_cast<Index>(soup.points.size());
  soup.points.insert(soup.points.end(), core.points.begin(), core.points.end());
  for (std::size_t f = 0; f < core.polygon_count(); ++f) {
    const Index* c = &core.corners[core.begin[f]];
    soup.add_triangle(base + c[0], base + c[2], base + c[1]);
  }
  return to_mesh(soup);
}

}  // namespace

TEST_CASE("skeletal points of a tube lie within one percent of its axis") {
  const DefaultMesh mesh = rotated(tube(1, 12, 24, 24), {1, 2, 3}, 0.7);
  const Vector3 axis = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()) * Vector3::UnitZ();
  const Sliced s(mesh);
  for (auto method : kMethods) {
    const SkeletonMesh skeleton = make_skeleton_mesh(s.tracer, s.slices, with(method));
    double worst = 0;
    for (Index v = 0; v < s.surface.vertex_count(); ++v) {
      const double z = axis.dot(s.model(s.surface.position[v]));
      if (z < 2 || z > 10) continue;  // nearer the caps a slice through the length may be shorter
      REQUIRE(skeleton.valid[v]);
      worst = std::max(worst, axis.cross(s.model(skeleton.position[v])).norm());
    }
    CAPTURE(static_cast<int>(method));
    CHECK(worst < 0.01);
  }
}

TEST_CASE("skeletal points of a torus lie on its core circle") {
  const Sliced s(torus(4, 1, 36, 16));
  for (auto method : kMethods) {
    const SkeletonMesh skeleton = make_skeleton_mesh(s.tracer, s.slices, with(method));
    double worst = 0;
    for (const Vector3& x : skeleton.position) {
      const Vector3 p = s.model(x);
      worst = std::max(worst, std::hypot(std::hypot(p.x(), p.y()) - 4, p.z()));
    }
    CAPTURE(static_cast<int>(method));
    CHECK(worst < 0.1);
  }
}

TEST_CASE("hole contours of the same plane are found and repel") {
  for (const Vector3& shift : {Vector3(0, 0, 0), Vector3(0.3, 0, 0)}) {
    const Sliced s(hollow_tube(1, 0.5, shift));
    const BoundingVolumeHierarchy solid(s.surface);
    for (auto holes : {HoleSearch::kProbe, HoleSearch::kAll}) {
      SkeletonMeshOptions options = with(SkeletalPointMethod::kClosedForm, holes);
      if (shift.x() > 0) options.method_with_holes = SkeletalPointMethod::kClosedForm;
      options.solid = &solid;
      const SkeletonMesh skeleton = make_skeleton_mesh(s.tracer, s.slices, options);
      CHECK(skeleton.with_holes > 0);
      for (Index v = 0; v < s.surface.vertex_count(); ++v) {
        const double z = s.model(s.surface.position[v]).z();
        if (s.surface.component[v] != 0 || z < 3 || z > 9) continue;
        CAPTURE(v, s.model(skeleton.position[v]).transpose());
        CHECK(solid.inside(skeleton.position[v]));
        CHECK((s.model(skeleton.position[v]) - shift).head<2>().norm() > 0.5);
      }
    }
    const SkeletonMesh blind = make_skeleton_mesh(s.tracer, s.slices, with(SkeletalPointMethod::kClosedForm));
    CHECK(blind.with_holes == 0);
  }
}

TEST_CASE("a slice's region has the contour's perimeter and area and starts at its vertex") {
  const Sliced s(torus(3, 1, 24, 13));
  for (Index v = 0; v < s.surface.vertex_count(); v += 7) {
    SliceRegion slice;
    slice.plane = {s.slices.normal[v], s.slices.normal[v].dot(s.surface.position[v])};
    slice.through = v;
    REQUIRE(slice_contour(s.tracer, s.slices, v, slice.contour));
    flatten_slice(s.surface, slice);
    CHECK(slice.region.perimeter() == Approx(slice.contour.perimeter));
    CHECK(slice.region.area() == Approx(slice.contour.area));
    CHECK((slice.frame.to_space(slice.region.point(0)) - s.surface.position[v]).norm() < 1e-12);
    CHECK((slice.frame.to_space(slice.region.contour_centroid()) - s.slices.centre[v]).norm() < 1e-12);
  }
}

TEST_CASE("a contour that comes to its vertex twice gives the same region wherever its walk begins") {
  const SurfaceSnapshot surface = make_snapshot(saddle(2, 25, 6));
  const SliceTracer tracer(surface);
  // The level through the saddle: two loops above it, joined there.
  const Vector3 up = Vector3::UnitZ();
  const Plane plane{up, up.dot(surface.position[0])};
  const auto above = [&](Index v) { return v == 0 || up.dot(surface.position[v]) >= plane.offset; };
  std::vector<SliceRegion> slices;
  Index h = surface.vertex_halfedge[0];
  do {
    if (above(surface.target(h)) && !above(surface.apex(h))) {
      SliceRegion slice;
      slice.plane = plane;
      slice.through = 0;
      tracer.trace(surface.twin[SurfaceSnapshot::next(h)], plane, 0, slice.contour);
      flatten_slice(surface, slice);
      CHECK(slice.region.perimeter() == Approx(slice.contour.perimeter));
      CHECK(slice.region.area() == Approx(slice.contour.area));
      slices.push_back(slice);
    }
    h = surface.next_outgoing(h);
  } while (h != surface.vertex_halfedge[0]);
  REQUIRE(slices.size() == 2);
  const PlanarRegion &a = slices[0].region, &b = slices[1].region;
  REQUIRE(a.rings()[0].points == b.rings()[0].points);
  for (Index i = 0; i < a.rings()[0].points; ++i)
    CHECK((slices[0].frame.to_space(a.point(i)) - slices[1].frame.to_space(b.point(i))).norm() < 1e-12);
}

TEST_CASE("vertices without a slice take their neighbours' mean and no confidence") {
  Sliced s(tube(1, 8, 16, 16));
  const Index lost = 5 * 16 + 3;
  const auto drop = [&](Index v) {
    s.slices.valid[v] = 0;
    s.slices.perimeter[v] = 0;
    s.slices.error[v] = 1;
    s.slices.normal[v].setZero();
  };
  drop(lost);
  const SkeletonMesh skeleton = make_skeleton_mesh(s.tracer, s.slices);
  Vector3 sum = Vector3::Zero();
  Index count = 0;
  Index h = s.surface.vertex_halfedge[lost];
  do {
    sum += skeleton.position[s.surface.target(h)];
    ++count;
    h = s.surface.next_outgoing(h);
  } while (h != s.surface.vertex_halfedge[lost]);
  CHECK((skeleton.position[lost] - sum / count).norm() < 1e-12);
  CHECK_FALSE(skeleton.valid[lost]);
  CHECK(skeleton.error[lost] == 1);
  CHECK(skeleton.without_slice >= 1);

  for (Index v = 0; v < s.surface.vertex_count(); ++v) drop(v);
  const SkeletonMesh none = make_skeleton_mesh(s.tracer, s.slices);
  CHECK(none.without_slice == s.surface.vertex_count());
  for (Index v = 0; v < s.surface.vertex_count(); ++v) CHECK(none.position[v] == s.surface.position[v]);
}

TEST_CASE("areas sum to the surface's, and threads do not change a bit") {
  const Sliced s(torus(3, 1, 30, 14));
  Execution one, two;
  one.threads = 1;
  two.threads = 2;
  for (auto method : kMethods) {
    const SkeletonMesh a = make_skeleton_mesh(s.tracer, s.slices, with(method), one);
    const SkeletonMesh b = make_skeleton_mesh(s.tracer, s.slices, with(method), two);
    double area = 0, faces = 0;
    for (const double x : a.area) area += x;
    for (Index f = 0; f < s.surface.face_count(); ++f)
      faces += s.surface.face_normal_times_twice_area(f).norm() / 2;
    CHECK(area == Approx(faces));
    for (Index v = 0; v < a.vertex_count(); ++v) REQUIRE(a.position[v] == b.position[v]);
    CHECK(a.iterations == b.iterations);
    CHECK(a.stops == b.stops);
  }
}

// A slice of a sponge has as many holes as its size is squared. Work is counted, not time.
TEST_CASE("slices of a sponge cost no contours of holes that grow with it") {
  double points_per_vertex[2];
  for (const int k : {0, 1}) {
    const int n = k == 0 ? 5 : 9;
    const SurfaceSnapshot surface = snapshot_of(foam({n, n, n}), 1);
    const SliceTracer tracer(surface);
    const BoundingVolumeHierarchy solid(surface);
    VertexSlices slices = search_minimum_slice_perimeters(tracer, {});
    compute_slice_errors(tracer, {}, slices);
    SkeletonMeshOptions options = with(SkeletalPointMethod::kAreaField, HoleSearch::kProbe);
    options.solid = &solid;
    const SkeletonMesh mesh = make_skeleton_mesh(tracer, slices, options);
    CHECK(mesh.with_holes > mesh.vertex_count() / 8);
    Index inside = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) inside += solid.inside(mesh.position[v]);
    CHECK(inside > 0.97 * mesh.vertex_count());
    points_per_vertex[k] = static_cast<double>(mesh.hole_points) / mesh.vertex_count();
  }
  INFO("points of holes a vertex: " << points_per_vertex[0] << ", " << points_per_vertex[1]);
  CHECK(points_per_vertex[1] < 2 * points_per_vertex[0] + 1);
}

TEST_CASE("making the skeleton mesh can be cancelled") {
  const Sliced s(torus(3, 1, 30, 14));
  Execution execution;
  execution.threads = 1;
  execution.progress = [](const char*, double fraction) { return fraction == 0; };
  CHECK_THROWS_AS(make_skeleton_mesh(s.tracer, s.slices, {}, execution), Cancelled);
}
