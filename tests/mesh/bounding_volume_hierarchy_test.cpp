// Distance, rays and inside against brute force over all triangles, and against solids that are known.
#include "mspskel/mesh/bounding_volume_hierarchy.h"

#include <catch2/catch.hpp>
#include <random>

#include "mspskel/mesh/detail/triangle_queries.h"
#include "support/meshes.h"

using namespace mspskel;

namespace {

// Several meshes as one surface.
SurfaceSnapshot snapshot(const std::vector<DefaultMesh>& parts) {
  PolygonSoup soup;
  for (const DefaultMesh& part : parts) append(soup, test::to_soup(part));
  return make_snapshot(test::to_mesh(soup));
}

DefaultMesh sphere(double radius) { return test::scaled(test::sphere(300), radius); }

DefaultMesh inverted(const DefaultMesh& mesh) {
  PolygonSoup soup = test::to_soup(mesh);
  reverse_orientation(soup);
  return test::to_mesh(soup);
}

detail::Triangle triangle(const SurfaceSnapshot& s, Index f) {
  return {s.position[s.origin[3 * f]], s.position[s.origin[3 * f + 1]], s.position[s.origin[3 * f + 2]]};
}

struct Points {
  std::mt19937 generator{7};
  std::uniform_real_distribution<double> uniform{-0.8, 0.8};
  Vector3 operator()() { return {uniform(generator), uniform(generator), uniform(generator)}; }
};

// Distance to a triangle by another way: the foot of the perpendicular if it is inside, else the nearest
// edge.
double plain_distance(const Vector3& p, const detail::Triangle& t) {
  const auto to_segment = [&](const Vector3& a, const Vector3& b) {
    const double s = (p - a).dot(b - a) / (b - a).squaredNorm();
    return (a + std::min(1.0, std::max(0.0, s)) * (b - a) - p).norm();
  };
  const Vector3 n = (t.b - t.a).cross(t.c - t.a).normalized();
  const Vector3 foot = p - n.dot(p - t.a) * n;
  const bool over = n.dot((t.b - t.a).cross(foot - t.a)) >= 0 && n.dot((t.c - t.b).cross(foot - t.b)) >= 0 &&
                    n.dot((t.a - t.c).cross(foot - t.c)) >= 0;
  return over ? std::abs(n.dot(p - t.a))
              : std::min({to_segment(t.a, t.b), to_segment(t.b, t.c), to_segment(t.c, t.a)});
}

}  // namespace

TEST_CASE("the closest point is the brute-force one, at any distance and with any bound") {
  const SurfaceSnapshot s = snapshot({test::torus(2, 0.7, 24, 12)});
  const BoundingVolumeHierarchy tree(s);
  Points random;
  for (int i = 0; i < 300; ++i) {
    const Vector3 p = random() * std::pow(10.0, i % 7 - 2);
    double best = std::numeric_limits<double>::infinity();
    for (Index f = 0; f < s.face_count(); ++f) best = std::min(best, plain_distance(p, triangle(s, f)));
    const ClosestPoint c = tree.closest(p);
    CHECK(c.distance == Approx(best).epsilon(1e-12));
    CHECK((c.point - p).norm() == Approx(c.distance).epsilon(1e-12));
    CHECK(plain_distance(c.point, triangle(s, c.face)) < 1e-14);
    CHECK(tree.closest(p, best * 1.001).distance == c.distance);
    CHECK(tree.closest(p, best * 0.999).face == kNone);
  }
}

TEST_CASE("the closest point of a triangle without area lies on it") {
  Points random;
  for (int i = 0; i < 3000; ++i) {
    // All corners on a line, moved off it by no more than rounding, or all at one point.
    const Vector3 a = random(), along = i % 10 == 0 ? Vector3::Zero() : random();
    const double off = i % 3 == 0 ? 0 : std::pow(10.0, -15 - i % 150);
    const detail::Triangle t{a, a + random()[0] * along + off * random(),
                             a + random()[0] * along + off * random()};
    const Vector3 p = a + random()[0] * along + std::pow(10.0, i % 5 - 4.0) * random();
    const Vector3 q = detail::closest_on_triangle(p, t);
    REQUIRE(q.allFinite());
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 200; ++k)
      for (const auto& [from, to] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)})
        best = std::min(best, (from + k / 200.0 * (to - from) - p).norm());
    CHECK((q - p).norm() <= best * (1 + 1e-9) + 1e-14);
    CHECK(detail::closest_on_sides(q, t).isApprox(q, 1e-9));
  }
}

