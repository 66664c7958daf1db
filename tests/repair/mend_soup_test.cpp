// Whatever a file holds becomes a closed surface of the right pieces, or is refused.
#include "mspskel/repair/mend_soup.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "mspskel/base/error.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/mesh/mesh_report.h"
#include "support/damage.h"
#include "support/meshes.h"
#include "support/soups.h"
#include "topology/voxel_solids.h"

using namespace mspskel;
using namespace mspskel::test;
using Catch::Contains;

namespace {

struct Facts {
  Index components, genus;
  double volume;
};

// Throws if the soup is not what build_mesh takes.
Facts facts_of(const MendedSoup& mended) {
  const BuiltMesh built = build_mesh_with_report(mended.soup);
  const MeshReport report = report_mesh(make_snapshot(built.mesh), {0});
  return {built.component_count, report.genus, report.signed_volume};
}

bool same(const PolygonSoup& a, const PolygonSoup& b) {
  return a.points == b.points && a.corners == b.corners && a.begin == b.begin;
}

PolygonSoup torus_soup() { return to_soup(torus(1, 0.4, 40, 20)); }
// From z = 0 to 6, radius 1.
PolygonSoup tube_soup() { return to_soup(tube(1, 6, 24, 12)); }

PolygonSoup cells(std::initializer_list<Cell> list) {
  VoxelSolid solid;
  for (const Cell& c : list) solid.cells.insert(c);
  return boundary(solid);
}

// On two triangles, the lower one first.
PolygonSoup prism(const std::vector<Vector3>& points) {
  PolygonSoup soup;
  soup.points = points;
  for (const auto& [a, b, c] : {std::array<Index, 3>{0, 2, 1},
                                {3, 4, 5},
                                {0, 1, 4},
                                {0, 4, 3},
                                {1, 2, 5},
                                {1, 5, 4},
                                {2, 0, 3},
                                {2, 3, 5}})
    soup.add_triangle(a, b, c);
  return soup;
}

double height(const PolygonSoup& soup, bool top) {
  double z = soup.points[0].z();
  for (const Vector3& p : soup.points) z = top ? std::max(z, p.z()) : std::min(z, p.z());
  return z;
}

}  // namespace

TEST_CASE("a closed surface comes through as it is") {
  const PolygonSoup soup = torus_soup();
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(same(mended.soup, soup));
  REQUIRE(summary(mended).empty());
  for (Index v = 0; v < static_cast<Index>(soup.points.size()); ++v) REQUIRE(mended.vertex_of_point[v] == v);
}

TEST_CASE("points of faces that were taken apart are one again, and each finds its vertex") {
  const PolygonSoup soup = split(torus_soup());
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(facts_of(mended).genus == 1);
  REQUIRE(mended.soup.points.size() == torus_soup().points.size());
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    REQUIRE(mended.soup.points[mended.vertex_of_point[v]] == soup.points[v]);
}

TEST_CASE("points that are no numbers keep no others apart") {
  PolygonSoup soup = split(torus_soup());
  const auto used = static_cast<Index>(soup.points.size());
  for (Index i = 0; i < used; ++i)  // among the others
    soup.points.emplace_back(std::nan(""), i % 7, soup.points[i].z());
  Random random(5);
  const std::vector<Index> place = permutation(static_cast<Index>(soup.points.size()), random);
  std::vector<Vector3> points(soup.points.size());
  for (std::size_t v = 0; v < place.size(); ++v) points[place[v]] = soup.points[v];
  soup.points = points;
  for (Index& v : soup.corners) v = place[v];
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(mended.soup.points.size() == torus_soup().points.size());
  REQUIRE(mended.counts.isolated_points == used);
  REQUIRE(mended.counts.stitched_points == 0);
}

