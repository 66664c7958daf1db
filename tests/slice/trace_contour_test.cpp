// Slice tracing against an independent section of all triangles, and its special positions by hand.
#include "mspskel/slice/trace_contour.h"

#include <catch2/catch.hpp>
#include <set>

#include "mspskel/slice/vertex_frame.h"
#include "slice/plane_section.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SliceTracer::Shortest unbounded(const SliceTracer& tracer, Index v, const Vector3& normal) {
  std::int64_t steps = 0;
  return tracer.shortest_through(v, normal, kInfinity, steps);
}

Contour contour_of(const SliceTracer& tracer, Index v, const Vector3& normal) {
  Contour contour;
  std::int64_t steps = 0;
  if (!tracer.shortest_contour(v, normal, contour, steps)) contour = {};
  return contour;
}

// The contour, valid or not, that starts at v: found by walking from the one edge opposite to v at which the
// sign changes from + to − counter-clockwise.
Contour any_contour(const SurfaceSnapshot& s, const SliceTracer& tracer, Index v, const Vector3& normal) {
  const Plane plane{normal, normal.dot(s.position[v])};
  Contour contour;
  Index h = s.vertex_halfedge[v];
  do {
    if (plane.signed_distance(s.position[s.target(h)]) >= 0 &&
        plane.signed_distance(s.position[s.apex(h)]) < 0) {
      tracer.trace(s.twin[SurfaceSnapshot::next(h)], plane, v, contour);
      return contour;
    }
    h = s.next_outgoing(h);
  } while (h != s.vertex_halfedge[v]);
  return contour;
}

}  // namespace

TEST_CASE("shortest contours agree with a section of all triangles") {
  const DefaultMesh mesh = GENERATE(jittered(torus(1.0, 0.6, 14, 10), 3, 0.15), jittered(cube(), 5, 0.1),
                                    jittered(prism(5, 3.0, 4), 7, 0.1));
  const SurfaceSnapshot s = make_snapshot(mesh);
  const SliceTracer tracer(s);
  test::Random random(11);
  for (int vertex = 0; vertex < 12; ++vertex) {
    const Index v = random.below(s.vertex_count());
    const VertexFrame frame = make_vertex_frame(s, v);
    double least = kInfinity, expected_least = kInfinity;
    for (int i = 0; i < 120; ++i) {
      // Half of the planes hold the normal, as the MSP function's do; half are any plane.
      const Vector3 normal = i % 2 ? plane_normal(frame.u, frame.v, random.uniform(0, kPi))
                                   : Vector3(random.in_ball().normalized());
      const double expected = shortest_section(s, v, normal);
      std::int64_t steps = 0;
      const auto found = tracer.shortest_through(v, normal, kInfinity, steps);
      CHECK((found.start == kNone) == std::isinf(expected));
      if (found.start != kNone) CHECK(found.perimeter == Approx(expected).epsilon(1e-9));
      expected_least = std::min(expected_least, expected);
      least = std::min(least, tracer.shortest_through(v, normal, least, steps).perimeter);
    }
    CHECK(least == Approx(expected_least).epsilon(1e-9));
  }
}

TEST_CASE("the early stop is exact and saves steps") {
  const SurfaceSnapshot s = make_snapshot(jittered(torus(1.0, 0.6, 24, 16), 4, 0.15));
  const SliceTracer tracer(s);
  test::Random random(2);
  std::int64_t steps_all = 0, steps_half = 0;
  for (int i = 0; i < 200; ++i) {
    const Index v = random.below(s.vertex_count());
    const Vector3 normal = random.in_ball().normalized();
    std::int64_t all = 0, above = 0, at = 0, half = 0;
    const auto whole = tracer.shortest_through(v, normal, kInfinity, all);
    if (whole.start == kNone) continue;
    const auto loose = tracer.shortest_through(v, normal, whole.perimeter * (1 + 1e-9), above);
    CHECK(loose.perimeter == whole.perimeter);
    CHECK(loose.start == whole.start);
    const auto tight = tracer.shortest_through(v, normal, whole.perimeter, at);
    CHECK(tight.start == kNone);
    CHECK(std::isinf(tight.perimeter));
    CHECK(tracer.shortest_through(v, normal, whole.perimeter / 2, half).start == kNone);
    CHECK(half <= at);
    CHECK(at <= all);
    steps_all += all;
    steps_half += half;
  }
  CHECK(4 * steps_half < 3 * steps_all);
}

TEST_CASE("at a saddle every contour through the vertex is tried") {
  // The plane x = R − r touches the torus at the inner equator and cuts it in two lobes that meet there.
  const DefaultMesh base = torus(1.0, 0.4, 24, 16);
  const Index p = 8;
  for (int seed = 1; seed <= 8; ++seed) {
    const DefaultMesh mesh = jittered(base, seed, 0.05);
    const SurfaceSnapshot s = make_snapshot(mesh);
    const SliceTracer tracer(s);
    std::vector<double> through;
    for (const SectionLoop& loop : plane_section(s, p, Vector3::UnitX()))
      if (loop.through_vertex) through.push_back(loop.perimeter);
    REQUIRE(through.size() == 2);
    CHECK(std::abs(through[0] - through[1]) > 1e-6);
    const auto found = unbounded(tracer, p, Vector3::UnitX());
    CHECK(found.perimeter == Approx(std::min(through[0], through[1])).epsilon(1e-9));
  }
}