TEST_CASE("rays find the brute-force hits, from near and from far") {
  const SurfaceSnapshot s = snapshot({test::torus(2, 0.7, 24, 12), sphere(0.8)});
  const BoundingVolumeHierarchy tree(s);
  Points random;
  int hits = 0;
  for (int i = 0; i < 600; ++i) {
    const Vector3 d = random().normalized(), o = random() - (i % 3 == 0 ? 1e5 : 0.0) * d;
    double first = std::numeric_limits<double>::infinity();
    Index count = 0;
    for (Index f = 0; f < s.face_count(); ++f) {
      const detail::Triangle t = triangle(s, f);
      Eigen::Matrix3d m;
      m << t.b - t.a, t.c - t.a, -d;
      const Vector3 x = m.inverse() * (o - t.a);
      if (x[0] < 0 || x[1] < 0 || x[0] + x[1] > 1 || x[2] < 0) continue;
      first = std::min(first, x[2]);
      ++count;
    }
    CHECK(tree.count_hits(o, d) == count);
    const auto hit = tree.first_hit(o, 3 * d);
    REQUIRE(hit.has_value() == (count > 0));
    if (!hit) continue;
    ++hits;
    CHECK(hit->distance == Approx(first).epsilon(1e-9));
    CHECK(tree.first_hit(o, d, first * (1 + 1e-9))->face == hit->face);
    CHECK_FALSE(tree.first_hit(o, d, first * (1 - 1e-9)).has_value());
  }
  CHECK(hits > 100);
}

TEST_CASE("a fan of rays is its rays, near the surface, far from it and outside") {
  const SurfaceSnapshot s = snapshot({test::torus(2, 0.7, 48, 24), sphere(0.8)});
  const BoundingVolumeHierarchy tree(s);
  Points random;
  constexpr int kRays = 24;
  for (int i = 0; i < 400; ++i) {
    const Vector3 t = random().normalized(), u = t.unitOrthogonal(), w = t.cross(u);
    const Index v = (37 * i) % s.vertex_count();
    const std::array<Vector3, 4> from{random(), 1e4 * random(), s.position[v] - 1e-3 * s.normal[v],
                                      s.position[v] - 0.1 * s.normal[v]};
    const Vector3& p = from[i % 4];
    std::array<double, kRays> fan;
    tree.ray_fan(p, u, w, kRays, fan.data());
    for (int k = 0; k < kRays; ++k) {
      const double angle = 2 * kPi * k / kRays;
      const auto hit = tree.first_hit(p, std::cos(angle) * u + std::sin(angle) * w);
      CHECK(std::isfinite(fan[k]) == hit.has_value());
      if (hit) CHECK(fan[k] == Approx(hit->distance).epsilon(1e-9).margin(1e-12));
    }
  }
}

TEST_CASE("nested shells: a cavity is outside, whatever the shells' orientations") {
  for (const bool outward : {true, false}) {
    const SurfaceSnapshot s = snapshot({sphere(3), outward ? sphere(2) : inverted(sphere(2)), sphere(1)});
    const BoundingVolumeHierarchy tree(s);
    Points random;
    for (int i = 0; i < 500; ++i) {
      const Vector3 p = random();
      const double r = s.frame.to_model(p).norm();
      if (std::abs(r - std::round(r)) < 0.1) continue;  // between the sphere and its polyhedron
      CHECK(tree.inside(p) == (r < 1 || (r > 2 && r < 3)));
    }
  }
}