TEST_CASE("mending does not depend on the unit of length, however small or large") {
  const PolygonSoup torn = without_patches(torus_soup(), 3, 0.02, Random(1));
  const MendedSoup usual = mend_soup(torn);
  REQUIRE(usual.counts.holes > 0);
  const double unit = GENERATE(0x1p-900, 0x1p-200, 0x1p200, 0x1p900);
  PolygonSoup far = torn;
  for (Vector3& p : far.points) p *= unit;
  const MendedSoup mended = mend_soup(far);
  REQUIRE(mended.soup.corners == usual.soup.corners);
  REQUIRE(mended.counts.hole_share == usual.counts.hole_share);
  for (std::size_t v = 0; v < usual.soup.points.size(); ++v)
    REQUIRE(mended.soup.points[v] == unit * usual.soup.points[v]);
}

TEST_CASE("points beside each other across a seam are stitched") {
  PolygonSoup soup = split(torus_soup());
  Random random(3);
  for (Vector3& p : soup.points) p += 1e-6 * Vector3(random.uniform(), random.uniform(), random.uniform());
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(facts_of(mended).genus == 1);
  REQUIRE(mended.soup.points.size() == torus_soup().points.size());
  REQUIRE(mended.counts.holes == 0);
}

TEST_CASE("faces turned either way agree again") {
  PolygonSoup soup = torus_soup();
  const int every = GENERATE(1, 3);
  for (std::size_t f = 0; f < soup.polygon_count(); f += every)
    std::swap(soup.corners[3 * f], soup.corners[3 * f + 1]);
  const Facts facts = facts_of(mend_soup(soup));
  REQUIRE(facts.genus == 1);
  REQUIRE(facts.volume > 0);
}

TEST_CASE("copies of faces, turned alike or opposite, are one") {
  const PolygonSoup clean = torus_soup();
  PolygonSoup soup = clean;
  append(soup, GENERATE(true, false) ? clean : inside_out(clean));
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(facts_of(mended).components == 1);
  REQUIRE(facts_of(mended).genus == 1);
  REQUIRE(mended.soup.polygon_count() == clean.polygon_count());
}

TEST_CASE("solids that touch in an edge or a corner are two, and as large as before") {
  const PolygonSoup soup = GENERATE(cells({{0, 0, 0}, {1, 1, 0}}), cells({{0, 0, 0}, {1, 1, 1}}));
  const Facts facts = facts_of(mend_soup(soup));
  REQUIRE(facts.components == 2);
  REQUIRE(facts.volume == Approx(2).epsilon(0.01));
}

TEST_CASE(
    "a small solid that touches a large one in an edge is a part of it, and takes along what it touches") {
  VoxelSolid solid;
  for (int x = 0; x < 9; ++x)
    for (const auto& [y, z] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) solid.cells.insert({x, y, z});
  const PolygonSoup alone = boundary(solid);
  REQUIRE(same(mend_soup(alone).soup, alone));
  for (const Cell& c : {Cell{4, 2, 2}, {5, 3, 2}, {7, -1, -1}, {7, -2, 0}}) solid.cells.insert(c);
  const MendedSoup mended = mend_soup(boundary(solid));
  const Facts facts = facts_of(mended);
  CHECK(mended.counts.joined_pieces == 4);
  CHECK(facts.components == 1);
  CHECK(facts.genus == 0);
  CHECK(facts.volume == Approx(40).epsilon(0.01));
  const MeshReport report = report_mesh(make_snapshot(build_mesh(mended.soup)), {0});
  CHECK(report.degenerate_faces == 0);
}

