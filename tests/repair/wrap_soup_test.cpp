// A surface round faces that do not meet: closed, near them, of the scale that is asked for or told.
#include "mspskel/repair/wrap_soup.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "mspskel/base/error.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/mesh/coarsen_surface.h"
#include "mspskel/samples/samples.h"
#include "support/damage.h"
#include "support/soups.h"

using namespace mspskel;
using namespace mspskel::test;
using Catch::Contains;

namespace {

PolygonSoup loose_faces(const std::string& name, int resolution, double drawn_in_share) {
  SampleOptions options;
  options.resolution = resolution;
  return drawn_in(make_sample(name, options), drawn_in_share);
}

PolygonSoup moved(const PolygonSoup& soup, double scale, const Vector3& way) {
  PolygonSoup result = soup;
  for (Vector3& p : result.points) p = scale * p + way;
  return result;
}

// Boxes, and what they fill each on its own.
struct Shells {
  PolygonSoup soup;
  double filled = 0;

  void add(const Vector3& low, const Vector3& high) {
    soup = filled > 0 ? together({soup, box(low, high)}) : box(low, high);
    filled += (high - low).prod();
  }
};

struct Shape {
  Index components = 0, genus = 0;
};

Shape shape_of(const PolygonSoup& soup) {
  const BuiltMesh built = build_mesh_with_report(soup);  // throws unless it is closed and manifold
  const auto euler = static_cast<Index>(built.mesh.n_vertices()) - static_cast<Index>(built.mesh.n_edges()) +
                     static_cast<Index>(built.mesh.n_faces());
  return {built.component_count, built.component_count - euler / 2};
}

}  // namespace

TEST_CASE("Faces that do not meet are wrapped to the solid that they stand round") {
  for (const char* name : {"capsule", "torus"}) {
    const PolygonSoup loose = loose_faces(name, 600, 0.2);
    const WrappedSoup wrapped = wrap_soup(loose);
    const Shape shape = shape_of(wrapped.soup);
    CHECK(shape.components == 1);
    CHECK(shape.genus == (std::string(name) == "torus"));
    CHECK(wrapped.solids == 1);
    REQUIRE(wrapped.vertex_of_point.size() == loose.points.size());
    for (std::size_t p = 0; p < loose.points.size(); ++p) {
      REQUIRE(wrapped.vertex_of_point[p] != kNone);
      CHECK((wrapped.soup.points[wrapped.vertex_of_point[p]] - loose.points[p]).norm() < 2.5 * wrapped.cell);
    }
  }
}

TEST_CASE("A wrap does not depend on the unit of length, however small or large") {
  const PolygonSoup loose = loose_faces("capsule", 200, 0.2);
  WrapOptions options;
  options.gap = 0.1;
  const WrappedSoup usual = wrap_soup(loose, options);
  const double unit = GENERATE(0x1p-900, 0x1p-450, 0x1p450, 0x1p900);
  const WrappedSoup wrapped = wrap_soup(moved(loose, unit, Vector3::Zero()), options);
  CHECK(wrapped.cell == unit * usual.cell);
  REQUIRE(wrapped.soup.corners == usual.soup.corners);
  for (std::size_t v = 0; v < usual.soup.points.size(); ++v)
    REQUIRE(wrapped.soup.points[v] == unit * usual.soup.points[v]);
}

TEST_CASE("A wrap whose points would be no numbers, or fall together, is refused") {
  const PolygonSoup loose = loose_faces("capsule", 200, 0.2);
  WrapOptions options;
  options.gap = 0.1;
  double reach = 0;
  for (const Vector3& p : loose.points) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  CHECK_THROWS_WITH(wrap_soup(moved(loose, 1.79e308 / reach, Vector3::Zero()), options),
                    Contains("scale it down"));
  CHECK_THROWS_WITH(wrap_soup(moved(loose, 1e-321 / reach, Vector3::Zero()), options),
                    Contains("scale it up"));
}

TEST_CASE("Solids farther apart than the gap stay apart, nearer ones become one") {
  const PolygonSoup ball = loose_faces("sphere", 400, 0.0);
  double width = 0;
  for (const Vector3& p : ball.points) width = std::max(width, 2 * std::abs(p.x()));
  const PolygonSoup two = together({ball, moved(ball, 1, {1.1 * width, 0, 0})});
  WrapOptions options;
  options.gap = 0.02;  // of an extent of about 2.5 widths
  CHECK(shape_of(wrap_soup(two, options).soup).components == 2);
  options.gap = 0.1;
  CHECK(shape_of(wrap_soup(two, options).soup).components == 1);
}

