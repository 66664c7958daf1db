// Distance, rays and inside against brute force over all triangles, and against solids that are known.
#include "mspskel/mesh/bounding_volume_hierarchy.h"

#include <catch2/catch.hpp>
#include <map>
#include <random>

using namespace mspskel;

namespace {

using Soup = std::pair<std::vector<Vector3>, std::vector<std::array<int, 3>>>;

// An octahedron, each face split in four `levels` times, on the sphere.
Soup sphere(const Vector3& centre, double radius, int levels, bool outward = true) {
  std::vector<Vector3> p{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> f{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto split = [&](int a, int b) {
      const auto key = std::minmax(a, b);
      const auto [it, added] = middle.insert({key, static_cast<int>(p.size())});
      if (added) p.push_back((p[a] + p[b]).normalized());
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : f) {
      const int ab = split(a, b), bc = split(b, c), ca = split(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    f = finer;
  }
  for (Vector3& x : p) x = centre + radius * x;
  if (!outward)
    for (auto& t : f) std::swap(t[1], t[2]);
  return {p, f};
}

Soup torus(double major, double minor, int around, int across) {
  Soup s;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double a = 2 * kPi * i / around, b = 2 * kPi * j / across, r = major + minor * std::cos(b);
      s.first.emplace_back(r * std::cos(a), r * std::sin(a), minor * std::sin(b));
      const auto at = [&](int x, int y) { return (x % around) * across + y % across; };
      s.second.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.second.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return s;
}

Soup box(const Vector3& low, const Vector3& high) {
  Soup s;
  for (int k = 0; k < 8; ++k)
    s.first.emplace_back(k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]);
  s.second = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
              {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return s;
}

SurfaceSnapshot snapshot(const std::vector<Soup>& parts) {
  DefaultMesh mesh;
  for (const Soup& part : parts) {
    std::vector<DefaultMesh::VertexHandle> v;
    for (const Vector3& p : part.first) v.push_back(mesh.add_vertex({p[0], p[1], p[2]}));
    for (const auto& [a, b, c] : part.second) mesh.add_face(v[a], v[b], v[c]);
  }
  return make_snapshot(mesh);
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
  const SurfaceSnapshot s = snapshot({torus(2, 0.7, 24, 12)});
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

TEST_CASE("rays find the brute-force hits, from near and from far") {
  const SurfaceSnapshot s = snapshot({torus(2, 0.7, 24, 12), sphere({0, 0, 0}, 0.8, 2)});
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

TEST_CASE("a fan of rays is its rays") {
  const SurfaceSnapshot s = snapshot({torus(2, 0.7, 24, 12), sphere({0.1, 0, 0}, 0.8, 2)});
  const BoundingVolumeHierarchy tree(s);
  Points random;
  for (int i = 0; i < 100; ++i) {
    const Vector3 p = random(), t = random().normalized(), u = t.unitOrthogonal(), w = t.cross(u);
    std::array<double, 24> fan;
    tree.ray_fan(p, u, w, 24, fan.data());
    for (int k = 0; k < 24; ++k) {
      const auto hit = tree.first_hit(p, std::cos(2 * kPi * k / 24) * u + std::sin(2 * kPi * k / 24) * w);
      CHECK(std::isfinite(fan[k]) == hit.has_value());
      if (hit) CHECK(fan[k] == Approx(hit->distance).epsilon(1e-9).margin(1e-12));
    }
  }
}

TEST_CASE("nested shells: a cavity is outside, whatever the shells' orientations") {
  for (const bool outward : {true, false}) {
    const SurfaceSnapshot s =
        snapshot({sphere({0, 0, 0}, 3, 3), sphere({0, 0, 0}, 2, 3, outward), sphere({0, 0, 0}, 1, 3)});
    const BoundingVolumeHierarchy tree(s);
    Points random;
    for (int i = 0; i < 500; ++i) {
      const Vector3 p = random();
      const double r = s.frame.to_model(p).norm();
      if (std::abs(r - std::round(r)) < 0.06) continue;  // between the sphere and its polyhedron
      CHECK(tree.inside(p) == (r < 1 || (r > 2 && r < 3)));
    }
  }
}

TEST_CASE("points in line with edges, corners and faces are told inside from outside") {
  const SurfaceSnapshot s = snapshot({box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {3, 1, 1})});
  const BoundingVolumeHierarchy tree(s);
  for (double x = -0.5; x <= 3.5; x += 0.125)
    for (double y = -0.5; y <= 1.5; y += 0.125)
      for (const double z : {-0.5, 0.0, 0.5, 1.0, 1.5}) {
        const auto within = [](double v, double low, double high) { return v >= low && v <= high; };
        const bool on_face_or_in = (within(x, 0, 1) || within(x, 2, 3)) && within(y, 0, 1) && within(z, 0, 1);
        const bool strictly_in = ((x > 0 && x < 1) || (x > 2 && x < 3)) && y > 0 && y < 1 && z > 0 && z < 1;
        // On the faces the frame's rounding decides; elsewhere there is one answer.
        if (on_face_or_in != strictly_in) continue;
        CHECK(tree.inside(s.frame.to_normalised({x, y, z})) == strictly_in);
      }
  for (Index v = 0; v < s.vertex_count(); ++v) CHECK(tree.inside(s.position[v]));
}

TEST_CASE("a segment crosses the surface exactly if some triangle parts its ends") {
  const SurfaceSnapshot s = snapshot({torus(2, 0.7, 24, 12)});
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
  const SurfaceSnapshot s = snapshot({torus(2, 0.7, 24, 12)});
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