TEST_CASE("what hangs on a solid by an edge between two wedges of void hangs on it by more than a line") {
  // A prism with an edge along the z axis, and a tetrahedron on that edge with 30 degrees of void on one side
  // of it and 200 on the other.
  const bool mirrored = GENERATE(false, true), small_first = GENERATE(false, true);
  const auto at = [&](double degrees, double radius, double z) {
    const double turn = degrees * kPi / 180;
    return Vector3((mirrored ? -1 : 1) * radius * std::cos(turn), radius * std::sin(turn), z);
  };
  const PolygonSoup large =
      prism({at(0, 0, 0), at(180, 4, 0), at(270, 4, 0), at(0, 0, 1), at(180, 4, 1), at(270, 4, 1)});
  PolygonSoup small;
  small.points = {at(0, 0, 0), at(0, 0, 1), at(110, 0.5, 0.5), at(150, 0.5, 0.5)};
  for (const auto& [a, b, c] : {std::array<Index, 3>{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})
    small.add_triangle(a, b, c);
  const MendedSoup mended = mend_soup(small_first ? together({small, large}) : together({large, small}));
  REQUIRE(mended.counts.joined_pieces == 1);
  REQUIRE(facts_of(mended).components == 1);
  const SurfaceSnapshot surface = make_snapshot(build_mesh(mended.soup));
  double thinnest = 1;
  for (Index v = 0; v < surface.vertex_count(); ++v)
    for_each_neighbour(surface, v, [&](Index a) {
      for_each_neighbour(surface, v, [&](Index b) {
        const Vector3 to_a = surface.position[a] - surface.position[v],
                      to_b = surface.position[b] - surface.position[v];
        if (a < b && to_a.dot(to_b) < 0)
          thinnest = std::min(thinnest, to_a.cross(to_b).norm() / (to_a - to_b).norm() / to_a.norm());
      });
    });
  CHECK(thinnest > 1e-3);
}

TEST_CASE("a small solid that a pair of opposite triangles hangs on a large one is a part of it") {
  VoxelSolid solid;
  for (int x = 0; x < 9; ++x)
    for (const auto& [y, z] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) solid.cells.insert({x, y, z});
  solid.cells.insert({9, 2, 2});
  PolygonSoup soup = boundary(solid);
  CHECK(facts_of(mend_soup(soup)).components == 2);
  const auto at = [&](const Vector3& p) {
    return static_cast<Index>(std::find(soup.points.begin(), soup.points.end(), p) - soup.points.begin());
  };
  const Index corner = at({9, 2, 2}), of_large = at({8, 2, 2}), of_small = at({9, 3, 2});
  soup.add_triangle(corner, of_large, of_small);
  soup.add_triangle(corner, of_small, of_large);
  const MendedSoup mended = mend_soup(soup);
  const Facts facts = facts_of(mended);
  CHECK(mended.counts.joined_pieces == 1);
  CHECK(facts.components == 1);
  CHECK(facts.genus == 0);
  CHECK(facts.volume == Approx(37).epsilon(0.01));
  CHECK(report_mesh(make_snapshot(build_mesh(mended.soup)), {0}).degenerate_faces == 0);
}

// A wedge of 4 x 1 whose two sides meet in the edge from (0, 0, 0) to (0, 0, 1) at an angle of 2 * half.
PolygonSoup wedge(double half) {
  const double x = -4, y = 4 * std::tan(half);
  return prism({{0, 0, 0}, {x, y, 0}, {x, -y, 0}, {0, 0, 1}, {x, y, 1}, {x, -y, 1}});
}

// Adds the triangle and its opposite.
void add_flat(PolygonSoup& soup, Index a, Index b, Index c) {
  soup.add_triangle(a, b, c);
  soup.add_triangle(a, c, b);
}

double reach(const PolygonSoup& soup) {
  double x = -1e9;
  for (const Index v : soup.corners) x = std::max(x, soup.points[v][0]);
  return x;
}

TEST_CASE("what decimation made flat at the acute end of a solid has a thickness again") {
  const auto [degrees, stays] =
      GENERATE(table<double, bool>({{20, true}, {44, true}, {45, false}, {60, false}}));
  const int triangles = GENERATE(1, 2, 3), direction = GENERATE(0, 1);
  PolygonSoup soup = wedge(degrees * kPi / 180);
  for (const Vector3& p : {Vector3(0.5, 0, 0.5), Vector3(1, 0, 0), Vector3(1.5, 0, 0.7)})
    soup.points.push_back(p);
  if (direction == 0)
    add_flat(soup, 0, 3, 6);
  else
    add_flat(soup, 3, 0, 6);
  if (triangles > 1) add_flat(soup, 3, 6, 7);
  if (triangles > 2) add_flat(soup, 6, 8, 7);
  const MendedSoup mended = mend_soup(soup);
  CHECK(mended.counts.two_sided_faces == triangles);
  CHECK(mended.counts.thickened_faces == (stays ? triangles : 0));
  CHECK(reach(mended.soup) == (stays ? 0.5 * triangles : 0));
  CHECK(facts_of(mended).components == 1);
  CHECK(facts_of(mended).genus == 0);
  const MeshReport report = report_mesh(make_snapshot(build_mesh(mended.soup)), {0});
  CHECK(report.degenerate_faces == 0);
  CHECK(report.signed_volume > 0);
}

TEST_CASE("what was flat and got a thickness is no lid, however much of a thin solid it is") {
  PolygonSoup soup = wedge(0.01);
  for (Vector3& p : soup.points) p[2] *= 0.3;
  for (const Vector3& p : {Vector3(1.5, 0, 0.15), Vector3(1.2, 0, 0.9), Vector3(1.2, 0, -0.6)})
    soup.points.push_back(p);
  add_flat(soup, 0, 3, 6);
  add_flat(soup, 3, 7, 6);
  add_flat(soup, 0, 6, 8);
  const MendedSoup mended = mend_soup(soup);
  CHECK(mended.counts.thickened_faces == 3);
  CHECK(mended.counts.hole_share == 0);
  CHECK(facts_of(mended).components == 1);
}

TEST_CASE("a flat strip between a small solid and a large one holds them together without a handle") {
  const bool twice = GENERATE(false, true);
  PolygonSoup small = wedge(0.3);
  for (Vector3& p : small.points) p = {1 - 0.1 * p[0], 0.1 * p[1], 0.1 * p[2]};
  PolygonSoup soup = together({wedge(0.3), inside_out(small)});
  add_flat(soup, 0, 3, 6);
  add_flat(soup, 3, 9, 6);
  if (twice) add_flat(soup, 6, 9, 7);  // by another edge of the small one as well
  const MendedSoup mended = mend_soup(soup);
  CHECK(mended.counts.joined_pieces == 1);
  CHECK(mended.counts.thickened_faces >= 2);
  CHECK(facts_of(mended).components == 1);
  CHECK(facts_of(mended).genus == 0);
}

TEST_CASE("voxels make as many pieces as they have connected over their faces") {
  Random random(GENERATE(range(1, 9)));
  VoxelSolid solid;
  for (int i = 0; i < 125; ++i)
    if (random.uniform() < 0.45) solid.cells.insert({i % 5, i / 5 % 5, i / 25});
  std::map<Cell, Index> piece;
  Index pieces = 0;
  for (const Cell& seed : solid.cells) {
    if (piece.count(seed)) continue;
    std::vector<Cell> stack{seed};
    piece[seed] = pieces;
    while (!stack.empty()) {
      const Cell c = stack.back();
      stack.pop_back();
      for (int k = 0; k < 6; ++k) {
        Cell d = c;
        d[k / 2] += k % 2 ? 1 : -1;
        if (solid.cells.count(d) && piece.insert({d, pieces}).second) stack.push_back(d);
      }
    }
    ++pieces;
  }
  MendOptions all;
  all.smallest_component = 0;
  all.touching_part = 0;
  const MendedSoup mended = mend_soup(boundary(solid), all);
  const BuiltMesh built = build_mesh_with_report(mended.soup);
  const MeshReport report = report_mesh(make_snapshot(built.mesh), {0});
  const Index cavities = report.cavities;
  REQUIRE(built.component_count - cavities == pieces);
  REQUIRE(report.signed_volume == Approx(static_cast<double>(solid.cells.size())).epsilon(0.01));
  REQUIRE(report.degenerate_faces == 0);
}

TEST_CASE("solids joined by a wall that both have are one") {
  PolygonSoup soup = cells({{0, 0, 0}});
  append(soup, cells({{1, 0, 0}}));
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(facts_of(mended).components == 1);
  REQUIRE(facts_of(mended).volume == Approx(2));
  REQUIRE(mended.counts.two_sided_faces == 2);
}

TEST_CASE("a flap goes, and so does a wall within") {
  PolygonSoup soup = cells({{0, 0, 0}, {1, 0, 0}});
  const auto at = [&](double x, double y, double z) {
    for (std::size_t v = 0; v < soup.points.size(); ++v)
      if (soup.points[v] == Vector3(x, y, z)) return static_cast<Index>(v);
    soup.points.emplace_back(x, y, z);
    return static_cast<Index>(soup.points.size() - 1);
  };
  if (GENERATE(true, false)) {
    soup.add_triangle(at(1, 0, 0), at(1, 1, 0), at(1, 0.5, -1));
  } else {
    soup.add_triangle(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1));
    soup.add_triangle(at(1, 0, 0), at(1, 1, 1), at(1, 0, 1));
  }
  const Facts facts = facts_of(mend_soup(soup));
  REQUIRE(facts.components == 1);
  REQUIRE(facts.genus == 0);
  REQUIRE(facts.volume == Approx(2));
}

