// Parts are a connected partition of the surface, follow the shape, and turn along with it.
#include "mspskel/segment/segment_surface.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "mspskel/base/error.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/segment/smooth_borders.h"
#include "support/meshes.h"

using namespace mspskel;

namespace {

struct Shape {
  SurfaceSnapshot surface;
  CurveSkeleton skeleton;
};

Shape shape_of(const PolygonSoup& soup) {
  ExtractResult result = extract_skeleton(test::to_mesh(soup));
  return {std::move(result.surface), std::move(result.skeleton)};
}
Shape sample(const std::string& name) { return shape_of(make_sample(name)); }

Index pieces_of(const SurfaceSnapshot& surface, const std::vector<Index>& part) {
  std::vector<char> seen(part.size(), 0);
  Index pieces = 0;
  for (Index start = 0; start < surface.face_count(); ++start) {
    if (seen[start]) continue;
    ++pieces;
    std::vector<Index> stack{start};
    seen[start] = 1;
    while (!stack.empty()) {
      const Index f = stack.back();
      stack.pop_back();
      for (Index h = 3 * f; h < 3 * f + 3; ++h) {
        const Index g = surface.twin[h] / 3;
        if (seen[g] || part[g] != part[f]) continue;
        seen[g] = 1;
        stack.push_back(g);
      }
    }
  }
  return pieces;
}

// 1 - Rand index.
double disagreement(const std::vector<Index>& a, const std::vector<Index>& b) {
  std::int64_t different = 0, pairs = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < i; ++j, ++pairs) different += (a[i] == a[j]) != (b[i] == b[j]) ? 1 : 0;
  return static_cast<double>(different) / static_cast<double>(pairs);
}

}  // namespace

TEST_CASE("parts are connected, and every number up to the count is used") {
  for (const char* name : {"quadruped", "capsule", "cup", "torus", "y-tube", "octoped"}) {
    INFO(name);
    const Shape shape = sample(name);
    const Segmentation parts = segment_surface(shape.surface, shape.skeleton);
    const std::set<Index> used(parts.part_of_face.begin(), parts.part_of_face.end());
    CHECK(static_cast<Index>(used.size()) == parts.count);
    CHECK(*used.begin() == 0);
    CHECK(*used.rbegin() == parts.count - 1);
    CHECK(pieces_of(shape.surface, parts.part_of_face) == parts.count);
  }
}

TEST_CASE("a tube has one part, a body one for each limb besides its own") {
  CHECK(segment_surface(sample("capsule").surface, sample("capsule").skeleton).count == 1);
  CHECK(segment_surface(sample("torus").surface, sample("torus").skeleton).count == 1);
  const Shape beast = sample("quadruped");
  CHECK(segment_surface(beast.surface, beast.skeleton).count >= 6);
}

TEST_CASE("a wanted count is met where the skeleton can be cut so often") {
  const Shape shape = sample("quadruped");
  for (const Index count : {1, 2, 5, 12}) {
    SegmentOptions options;
    options.parts.count = count;
    CHECK(segment_surface(shape.surface, shape.skeleton, options).count == count);
  }
}

TEST_CASE("parts turn along with the shape") {
  const PolygonSoup soup = make_sample("quadruped");
  PolygonSoup turned = soup;
  const Eigen::AngleAxisd turn(1.1, Vector3(1, 2, -1).normalized());
  for (Vector3& p : turned.points) p = 30 * (turn * p) + Vector3(5, 6, 7);
  const Shape a = shape_of(soup), b = shape_of(turned);
  CHECK(disagreement(segment_surface(a.surface, a.skeleton).part_of_face,
                     segment_surface(b.surface, b.skeleton).part_of_face) < 0.05);
}

TEST_CASE("stray pieces of a part join what surrounds them") {
  const SurfaceSnapshot surface = make_snapshot(test::to_mesh(make_sample("capsule")));
  std::vector<Index> part(surface.face_count());
  for (Index f = 0; f < surface.face_count(); ++f)
    part[f] = surface.position[surface.origin[3 * f]].z() > 0 ? 1 : 0;
  std::vector<Index> stray = part;
  for (Index f = 0; f < surface.face_count(); f += 37) stray[f] = 2 + f % 2;
  connect_parts(surface, stray);
  const std::set<Index> used(stray.begin(), stray.end());
  CHECK(pieces_of(surface, stray) == static_cast<Index>(used.size()));
}

TEST_CASE("a ragged border becomes the shorter one") {
  const SurfaceSnapshot surface = make_snapshot(test::to_mesh(make_sample("capsule")));
  std::vector<Index> part(surface.face_count());
  const auto length = [&] {
    double sum = 0;
    for (Index h = 0; h < surface.halfedge_count(); ++h)
      if (part[h / 3] < part[surface.twin[h] / 3])
        sum += (surface.position[surface.target(h)] - surface.position[surface.origin[h]]).norm();
    return sum;
  };
  // Across the capsule's length, up and down by half a radius.
  Vector3 low = surface.position[0], high = low;
  for (const Vector3& p : surface.position) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const Eigen::Index side = (axis + 1) % 3;
  for (Index f = 0; f < surface.face_count(); ++f) {
    const Vector3 p = surface.position[surface.origin[3 * f]];
    part[f] = p[axis] > 0.5 * (low[axis] + high[axis]) + 0.4 * p[side] ? 1 : 0;
  }
  const double before = length();
  smooth_borders(surface, part, {2.0, 0.0});
  CHECK(length() < before);
  CHECK(pieces_of(surface, part) == 2);
}

TEST_CASE("options out of range and maps that do not fit are refused") {
  const Shape shape = sample("capsule");
  SegmentOptions options;
  options.parts.contrast = 0;
  CHECK_THROWS_AS(segment_surface(shape.surface, shape.skeleton, options), UsageError);
  options = {};
  options.borders.width = -1;
  CHECK_THROWS_AS(segment_surface(shape.surface, shape.skeleton, options), UsageError);
  CurveSkeleton bare = shape.skeleton;
  bare.node_of_vertex.clear();
  CHECK_THROWS_AS(segment_surface(shape.surface, bare), UsageError);
}