TEST_CASE("a plane through edges follows them") {
  const DefaultMesh mesh = octahedron();
  const SurfaceSnapshot s = make_snapshot(mesh);
  const SliceTracer tracer(s);
  for (Index v = 0; v < 4; ++v)
    for (const Vector3& normal : {Vector3(0, 0, 1), Vector3(0, 0, -1)}) {
      const Contour contour = contour_of(tracer, v, normal);
      CHECK(contour.perimeter * s.frame.scale == Approx(4 * std::sqrt(2.0)));
      CHECK(contour.area * s.frame.scale * s.frame.scale == Approx(2.0));
    }
}

TEST_CASE("a plane through a whole face takes its rim from one side and nothing from the other") {
  const Index n = 6;
  const SurfaceSnapshot s = make_snapshot(prism(n, 2.0, 3));
  const SliceTracer tracer(s);
  const Index rim = 3 * n, middle = 4 * n + 1;
  const double expected = 2.0 * n * std::sin(kPi / n);
  const auto outward = unbounded(tracer, rim, Vector3::UnitZ());
  CHECK(outward.perimeter * s.frame.scale == Approx(expected));
  CHECK(unbounded(tracer, rim, -Vector3::UnitZ()).start == kNone);
  // The cap's centre sees no negative neighbour either way: a contour of length 0 must not win.
  CHECK(unbounded(tracer, middle, Vector3::UnitZ()).start == kNone);
  CHECK(unbounded(tracer, middle, -Vector3::UnitZ()).start == kNone);
}

TEST_CASE("a vertex above all its neighbours has no contour") {
  const SurfaceSnapshot s = make_snapshot(tetrahedron());
  const SliceTracer tracer(s);
  CHECK(unbounded(tracer, 3, Vector3::UnitZ()).start == kNone);
  CHECK(unbounded(tracer, 3, -Vector3::UnitZ()).start == kNone);
}

TEST_CASE("a contour crosses each edge once, from negative to positive, and is a closed cocycle") {
  const SurfaceSnapshot s = make_snapshot(jittered(torus(1.0, 0.5, 20, 12), 9, 0.15));
  const SliceTracer tracer(s);
  test::Random random(6);
  int contours = 0;
  for (int i = 0; i < 60; ++i) {
    const Index v = random.below(s.vertex_count());
    const Vector3 normal = random.in_ball().normalized();
    const Contour contour = contour_of(tracer, v, normal);
    if (contour.halfedge.empty()) continue;
    ++contours;
    REQUIRE(contour.point.size() == contour.halfedge.size());
    REQUIRE(contour.weight.size() == contour.halfedge.size());
    std::vector<int> label(s.halfedge_count(), 0);
    const Plane plane{normal, normal.dot(s.position[v])};
    for (std::size_t k = 0; k < contour.halfedge.size(); ++k) {
      const Index h = contour.halfedge[k];
      CHECK(label[h] == 0);
      label[h] = 1;
      label[s.twin[h]] = -1;
      const Vector3 &a = s.position[s.origin[h]], &b = s.position[s.target(h)];
      CHECK(plane.signed_distance(a) < 0);
      CHECK((s.target(h) == v || plane.signed_distance(b) >= 0));
      CHECK((contour.point[k] - (a + contour.weight[k] * (b - a))).norm() < 1e-12);
      CHECK(std::abs(plane.signed_distance(contour.point[k])) < 1e-12);
      const Index next = contour.halfedge[(k + 1) % contour.halfedge.size()];
      CHECK((SurfaceSnapshot::face(s.twin[next]) == SurfaceSnapshot::face(h)));
    }
    for (Index f = 0; f < s.face_count(); ++f) CHECK(label[3 * f] + label[3 * f + 1] + label[3 * f + 2] == 0);
  }
  CHECK(contours > 40);
}

TEST_CASE("areas are positive round material and negative round a hole, whichever way the normal points") {
  const double major = 1.0, minor = 0.4;
  const Index nu = 64, nv = 32;
  const SurfaceSnapshot s = make_snapshot(torus(major, minor, nu, nv));
  const SliceTracer tracer(s);
  const double unit = s.frame.scale * s.frame.scale;
  for (const Vector3& normal : {Vector3(0, 0, 1), Vector3(0, 0, -1)}) {
    // The plane of the ring: the outer circle bounds material, the inner one the hole.
    const Contour outer = any_contour(s, tracer, 0, normal), inner = any_contour(s, tracer, nv / 2, normal);
    CHECK(outer.area * unit == Approx(kPi * 1.4 * 1.4).epsilon(0.01));
    CHECK(inner.area * unit == Approx(-kPi * 0.6 * 0.6).epsilon(0.01));
    CHECK(unbounded(tracer, 0, normal).perimeter * s.frame.scale == Approx(2 * kPi * 1.4).epsilon(0.01));
    CHECK(unbounded(tracer, nv / 2, normal).start == kNone);
  }
  for (const Vector3& normal : {Vector3(0, 1, 0), Vector3(0, -1, 0)})
    CHECK(contour_of(tracer, 0, normal).area * unit == Approx(kPi * minor * minor).epsilon(0.02));
}