TEST_CASE("holes in a wall are closed and are no openings") {
  const PolygonSoup clean = to_soup(sphere(2000));
  const PolygonSoup soup =
      without_faces(clean, [](const Vector3& p) { return p.z() > 0.9 || p.x() > 0.95 || p.y() < -0.98; });
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(mended.counts.holes == 3);
  REQUIRE(mended.openings.empty());
  REQUIRE(facts_of(mended).genus == 0);
  REQUIRE(facts_of(mended).volume == Approx(4.18).epsilon(0.05));
}

TEST_CASE("holes that touch at a point leave the surface one") {
  const PolygonSoup soup = without_faces(torus_soup(), [](const Vector3& p) {
    return (std::abs(p.x()) + std::abs(p.y()) > 1.6) && std::sin(40 * p.z()) > 0.5;
  });
  const Facts facts = facts_of(mend_soup(soup));
  REQUIRE(facts.components == 1);
  REQUIRE(facts.genus == 1);
}

TEST_CASE("open ends of a tube are openings with centre, normal and radius") {
  const PolygonSoup clean = tube_soup();
  const double low = height(clean, false), high = height(clean, true);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  const Vector3 shift(5, -3, 2);
  PolygonSoup soup =
      moved(without_faces(clean, [&](const Vector3& p) { return p.z() < low + 1e-9 || p.z() > high - 1e-9; }),
            turn, shift);
  if (GENERATE(true, false)) soup = inside_out(soup);
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(mended.openings.size() == 2);
  for (const Opening& opening : mended.openings) {
    const Vector3 local = turn.transpose() * (opening.centre - shift);
    const bool top = local.z() > (low + high) / 2;
    REQUIRE((local - Vector3(0, 0, top ? high : low)).norm() < 0.01);
    REQUIRE((turn.transpose() * opening.normal - Vector3(0, 0, top ? 1 : -1)).norm() < 0.01);
    REQUIRE(opening.radius == Approx(1).epsilon(0.02));
    REQUIRE(mended.soup.points[opening.vertex] == opening.centre);
  }
  MendOptions options;
  options.open = OpenEnds::kCap;
  REQUIRE(mend_soup(soup, options).openings.empty());
  options.open = OpenEnds::kFail;
  REQUIRE_THROWS_WITH(mend_soup(soup, options), Contains("2 holes"));
}

