// Shells that cross each other become one solid; all others stay as they are.
#include "mspskel/repair/unite_shells.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>

#include "mspskel/base/error.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/mesh/mesh_report.h"
#include "support/meshes.h"
#include "support/soups.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

PolygonSoup shifted(PolygonSoup soup, const Vector3& by) {
  for (Vector3& p : soup.points) p += by;
  return soup;
}

std::optional<UnitedShells> unite(const PolygonSoup& soup, int threads = 1) {
  Execution execution;
  execution.threads = threads;
  const SurfaceSnapshot surface = make_snapshot(build_mesh(soup));
  const CrossingShells crossing = crossing_shells(surface, execution);
  if (crossing.groups.empty()) return std::nullopt;
  return unite_shells(surface, crossing, {}, execution);
}

MeshReport report_of(const PolygonSoup& soup) { return report_mesh(make_snapshot(build_mesh(soup)), {1}); }

// The share of the edges that are shorter than `length`.
double share_below(const PolygonSoup& soup, double length) {
  const SurfaceSnapshot surface = make_snapshot(build_mesh(soup));
  Index count = 0;
  for (Index h = 0; h < surface.halfedge_count(); ++h)
    count += surface.edge_length(h) * surface.frame.scale < length;
  return static_cast<double>(count) / static_cast<double>(surface.halfedge_count());
}

// Of a union that was cut, in one piece.
MeshReport report_of_cut(const std::optional<UnitedShells>& united) {
  REQUIRE(united);
  CHECK(united->solids == 1);
  CHECK(united->cell == 0);
  MeshReport report = report_of(united->soup);
  CHECK(report.components.size() == 1);
  return report;
}

const PolygonSoup kAlongX = box({-3, -0.5, -0.5}, {3, 0.5, 0.5}),
                  kAlongY = box({-0.4, -3, -0.4}, {0.4, 3, 0.4});

}  // namespace

TEST_CASE("bars that cross are one solid with the volume of their union, and their vertices find it") {
  const PolygonSoup bars = together({kAlongX, kAlongY});
  const auto united = unite(bars);
  REQUIRE(united);
  CHECK(united->shells == 2);
  CHECK(united->solids == 1);
  CHECK(united->left_apart == 0);
  const MeshReport report = report_of(united->soup);
  CHECK(report.components.size() == 1);
  CHECK(report.genus == 0);
  CHECK(report.self_intersections == 0);
  CHECK(report.signed_volume == Approx(6 + 3.84 - 0.64).epsilon(0.02));
  for (std::size_t v = 0; v < bars.points.size(); ++v)
    CHECK((united->soup.points[united->vertex_of[v]] - bars.points[v]).norm() < 1e-4);
  CHECK(united->cell == 0);
  CHECK(share_below(united->soup, 0.1 * 0.8) < 0.05);  // of the thinner bar's width
}

TEST_CASE("bars are sampled on a grid where one is asked for") {
  const PolygonSoup bars = together({kAlongX, kAlongY});
  const SurfaceSnapshot surface = make_snapshot(build_mesh(bars));
  UniteOptions options;
  options.cell = 0.01;
  const UnitedShells united = unite_shells(surface, crossing_shells(surface), options);
  CHECK(united.cell > 0);
  CHECK(united.resolved);
  const MeshReport report = report_of(united.soup);
  CHECK(report.components.size() == 1);
  CHECK(report.genus == 0);
  CHECK(report.signed_volume == Approx(6 + 3.84 - 0.64).epsilon(0.02));
  CHECK(share_below(united.soup, 0.4 * united.cell) < 0.05);
}

TEST_CASE("a handle that is a shell of its own gives the pot a handle") {
  const PolygonSoup ring = to_soup(torus(1, 0.2, 48, 16));
  const auto united = unite(together({box({0.7, -1.5, -1.5}, {4, 1.5, 1.5}), ring}));
  REQUIRE(united);
  const MeshReport report = report_of(united->soup);
  CHECK(report.components.size() == 1);
  CHECK(report.genus == 1);
}

TEST_CASE("shells that cross no other stay as they are, beside the united ones") {
  const PolygonSoup far = shifted(to_soup(torus(1, 0.4, 24, 12)), {0, 0, 9});
  const auto united = unite(together({far, kAlongX, kAlongY}));
  REQUIRE(united);
  for (std::size_t v = 0; v < far.points.size(); ++v) {
    CHECK(united->vertex_of[v] == static_cast<Index>(v));
    CHECK((united->soup.points[v] - far.points[v]).norm() < 1e-12);
  }
  CHECK(united->replaced == std::vector<bool>{false, true, true});
  CHECK(report_of(united->soup).components.size() == 2);
}

