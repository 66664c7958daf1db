// Spatial coherence is a weighted mean of skeletal points: what follows from that.
#include "mspskel/center/spatial_coherence.h"

#include <catch2/catch.hpp>

#include "support/meshes.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

SkeletonMesh points_of(const SurfaceSnapshot& surface, const std::function<Vector3(Index)>& point) {
  SkeletonMesh mesh;
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    mesh.position.push_back(point(v));
    mesh.perimeter.push_back(2 * kPi);
    mesh.normal.push_back(Vector3::UnitZ());
    mesh.error.push_back(0.0);
    mesh.area.push_back(surface.vertex_area[v]);
    mesh.valid.push_back(1);
  }
  return mesh;
}

SkeletonMesh random_points(const SurfaceSnapshot& surface, std::uint64_t seed) {
  Random random(seed);
  SkeletonMesh mesh = points_of(surface, [&](Index) { return random.in_ball(); });
  for (std::size_t v = 0; v < mesh.error.size(); ++v) {
    mesh.error[v] = random.uniform();
    mesh.perimeter[v] = random.uniform(0.1, 3);
    mesh.valid[v] = random.below(10) > 0;
  }
  return mesh;
}

SkeletonMesh smoothed(const SurfaceSnapshot& surface, SkeletonMesh mesh, double strength = 2.0) {
  CoherenceOptions options;
  options.strength = strength;
  apply_spatial_coherence(surface, options, mesh);
  return mesh;
}

}  // namespace

TEST_CASE("A constant field stays, whatever the confidences") {
  const Vector3 place(0.3, -0.2, 0.9);
  for (const Index vertices : {150, 21000}) {  // eliminated, and approached in steps
    const SurfaceSnapshot surface = make_snapshot(sphere(vertices));
    SkeletonMesh mesh = random_points(surface, 1);
    for (Vector3& p : mesh.position) p = place;
    for (const double strength : {0.1, 2.0, 10.0}) {
      double farthest = 0;
      for (const Vector3& p : smoothed(surface, mesh, strength).position)
        farthest = std::max(farthest, (p - place).norm());
      CHECK(farthest < 1e-9);
    }
  }
}

// The Laplacian is symmetric, so what the points move, by their confidences, adds up to nothing. Beside wide
// slices neighbours' points do not scatter, and only errors take confidence away.
TEST_CASE("The mean of the points by their confidences stays, however the system is solved") {
  const SurfaceSnapshot few = make_snapshot(sphere(150)), many = make_snapshot(sphere(21000)),
                        handles = make_snapshot(to_mesh(boundary(foam({6, 6, 6}))));
  REQUIRE(handles.vertex_count() < 20000);
  REQUIRE(handles.component_count - (handles.vertex_count() - handles.face_count() / 2) / 2 > 128);
  for (const SurfaceSnapshot* surface : {&few, &many, &handles}) {
    SkeletonMesh before = random_points(*surface, 5);
    for (std::size_t v = 0; v < before.position.size(); ++v) {
      before.perimeter[v] = 1e12;
      before.valid[v] = 1;
    }
    const SkeletonMesh after = smoothed(*surface, before);
    Vector3 sum = Vector3::Zero();
    double moves = 0;
    for (std::size_t v = 0; v < before.position.size(); ++v) {
      const double confidence = 1e-6 + (1 - before.error[v]) * (1 - before.error[v]);
      const Vector3 move = after.position[v] - before.position[v];
      sum += confidence * move;
      moves += confidence * move.norm();
    }
    CHECK(moves > 0.01 * static_cast<double>(before.position.size()));
    CHECK(sum.norm() < 1e-6 * moves);
  }
}

TEST_CASE("Every coordinate stays within the range of the field") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const SurfaceSnapshot surface = make_snapshot(sphere(seed < 6 ? 150 : 21000));
    const SkeletonMesh before = random_points(surface, seed);
    Eigen::AlignedBox3d box;
    for (const Vector3& p : before.position) box.extend(p);
    double farthest = 0;
    for (const Vector3& p : smoothed(surface, before).position)
      farthest = std::max(farthest, box.exteriorDistance(p));
    CHECK(farthest < 1e-6);
  }
}

TEST_CASE("Points of full confidence that agree hardly move, points without confidence go to them") {
  // Every slice has radius 1, and the points of neighbours lie within a small share of that.
  const SurfaceSnapshot surface = make_snapshot(sphere(300));
  SkeletonMesh mesh = points_of(surface, [&](Index v) { return Vector3(0.02 * surface.position[v]); });
  const Index stray = 7;
  const Vector3 right = mesh.position[stray];
  mesh.position[stray] = Vector3(0.5, 0.5, 0.5);
  mesh.valid[stray] = 0;
  const SkeletonMesh after = smoothed(surface, mesh);
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    INFO(v);
    CHECK((after.position[v] - (v == stray ? right : mesh.position[v])).norm() < 0.01);
  }
}

TEST_CASE("The result turns, moves and scales with the field") {
  const DefaultMesh ball = sphere(120);
  const SurfaceSnapshot surface = make_snapshot(ball);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3(1, 3, -2).normalized()).toRotationMatrix();
  const SkeletonMesh field = random_points(surface, 4);
  SkeletonMesh changed = field;
  for (Vector3& p : changed.position) p = turn * p + Vector3(1, 2, 3);
  const SkeletonMesh expected = smoothed(surface, field), got = smoothed(surface, changed);
  for (std::size_t v = 0; v < expected.position.size(); ++v)
    CHECK((turn * expected.position[v] + Vector3(1, 2, 3) - got.position[v]).norm() < 1e-9);
}

TEST_CASE("Numbering does not matter") {
  const DefaultMesh ball = sphere(120);
  std::vector<Index> place;
  const SurfaceSnapshot surface = make_snapshot(ball), other = make_snapshot(renumbered(ball, 3, &place));
  const SkeletonMesh field = random_points(surface, 4);
  SkeletonMesh changed = field;
  for (std::size_t v = 0; v < place.size(); ++v) {
    changed.position[place[v]] = field.position[v];
    changed.error[place[v]] = field.error[v];
    changed.perimeter[place[v]] = field.perimeter[v];
    changed.valid[place[v]] = field.valid[v];
  }
  const SkeletonMesh expected = smoothed(surface, field), got = smoothed(other, changed);
  for (std::size_t v = 0; v < place.size(); ++v)
    CHECK((expected.position[v] - got.position[place[v]]).norm() < 1e-9);
}

TEST_CASE("Off, without strength and on vertices without faces nothing changes") {
  DefaultMesh ball = sphere(60);
  ball.add_vertex({3, 3, 3});
  const SurfaceSnapshot surface = make_snapshot(ball);
  const SkeletonMesh field = random_points(surface, 2);
  CHECK(smoothed(surface, field, 0).position == field.position);
  CHECK((smoothed(surface, field, 5).position.back() - field.position.back()).norm() < 1e-12);
  CoherenceOptions off;
  off.enabled = false;
  SkeletonMesh same = field;
  apply_spatial_coherence(surface, off, same);
  CHECK(same.position == field.position);
  CHECK_THROWS_AS(smoothed(surface, field, -1), UsageError);
  CHECK_THROWS_AS(smoothed(surface, field, std::nan("")), UsageError);
}