TEST_CASE("the end of a tube is one opening as well where it is ragged") {
  struct Cut {
    const char* name;
    double slope;  // of the plane, across the axis
    int waves;     // round the axis
    double height, jag,
        lost;  // of the waves; how far faces stick out; share of the last faces that are missing
  };
  const Cut cut = GENERATE(Cut{"teeth", 0, 0, 0, 0, 0}, Cut{"jags", 0, 0, 0, 0.2, 0},
                           Cut{"jags", 0, 0, 0, 0.4, 0}, Cut{"lost faces", 0, 0, 0, 0, 0.1},
                           Cut{"lost faces", 0, 0, 0, 0, 0.3}, Cut{"slanted teeth", 1, 0, 0, 0, 0},
                           Cut{"steep teeth", 1.4, 0, 0, 0, 0}, Cut{"slanted, lost faces", 0.6, 0, 0, 0, 0.2},
                           Cut{"waves", 0, 3, 0.4, 0, 0}, Cut{"more waves", 0, 7, 0.3, 0, 0});
  const bool turned = GENERATE(true, false);
  INFO(cut.name << (turned ? ", inside out" : ""));
  Random random(7);
  const PolygonSoup clean = to_soup(tube(1, 8, 24, 40));
  PolygonSoup soup = without_faces(clean, [&](const Vector3& p) {
    const double end = 5 - cut.slope * p.x() + cut.height * std::sin(cut.waves * std::atan2(p.y(), p.x())) +
                       cut.jag * (2 * random.uniform() - 1);
    return p.z() > end || (p.z() > end - 0.3 && random.uniform() < cut.lost);
  });
  if (turned) soup = inside_out(soup);
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(mended.openings.size() == 1);
  const Opening& opening = mended.openings[0];
  const Vector3 normal = Vector3(cut.slope, 0, 1).normalized();
  REQUIRE(opening.normal.dot(normal) > 0.97);
  REQUIRE((opening.centre - Vector3(0, 0, 5)).norm() < 0.4);
  REQUIRE(opening.radius > 0.85);
  REQUIRE(opening.radius < 1.4);
  REQUIRE(facts_of(mended).genus == 0);
  REQUIRE(facts_of(mended).volume == Approx(5 * kPi).epsilon(0.08));
  // No folds between teeth and centre: the cap is hardly larger than one in the plane.
  double cap = 0;
  for (std::size_t i = 0; i < mended.soup.corners.size(); i += 3) {
    const Index* c = &mended.soup.corners[i];
    if (std::find(c, c + 3, opening.vertex) == c + 3) continue;
    const auto at = [&](int k) { return Vector3(mended.soup.points[c[k]] - mended.soup.points[c[0]]); };
    cap += at(1).cross(at(2)).norm() / 2;
  }
  REQUIRE(cap < 1.2 * kPi / normal.z());
  for (const Index corner : soup.corners)
    if (std::abs(soup.points[corner].z()) < 4) REQUIRE(mended.vertex_of_point[corner] != kNone);
}