TEST_CASE("apart, within each other, linked or in contact: nothing to unite") {
  const PolygonSoup ring = to_soup(torus(1, 0.3, 32, 16));
  PolygonSoup turned = ring;
  for (Vector3& p : turned.points) p = Vector3(p.x() + 1, p.z(), p.y());
  CHECK_FALSE(unite(together({kAlongX, shifted(kAlongX, {0, 3, 0})})));
  CHECK_FALSE(unite(together({kAlongX, box({-2, -0.3, -0.3}, {2, 0.3, 0.3})})));
  CHECK_FALSE(unite(together({kAlongX, shifted(kAlongX, {0.3, 1, 0.2})})));
  CHECK_FALSE(unite(kAlongX));
  CHECK_FALSE(unite(together({ring, turned})));
}

TEST_CASE("a part that is there twice is told, and one that is moved is none") {
  const auto repeated = [](const PolygonSoup& soup) {
    return has_repeated_shells(make_snapshot(build_mesh(soup)));
  };
  CHECK(repeated(together({kAlongX, kAlongY, kAlongX})));
  CHECK_FALSE(repeated(together({kAlongX, kAlongY})));
  CHECK_FALSE(repeated(together({kAlongX, shifted(kAlongX, {0, 1e-3, 0})})));
  CHECK_FALSE(repeated(kAlongX));
}

TEST_CASE(
    "a copy that lies a small part of the width aside is one with the part, whatever its side and size") {
  const PolygonSoup part = to_soup(torus(1, 0.3, 32, 16));
  const PolygonSoup aside = shifted(part, {1e-6, 2e-6, 1e-6});
  PolygonSoup larger = part, turned = part;
  for (Vector3& p : larger.points) p *= 1.0001;
  for (Vector3& p : turned.points) p *= 0.9999;
  for (std::size_t i = 0; i < turned.corners.size(); i += 3)
    std::swap(turned.corners[i + 1], turned.corners[i + 2]);
  for (const PolygonSoup& copy : {aside, larger, turned}) {
    const auto united = unite(together({part, copy}));
    REQUIRE(united);
    CHECK(united->shells == 2);
    CHECK(united->solids == 1);
    CHECK(united->soup.polygon_count() == part.polygon_count());
    CHECK(report_of(united->soup).genus == 1);
  }
  CHECK_FALSE(unite(together({kAlongX, box({-2.8, -0.45, -0.45}, {2.8, 0.45, 0.45})})));
}

TEST_CASE("a lattice of thin bars has the handles that its bars make, with faces in one plane") {
  constexpr int kBars = 9;
  constexpr double kHalf = 0.02;
  std::vector<PolygonSoup> bars;
  for (int i = 0; i < kBars; ++i) {
    bars.push_back(box({-0.5, i - kHalf, -kHalf}, {kBars - 0.5, i + kHalf, kHalf}));
    bars.push_back(box({i - kHalf, -0.5, -kHalf}, {i + kHalf, kBars - 0.5, kHalf}));
  }
  const auto united = unite(together(bars));
  const MeshReport report = report_of_cut(united);
  CHECK(report.genus == (kBars - 1) * (kBars - 1));
  CHECK(report.signed_volume ==
        Approx(4 * kHalf * kHalf * 2 * kBars * kBars - 8 * kHalf * kHalf * kHalf * kBars * kBars)
            .epsilon(1e-3));
}

TEST_CASE("parts in contact, or nearly, that pins hold together are one solid without handles") {
  const PolygonSoup pins =
      together({box({-1.6, -0.7, -0.83}, {-1.2, -0.3, 0.71}), box({1.1, 0.2, -0.77}, {1.4, 0.6, 0.79})});
  const PolygonSoup plate = box({-2, -1, -0.5}, {2, 1, 0});
  for (const double gap : {-1e-6, -1e-7, 0.0, 1e-7, 1e-5, 1e-3}) {
    const auto stands = unite(together({plate, box({-1.9, -0.9, gap}, {1.9, 0.9, 0.5 + gap}), pins}));
    const MeshReport report = report_of_cut(stands);
    CHECK(stands->shells == 4);
    CHECK(report.genus == 0);
    CHECK(report.signed_volume ==
          Approx(8 * 0.5 + 3.8 * 1.8 * 0.5 + 0.16 * 0.54 + 0.12 * 0.56).epsilon(0.03));
  }
}