TEST_CASE("points in line with edges, corners and faces are told inside from outside") {
  const SurfaceSnapshot s = snapshot({test::cube(), test::translated(test::cube(), {4, 0, 0})});
  const BoundingVolumeHierarchy tree(s);
  for (double x = -1.5; x <= 5.5; x += 0.25)
    for (double y = -1.5; y <= 1.5; y += 0.25)
      for (const double z : {-1.5, -1.0, 0.0, 0.5, 1.0}) {
        const double far = std::max({std::min(std::abs(x), std::abs(x - 4)), std::abs(y), std::abs(z)});
        if (far == 1) continue;  // on a face, rounding decides
        CHECK(tree.inside(s.frame.to_normalised({x, y, z})) == (far < 1));
      }
  for (Index v = 0; v < s.vertex_count(); ++v) CHECK(tree.inside(s.position[v]));
}

TEST_CASE("a segment crosses the surface exactly if some triangle parts its ends") {
  const SurfaceSnapshot s = snapshot({test::torus(2, 0.7, 24, 12)});
  const BoundingVolumeHierarchy tree(s);
  Points random;
  int crossing = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3 a = 0.5 * random(), b = a + 0.4 * random();
    const Index hits = tree.count_hits(a, b - a, (b - a).norm());
    CHECK(tree.segment_crosses(a, b) == (hits > 0));
    CHECK(tree.segment_crosses(b, a) == (hits > 0));
    crossing += hits > 0;
  }
  CHECK(crossing > 50);
  // From the surface inward: an end on the surface does not count, passing a vertex does.
  for (Index v = 0; v < s.vertex_count(); v += 7) {
    const Vector3 in = s.position[v] - 0.01 * s.normal[v], out = s.position[v] + 0.01 * s.normal[v];
    CHECK_FALSE(tree.segment_crosses(in, s.position[v]));
    CHECK(tree.segment_crosses(in, out));
  }
}

TEST_CASE("boxes are searched completely") {
  const SurfaceSnapshot s = snapshot({test::torus(2, 0.7, 24, 12)});
  const BoundingVolumeHierarchy tree(s);
  Points random;
  for (int i = 0; i < 100; ++i) {
    const Vector3 a = random(), b = random(), low = a.cwiseMin(b), high = a.cwiseMax(b);
    std::vector<bool> found(s.face_count(), false);
    tree.for_each_in_box(low, high, [&](Index f) { return found[f] = true; });
    for (Index f = 0; f < s.face_count(); ++f) {
      const detail::Triangle t = triangle(s, f);
      const Vector3 tl = t.a.cwiseMin(t.b).cwiseMin(t.c), th = t.a.cwiseMax(t.b).cwiseMax(t.c);
      if ((tl.array() <= high.array()).all() && (th.array() >= low.array()).all()) CHECK(found[f]);
    }
  }
}

TEST_CASE("of a box on a plane all faces that cross the plane are found, and few that do not") {
  const SurfaceSnapshot s = snapshot({test::torus(2, 0.7, 96, 48)});
  const BoundingVolumeHierarchy tree(s);
  Points random;
  Index visited = 0, crossing = 0;
  for (int i = 0; i < 50; ++i) {
    const Vector3 low = Vector3::Constant(-2), high = Vector3::Constant(2), normal = random().normalized();
    const double offset = 0.1 * random().x();
    std::vector<bool> found(s.face_count(), false);
    tree.for_each_in_box_on_plane(low, high, normal, offset, [&](Index f) {
      if (f != kNone && !found[f]) ++visited;
      return f == kNone || (found[f] = true);
    });
    for (Index f = 0; f < s.face_count(); ++f) {
      const detail::Triangle t = triangle(s, f);
      const double a = normal.dot(t.a) - offset, b = normal.dot(t.b) - offset, c = normal.dot(t.c) - offset;
      if (std::max({a, b, c}) < 0 || std::min({a, b, c}) > 0) continue;
      ++crossing;
      CHECK(found[f]);
    }
  }
  CHECK(crossing > 5000);
  CHECK(visited < 6 * crossing);  // all faces are 25 times as many
}

TEST_CASE("making a hierarchy can be cancelled") {
  const SurfaceSnapshot s = snapshot({test::sphere(6000)});
  int asked = 0;
  CHECK_THROWS_AS(BoundingVolumeHierarchy(s, [&](const char*, double) { return ++asked < 2; }), Cancelled);
  CHECK(asked == 2);
}