TEST_CASE("a window in the side of a tube is no end of it, however large and ragged") {
  const double wide = GENERATE(0.4, 0.8, 1.2), jag = GENERATE(0.0, 0.2);
  Random random(3);
  const MendedSoup mended = mend_soup(without_faces(to_soup(tube(1, 8, 24, 40)), [&](const Vector3& p) {
    return std::hypot(std::atan2(p.y(), p.x()), p.z() - 4) < wide + jag * (random.uniform() - 0.5);
  }));
  REQUIRE(mended.openings.empty());
  REQUIRE(facts_of(mended).genus == 0);
}

TEST_CASE("crumbs go unless they are wanted") {
  PolygonSoup soup = torus_soup();
  append(soup, moved(to_soup(scaled(tetrahedron(), 0.02)), Eigen::Matrix3d::Identity(), {3, 0, 0}));
  append(soup, moved(to_soup(scaled(tetrahedron(), 0.5)), Eigen::Matrix3d::Identity(), {-3, 0, 0}));
  const auto pieces = [&](double share) {
    MendOptions options;
    options.smallest_component = share;
    return facts_of(mend_soup(soup, options)).components;
  };
  REQUIRE(pieces(0) == 3);
  REQUIRE(pieces(MendOptions().smallest_component) == 2);
  REQUIRE(pieces(1) == 1);
  const MendedSoup mended = mend_soup(soup);
  REQUIRE(mended.vertex_of_point[torus_soup().points.size()] == kNone);
}

TEST_CASE("what encloses nothing is refused with a remedy") {
  PolygonSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  REQUIRE_THROWS_WITH(mend_soup(soup), Contains("points and lines"));
  soup.add_triangle(0, 1, 2);
  REQUIRE_THROWS_WITH(mend_soup(soup), Contains("1 triangle") && Contains("thickness"));
  soup.add_triangle(1, 3, 2);
  REQUIRE_THROWS_AS(mend_soup(soup), MeshError);
}

TEST_CASE("what is too small for the points that mending makes is refused, not written with points in one") {
  // Two cubes that touch in an edge are drawn apart by a part of it.
  const PolygonSoup cubes = together({box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1})});
  const auto scaled = [&](double scale) {
    PolygonSoup soup = cubes;
    for (Vector3& p : soup.points) p *= scale;
    return soup;
  };
  const std::size_t points = mend_soup(cubes).soup.points.size();
  for (const double scale : {1e-290, 1e-100, 1e200})
    CHECK(mend_soup(scaled(scale)).soup.points.size() == points);
  CHECK_THROWS_WITH(mend_soup(scaled(5e-324)), Contains("scale it up"));
  // Nothing has to be made of one cube.
  PolygonSoup cube = box({0, 0, 0}, {5e-324, 5e-324, 5e-324});
  CHECK(mend_soup(cube).soup.points == cube.points);
}