TEST_CASE("boxes with faces in one plane are one solid without handles") {
  for (const double step : {0.0, 1e-7, -1e-7, 1e-5}) {
    const auto united =
        unite(together({box({-2, -1, -0.5}, {0.3, 1, 0.5}), box({-0.2, -1 + step, -0.5}, {2, 1 + step, 0.5}),
                        box({-1, -0.5, -0.5 + step}, {1, 0.5, 0.5 + step})}));
    const MeshReport report = report_of_cut(united);
    CHECK(report.genus == 0);
    CHECK(report.signed_volume == Approx(8).epsilon(0.01));
  }
}

TEST_CASE("a gap between parts that is wider than they grow is an opening") {
  // Two plates, and two posts through both.
  const auto united =
      unite(together({box({-2, -1, 0}, {2, 1, 0.4}), box({-2, -1, 0.5}, {2, 1, 0.9}),
                      box({-1.5, -0.2, -0.1}, {-1.1, 0.2, 1}), box({1, -0.2, -0.1}, {1.4, 0.2, 1})}));
  REQUIRE(united);
  CHECK(united->cell == 0);
  CHECK(report_of(united->soup).genus == 1);
}

TEST_CASE("a small hollow that parts leave between them is filled, and a room is not") {
  for (const double half : {0.15, 0.6}) {
    std::vector<PolygonSoup> parts{box({-1, -1, -0.6}, {1, 1, -0.2}), box({-1, -1, 0.2}, {1, 1, 0.6})};
    for (const double side : {-1.0, 1.0}) {
      parts.push_back(box(Vector3(side, 0, 0) - Vector3(1 - half, 0.9, 0.3),
                          Vector3(side, 0, 0) + Vector3(1 - half, 0.9, 0.3)));
      parts.push_back(box(Vector3(0, side, 0) - Vector3(0.8, 1 - half, 0.25),
                          Vector3(0, side, 0) + Vector3(0.8, 1 - half, 0.25)));
    }
    const auto united = unite(together(parts));
    REQUIRE(united);
    CHECK(united->solids == 1);
    const MeshReport report = report_of(united->soup);
    CHECK(report.components.size() == (half < 0.5 ? 1 : 2));
    CHECK(report.genus == 0);
  }
}

TEST_CASE("no two vertices of a union lie in one place, though a shell's tips meet in one") {
  // A horseshoe whose pointed ends touch, and a bar through it.
  const PolygonSoup shoe = to_soup(stacked_rings(
      16, 40,
      [](Index ring, Index segment) {
        const double along = 2 * kPi * (ring + 1) / 41, angle = -2 * kPi * segment / 16;
        const double radius = 0.3 * std::min(1.0, std::min(along, 2 * kPi - along));
        const double far = 2 + radius * std::cos(angle);
        return Vector3(far * std::cos(along), far * std::sin(along), radius * std::sin(angle));
      },
      Vector3(2, 0, 0), Vector3(2, 0, 0)));
  const auto united = unite(together({shoe, box({-4, -0.1, -0.1}, {-1, 0.1, 0.1})}));
  REQUIRE(united);
  CHECK(united->shells == 2);
  std::vector<std::array<double, 3>> places;
  for (const Vector3& p : united->soup.points) places.push_back({p.x(), p.y(), p.z()});
  std::sort(places.begin(), places.end());
  CHECK(std::adjacent_find(places.begin(), places.end()) == places.end());
}

TEST_CASE("shells that cross by less than a grid tells stay as they are where one is asked for") {
  // A hundredth as wide as long, and a fortieth of the width in each other.
  const PolygonSoup bars =
      together({box({-4, -0.04, -0.04}, {4, 0.04, 0.04}), box({-0.03, -4, 0.038}, {0.03, 4, 0.1})});
  const SurfaceSnapshot surface = make_snapshot(build_mesh(bars));
  const CrossingShells crossing = crossing_shells(surface);
  REQUIRE(crossing.groups.size() == 1);
  CHECK(unite_shells(surface, crossing, {}).solids == 1);
  UniteOptions options;
  options.cell = 0.01;
  const UnitedShells apart = unite_shells(surface, crossing, options);
  CHECK(apart.shells == 0);
  CHECK(apart.left_apart == 0);
  CHECK(apart.soup.points.empty());
}