TEST_CASE("Solids with a limb between them that is pressed to a line are one") {
  SampleOptions options;
  options.resolution = 500;
  const PolygonSoup ball = make_sample("sphere", options);
  PolygonSoup both = together({ball, moved(ball, 1, {6, 0, 0})});
  CHECK(wrap_soup(both).solids == 2);
  const auto first = static_cast<Index>(both.points.size());
  both.points.insert(both.points.end(), {{1, 0, 0}, {5, 0, 0}, {5, 0, 0}});
  both.add_triangle(first, first + 1, first + 2);
  CHECK(wrap_soup(both).solids == 1);
}

TEST_CASE("Where nothing is enclosed there is a thickened wall, or nothing if that is asked for") {
  PolygonSoup half = loose_faces("sphere", 600, 0.0);
  std::vector<Index> corners;
  for (std::size_t i = 0; i < half.corners.size(); i += 3)
    if (half.points[half.corners[i]].z() < 0)
      corners.insert(corners.end(), {half.corners[i], half.corners[i + 1], half.corners[i + 2]});
  half.corners.clear();
  half.begin = {0};
  for (std::size_t i = 0; i < corners.size(); i += 3)
    half.add_triangle(corners[i], corners[i + 1], corners[i + 2]);
  const WrappedSoup wall = wrap_soup(half);
  CHECK_FALSE(wall.encloses);
  CHECK(wall.solids == 1);
  WrapOptions options;
  options.thicken_walls = false;
  const WrappedSoup nothing = wrap_soup(half, options);
  CHECK_FALSE(nothing.encloses);
  CHECK(nothing.solids == 0);
  CHECK(nothing.soup.points.empty());
  const PolygonSoup whole = loose_faces("sphere", 600, 0.2);
  const WrappedSoup solid = wrap_soup(whole, options);
  CHECK(solid.encloses);
  CHECK(solid.soup.corners == wrap_soup(whole).soup.corners);
}

TEST_CASE("A soup tells the scale of its gaps, whatever the grid that is asked") {
  const PolygonSoup fine = loose_faces("sphere", 600, 0.1), coarse = loose_faces("sphere", 60, 0.4);
  const WrappedSoup narrow = wrap_soup(fine), wide = wrap_soup(coarse);
  CHECK(narrow.encloses);
  CHECK(wide.encloses);
  CHECK(narrow.gap < wide.gap);
  CHECK(shape_of(wide.soup).genus == 0);
}

TEST_CASE("What only the largest ball cannot leave is a valley, not a solid") {
  // Hills and valleys on a square, a third of it from one valley to the next.
  constexpr Index kSteps = 40;
  PolygonSoup terrain;
  for (Index j = 0; j <= kSteps; ++j)
    for (Index i = 0; i <= kSteps; ++i) {
      const double x = i / double{kSteps}, y = j / double{kSteps};
      terrain.points.emplace_back(x, y, 0.1 * std::sin(20 * x) * std::sin(20 * y));
    }
  for (Index j = 0; j < kSteps; ++j)
    for (Index i = 0; i < kSteps; ++i) {
      const Index a = j * (kSteps + 1) + i;
      terrain.add_triangle(a, a + 1, a + kSteps + 2);
      terrain.add_triangle(a, a + kSteps + 2, a + kSteps + 1);
    }
  WrapOptions options;
  options.thicken_walls = false;
  CHECK_FALSE(wrap_soup(terrain, options).encloses);
}

TEST_CASE("Shells are walls where they shut in more than they fill") {
  WrapOptions options;
  options.thicken_walls = false;
  // A room of six slabs that cross in its edges and corners.
  Shells room;
  for (const double x : {-2.0, 1.95}) room.add({x, -1.6, -1.1}, {x + 0.05, 1.6, 1.1});
  for (const double y : {-1.5, 1.45}) room.add({-2.1, y, -1.1}, {2.1, y + 0.05, 1.1});
  for (const double z : {-1.0, 0.95}) room.add({-2.1, -1.6, z}, {2.1, 1.6, z + 0.05});
  options.filled = room.filled;
  const WrappedSoup solid = wrap_soup(room.soup, options);
  CHECK(solid.encloses);
  CHECK(solid.solids == 1);
  const Shape shape = shape_of(solid.soup);
  CHECK(shape.components == 1);
  CHECK(shape.genus == 0);
  // Without the lid it is a box that is open on purpose, and bars leave what is between them open.
  Shells tub;
  for (const double x : {-2.0, 1.95}) tub.add({x, -1.6, -1.1}, {x + 0.05, 1.6, 1.1});
  for (const double y : {-1.5, 1.45}) tub.add({-2.1, y, -1.1}, {2.1, y + 0.05, 1.1});
  tub.add({-2.1, -1.6, -1.0}, {2.1, 1.6, -0.95});
  Shells bars;
  for (int i = 0; i < 8; ++i) {
    bars.add({0.3 * i, -0.2, -0.02}, {0.3 * i + 0.04, 2.4, 0.02});
    bars.add({-0.2, 0.3 * i, -0.02}, {2.4, 0.3 * i + 0.04, 0.02});
  }
  for (const Shells* open : {&tub, &bars}) {
    options.filled = open->filled;
    CHECK_FALSE(wrap_soup(open->soup, options).encloses);
  }
}