TEST_CASE("tiny coordinates beside the greatest come through mending with every digit") {
  PolygonSoup cube = box({1e-17, 1e-17, 1e-17}, {1e300, 1e300, 1e300});
  cube.points.front() = {1.25e-17, 3e-100, 7e-5};
  CHECK(mend_soup(cube).soup.points == cube.points);
}

TEST_CASE("a surface of one side is cut, not refused") {
  PolygonSoup soup;  // a strip with half a turn
  constexpr Index kLong = 30;
  for (Index i = 0; i < kLong; ++i) {
    const double turn = 2 * kPi * i / kLong;
    const Vector3 out(std::cos(turn), std::sin(turn), 0);
    const Vector3 across = 0.3 * (std::cos(turn / 2) * out + std::sin(turn / 2) * Vector3::UnitZ());
    soup.points.push_back(out + across);
    soup.points.push_back(out - across);
  }
  for (Index i = 0; i < kLong; ++i) {
    const bool last = i + 1 == kLong;
    const Index a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    soup.add_triangle(a, b, c);
    soup.add_triangle(b, d, c);
  }
  try {
    facts_of(mend_soup(soup));
  } catch (const MeshError& error) {
    REQUIRE_THAT(error.what(), Contains("no volume"));
  }
}

TEST_CASE("whatever comes out of a random soup is closed and manifold, on distinct points") {
  Random random(GENERATE(range(1, 401)));
  PolygonSoup soup;
  const auto pick = [&](Index count) { return static_cast<Index>(random.uniform() * count); };
  const Index points = 4 + pick(12), faces = 4 + pick(40);
  for (Index v = 0; v < points; ++v)  // on a coarse grid: many coincide, many faces have no area
    soup.points.emplace_back(pick(3), pick(3), pick(3));
  for (Index f = 0; f < faces; ++f) {
    for (Index k = 0; k < 2 + pick(5); ++k) soup.corners.push_back(pick(points));
    soup.begin.push_back(static_cast<Index>(soup.corners.size()));
  }
  try {
    const MendedSoup mended = mend_soup(soup);
    const BuiltMesh built = build_mesh_with_report(mended.soup);
    REQUIRE(built.component_count > 0);
    std::vector<std::array<double, 3>> places;
    for (const Vector3& p : mended.soup.points) places.push_back({p[0], p[1], p[2]});
    std::sort(places.begin(), places.end());
    REQUIRE(std::adjacent_find(places.begin(), places.end()) == places.end());
    for (const Index v : mended.vertex_of_point)
      REQUIRE((v == kNone || (v >= 0 && v < static_cast<Index>(mended.soup.points.size()))));
  } catch (const MeshError& error) {
    REQUIRE_THAT(error.what(), Contains("no volume") || Contains("no face with an area"));
  }
}

TEST_CASE("mending asks whether to stop before each step and while it closes holes, and stops") {
  SampleOptions options;
  options.resolution = 4000;
  const PolygonSoup sphere = make_sample("sphere", options);
  PolygonSoup pierced;
  pierced.points = sphere.points;
  for (std::size_t f = 0; f < sphere.polygon_count(); ++f)
    if (f % 7 != 0)
      pierced.add_triangle(sphere.corners[3 * f], sphere.corners[3 * f + 1], sphere.corners[3 * f + 2]);
  int asked = 0;
  (void)mend_soup(pierced, {}, [&](const char*, double) { return ++asked > 0; });
  CHECK(asked > 10);
  for (int last = 1; last <= asked; ++last) {
    int again = 0;
    CHECK_THROWS_AS(mend_soup(pierced, {}, [&](const char*, double) { return ++again < last; }), Cancelled);
    CHECK(again == last);
  }
}