TEST_CASE("a tree of twigs far thinner than its extent is one piece without a loop") {
  // A trunk of closed tubes end to end, askew, with twigs; each a hundredth as wide as long.
  const auto tube = [](const Vector3& from, const Vector3& to) {
    const Vector3 along = (to - from).normalized(), u = along.unitOrthogonal(), w = along.cross(u);
    return to_soup(stacked_rings(
        8, 4,
        [&](Index ring, Index segment) {
          const double angle = 2 * kPi * segment / 8.0;
          return Vector3(from + ring / 3.0 * (to - from) +
                         0.01 * (std::cos(angle) * u + std::sin(angle) * w));
        },
        from, to));
  };
  std::vector<PolygonSoup> tubes;
  Vector3 at = Vector3::Zero();
  for (int i = 0; i < 12; ++i) {
    const Vector3 next = at + Vector3(1, 0.3 * std::sin(2.0 * i), 0.2 * std::cos(3.0 * i));
    tubes.push_back(tube(at, next));
    tubes.push_back(tube(next, next + Vector3(0.2, i % 2 == 0 ? 1 : -1, 0.1)));
    at = next;
  }
  const auto united = unite(together(tubes));
  const MeshReport report = report_of_cut(united);
  CHECK(report.genus == 0);
}

TEST_CASE("walls thinner than the grid's cells do not become sieves") {
  // A plate a thousandth as thick as wide, and a post through it.
  const PolygonSoup plate = box({-4, -4, -0.002}, {4, 4, 0.002});
  const auto united = unite(together({plate, box({-0.5, -0.5, -3}, {0.5, 0.5, 3})}));
  REQUIRE(united);
  REQUIRE(united->shells == 2);
  CHECK(report_of(united->soup).genus == 0);
}

TEST_CASE("a neck much thinner than most of the shells keeps their union one") {
  // Two balls and a neck of a fiftieth of their radius between them, and a copy half of the neck's radius
  // aside.
  constexpr double kNeck = 0.02;
  const PolygonSoup bone = to_soup(stacked_rings(
      24, 60,
      [&](Index ring, Index segment) {
        const double z = -3 + 6.0 * (ring + 0.5) / 60, angle = 2 * kPi * segment / 24.0;
        const double ball = 1 - (std::abs(z) - 2) * (std::abs(z) - 2);
        const double radius = std::max(kNeck, ball > 0 ? std::sqrt(ball) : 0.0);
        return Vector3(radius * std::cos(angle), radius * std::sin(angle), z);
      },
      Vector3(0, 0, -3), Vector3(0, 0, 3)));
  const auto united = unite(together({bone, shifted(bone, {kNeck / 2, 0, 0})}));
  REQUIRE(united);
  CHECK(united->shells == 2);
  CHECK(united->solids == 1);
  CHECK(report_of(united->soup).components.size() == 1);
}

TEST_CASE("the union does not depend on the threads, and options are checked") {
  const PolygonSoup bars = together({kAlongX, kAlongY});
  const auto one = unite(bars, 1), three = unite(bars, 3);
  CHECK(one->soup.points == three->soup.points);
  CHECK(one->soup.corners == three->soup.corners);
  UniteOptions options;
  options.cell = 0.2;
  CHECK_THROWS_AS(validate(options), UsageError);
}

TEST_CASE("shells in one place or that meet in many faces ask more often whether to stop, and stop") {
  int asked[2][2] = {};  // while crossings are looked for, while shells are united
  for (const int k : {0, 1}) {
    SampleOptions options;
    options.resolution = k == 0 ? 1000 : 8000;
    const PolygonSoup ball = make_sample("sphere", options);
    const PolygonSoup balls = together({ball, shifted(ball, {1e-5, 0, 0}), shifted(ball, {0, 0, 0.5})});
    const SurfaceSnapshot surface = make_snapshot(build_mesh(balls));
    Execution execution;
    execution.threads = 1;
    execution.progress = [&](const char*, double) { return ++asked[k][0] > 0; };
    const CrossingShells crossing = crossing_shells(surface, execution);
    REQUIRE(crossing.groups.size() == 1);
    execution.progress = [&](const char*, double) { return ++asked[k][1] > 0; };
    (void)unite_shells(surface, crossing, {}, execution);
    int again = 0;
    execution.progress = [&](const char*, double) { return ++again < asked[k][1]; };
    CHECK_THROWS_AS(unite_shells(surface, crossing, {}, execution), Cancelled);
    CHECK(again == asked[k][1]);
  }
  // Every vertex and face of the copies is looked at.
  CHECK(asked[1][0] > 40);
  CHECK(asked[1][1] > 4 * asked[0][1]);
}