TEST_CASE("Nooks between thin shells are no rooms") {
  // A comb of thin bars, hardly farther apart than the gap.
  Shells comb;
  for (int i = 0; i < 30; ++i)
    for (const double z : {0.0, 0.09}) {
      comb.add({0.09 * i, -0.1, z - 0.004}, {0.09 * i + 0.008, 2.7, z + 0.004});
      comb.add({-0.1, 0.09 * i, z - 0.004}, {2.7, 0.09 * i + 0.008, z + 0.004});
    }
  WrapOptions options;
  options.thicken_walls = false;
  options.filled = comb.filled;
  CHECK_FALSE(wrap_soup(comb.soup, options).encloses);
}

TEST_CASE("Plane walls of a wrap are cut to no slivers, which would keep a surface from being coarsened") {
  // A cross of plates along the grid's axes, and one aslant to them.
  const PolygonSoup plates =
      together({box({-2, -1.5, -0.02}, {2, 1.5, 0.02}), box({-0.02, -1.2, -1}, {0.02, 1.2, 1})});
  PolygonSoup aslant = plates;
  for (Vector3& p : aslant.points) p = Vector3(p.x() - 0.3 * p.y(), p.y() + 0.2 * p.z(), p.z() + 0.4 * p.x());
  for (const PolygonSoup& soup : {plates, aslant}) {
    const WrappedSoup wrapped = wrap_soup(soup);
    const Shape shape = shape_of(wrapped.soup);
    CHECK(shape.components == 1);
    CHECK(shape.genus == 0);
    const SurfaceSnapshot surface = make_snapshot(build_mesh(wrapped.soup));
    Index short_edges = 0;
    for (Index h = 0; h < surface.halfedge_count(); ++h)
      short_edges += surface.edge_length(h) * surface.frame.scale < 0.4 * wrapped.cell;
    CHECK(short_edges < surface.halfedge_count() / 20);
    CoarseningOptions options;
    options.vertices = surface.vertex_count() / 8;
    CHECK(coarsen_surface(surface, options).surface.vertex_count() == options.vertices);
  }
}

TEST_CASE("What wraps a mesh is moved and scaled along with it") {
  const PolygonSoup loose = loose_faces("capsule", 300, 0.1);
  const WrappedSoup one = wrap_soup(loose), other = wrap_soup(moved(loose, 1024, {0, 0, 0}));
  CHECK(other.cell == Approx(1024 * one.cell));
  REQUIRE(other.soup.corners == one.soup.corners);
  for (std::size_t v = 0; v < one.soup.points.size(); ++v)
    CHECK((other.soup.points[v] - 1024 * one.soup.points[v]).norm() < 1e-6 * other.cell);
}

TEST_CASE("What cannot be wrapped is refused") {
  PolygonSoup nothing;
  nothing.points.assign(3, Vector3::Zero());
  CHECK_THROWS_AS(wrap_soup(nothing), MeshError);
  nothing.add_triangle(0, 1, 2);
  CHECK_THROWS_AS(wrap_soup(nothing), MeshError);
  WrapOptions options;
  options.gap = 0.3;
  CHECK_THROWS_AS(wrap_soup(nothing, options), UsageError);
  options = {};
  options.filled = -1;
  CHECK_THROWS_AS(wrap_soup(nothing, options), UsageError);
}

TEST_CASE("a finer wrap asks more often whether to stop, and stops") {
  const PolygonSoup soup = loose_faces("sphere", 2000, 0.2);
  int asked[2] = {0, 0};
  for (const int k : {0, 1}) {
    WrapOptions options;
    options.gap = k == 0 ? 0.08 : 0.02;
    Execution execution;
    execution.progress = [&](const char*, double) { return ++asked[k] > 0; };
    (void)wrap_soup(soup, options, execution);
  }
  CHECK(asked[0] > 20);
  CHECK(asked[1] > 4 * asked[0]);
  Execution execution;
  int again = 0;
  execution.progress = [&](const char*, double) { return ++again < asked[0] / 2; };
  CHECK_THROWS_AS(wrap_soup(soup, {}, execution), Cancelled);
  CHECK(again == asked[0] / 2);
}
