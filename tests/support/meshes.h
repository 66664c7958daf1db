// Small closed meshes with known geometry, and ways to change a mesh without changing its surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "mspskel/base/types.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/mesh/default_mesh.h"
#include "mspskel/mesh/polygon_soup.h"
#include "mspskel/samples/samples.h"
#include "mspskel/samples/shapes.h"

namespace mspskel::test {

// OpenMesh leaves a face out that would make an edge or vertex non-manifold: here that is a failure.
inline DefaultMesh to_mesh(const PolygonSoup& soup) {
  DefaultMesh mesh;
  std::vector<DefaultMesh::VertexHandle> handle;
  for (const Vector3& p : soup.points) handle.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    std::vector<DefaultMesh::VertexHandle> face;
    for (Index c = soup.begin[f]; c < soup.begin[f + 1]; ++c) face.push_back(handle[soup.corners[c]]);
    if (!mesh.add_face(face).is_valid())
      throw std::logic_error("face " + std::to_string(f) + " is not manifold");
  }
  return mesh;
}

using mspskel::to_soup;

inline double signed_volume(const DefaultMesh& mesh) {
  double sum = 0;
  for (const auto f : mesh.faces()) {
    auto v = mesh.cfv_iter(f);
    const Vector3 a = to_vector3(mesh.point(*v++)), b = to_vector3(mesh.point(*v++)),
                  c = to_vector3(mesh.point(*v));
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

// ---- Small polyhedra

inline DefaultMesh from_triangles(const std::vector<Vector3>& points,
                                  const std::vector<std::array<Index, 3>>& faces) {
  PolygonSoup soup;
  soup.points = points;
  for (const auto& f : faces) soup.add_triangle(f[0], f[1], f[2]);
  return to_mesh(soup);
}

// Corners at the origin and at 1 on each axis.
inline DefaultMesh tetrahedron() {
  return from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

// Corners at ±1 on each axis.
inline DefaultMesh octahedron() {
  return from_triangles(
      {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
}

// The cube [-1, 1]³, two triangles a side.
inline DefaultMesh cube() {
  return from_triangles(
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
      {{0, 2, 1},
       {0, 3, 2},
       {4, 5, 6},
       {4, 6, 7},
       {0, 1, 5},
       {0, 5, 4},
       {1, 2, 6},
       {1, 6, 5},
       {2, 3, 7},
       {2, 7, 6},
       {3, 0, 4},
       {3, 4, 7}});
}

// ---- Grids of vertices: (ring, segment) has the index ring · segments + segment

// Rings of `segments` vertices each, the position given by at(ring, segment); apexes close both ends.
inline DefaultMesh stacked_rings(Index segments, Index rings, const std::function<Vector3(Index, Index)>& at,
                                 const Vector3& bottom, const Vector3& top) {
  PolygonSoup soup;
  for (Index ring = 0; ring < rings; ++ring)
    for (Index i = 0; i < segments; ++i) soup.points.push_back(at(ring, i));
  soup.points.push_back(bottom);
  soup.points.push_back(top);
  const Index b = rings * segments, t = b + 1;
  for (Index i = 0; i < segments; ++i) {
    const Index j = (i + 1) % segments;
    soup.add_triangle(b, j, i);
    soup.add_triangle(t, (rings - 1) * segments + i, (rings - 1) * segments + j);
    for (Index ring = 0; ring + 1 < rings; ++ring) {
      const Index below = ring * segments, above = below + segments;
      soup.add_triangle(below + i, below + j, above + j);
      soup.add_triangle(below + i, above + j, above + i);
    }
  }
  return to_mesh(soup);
}

// Right prism, round the z axis, over the regular n-gon with corners at distance 1: rings + 1 levels from z =
// 0 to `height`, flat caps as fans. A slice across has the perimeter 2 n sin(π/n) exactly.
inline DefaultMesh prism(Index n, double height, Index rings) {
  const auto at = [=](Index ring, Index i) {
    const double angle = 2 * kPi * i / n;
    return Vector3(std::cos(angle), std::sin(angle), height * ring / rings);
  };
  return stacked_rings(n, rings + 1, at, {0, 0, 0}, {0, 0, height});
}

// Cylinder round the z axis from z = 0 to `length`, flat caps as fans, no two rings alike: each is turned by
// a share of a segment and the inner ones are shifted along the axis by up to a fifth of their distance.
inline DefaultMesh tube(double radius, double length, Index segments, Index rings) {
  const auto at = [=](Index ring, Index i) {
    const double angle = 2 * kPi * (i + 0.5 * ring + 0.1 * std::sin(1.7 * ring)) / segments;
    const double shift = ring == 0 || ring == rings ? 0.0 : 0.2 * std::sin(2.3 * ring);
    return Vector3(radius * std::cos(angle), radius * std::sin(angle), length * (ring + shift) / rings);
  };
  return stacked_rings(segments, rings + 1, at, {0, 0, 0}, {0, 0, length});
}

// Torus round the z axis on a regular grid: nu steps round the axis, nv round the tube; vertex (i, j) has the
// index i · nv + j.
inline DefaultMesh torus(double major, double minor, Index nu, Index nv) {
  PolygonSoup soup;
  for (Index i = 0; i < nu; ++i)
    for (Index j = 0; j < nv; ++j) {
      const double u = 2 * kPi * i / nu, v = 2 * kPi * j / nv, rho = major + minor * std::cos(v);
      soup.points.push_back({rho * std::cos(u), rho * std::sin(u), minor * std::sin(v)});
    }
  for (Index i = 0; i < nu; ++i)
    for (Index j = 0; j < nv; ++j) {
      const Index a = i * nv + j, b = (i + 1) % nu * nv + j, c = (i + 1) % nu * nv + (j + 1) % nv,
                  d = i * nv + (j + 1) % nv;
      soup.add_triangle(a, b, c);
      soup.add_triangle(a, c, d);
    }
  return to_mesh(soup);
}

// A block whose top is the graph z = 1 + 0.3 r² cos(lobes · angle): vertex 0 is its centre, a saddle with
// `lobes` ways down (2: ordinary, 3: monkey saddle). Rings of `segments` vertices each, flat bottom at z = 0.
inline DefaultMesh saddle(Index lobes, Index segments, Index rings) {
  PolygonSoup soup;
  soup.points.push_back({0, 0, 1});
  const auto index = [=](Index ring, Index i) { return 1 + ring * segments + i % segments; };
  for (Index ring = 0; ring <= rings; ++ring)
    for (Index i = 0; i < segments; ++i) {
      const Index step = std::min(ring + 1, rings);
      const double r = static_cast<double>(step) / rings, angle = 2 * kPi * (i + 0.31 * step) / segments;
      const double z = ring == rings ? 0.0 : 1 + 0.3 * r * r * std::cos(lobes * angle);
      soup.points.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
  soup.points.push_back({0, 0, 0});
  const auto bottom = static_cast<Index>(soup.points.size()) - 1;
  for (Index i = 0; i < segments; ++i) {
    soup.add_triangle(0, index(0, i), index(0, i + 1));
    soup.add_triangle(bottom, index(rings, i + 1), index(rings, i));
    for (Index ring = 0; ring < rings; ++ring) {
      soup.add_triangle(index(ring, i), index(ring + 1, i), index(ring + 1, i + 1));
      soup.add_triangle(index(ring, i), index(ring + 1, i + 1), index(ring, i + 1));
    }
  }
  return to_mesh(soup);
}

// Three tubes that meet: three leaves and a joint.
inline DefaultMesh y_tube(Index vertices) {
  SampleOptions options;
  options.resolution = vertices;
  return to_mesh(make_sample("y-tube", options));
}

// Unit sphere with about `vertices` vertices, quasi-uniform, without ties.
inline DefaultMesh sphere(Index vertices) {
  Tessellation t;
  t.edge = edge_for_vertices(4 * kPi, vertices);
  return to_mesh(make_sphere(1.0, t));
}

// ---- Changes

template <class Change>
DefaultMesh moved(DefaultMesh mesh, Change change) {
  for (const auto v : mesh.vertices()) {
    const Vector3 p = change(to_vector3(mesh.point(v)));
    mesh.set_point(v, {p.x(), p.y(), p.z()});
  }
  return mesh;
}

inline DefaultMesh rotated(const DefaultMesh& mesh, const Vector3& axis, double angle) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  return moved(mesh, [&](const Vector3& p) { return Vector3(turn * p); });
}
inline DefaultMesh translated(const DefaultMesh& mesh, const Vector3& shift) {
  return moved(mesh, [&](const Vector3& p) { return Vector3(p + shift); });
}
inline DefaultMesh scaled(const DefaultMesh& mesh, double factor) {
  return moved(mesh, [&](const Vector3& p) { return Vector3(factor * p); });
}

// SplitMix64: the same numbers everywhere, unlike std::shuffle and the distributions of <random>. So that
// each goes to the same place everywhere, two calls stand in braces or statements: the order of arguments is
// the compiler's choice.
struct Random {
  std::uint64_t state;
  explicit Random(std::uint64_t seed) : state(seed) {}
  std::uint64_t next() {
    std::uint64_t x = state += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
  }
  Index below(Index count) { return static_cast<Index>(next() % static_cast<std::uint64_t>(count)); }
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1.0p-53);
  }
  Vector3 in_ball() {
    for (;;) {
      const Vector3 p{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (p.squaredNorm() <= 1) return p;
    }
  }
};

// A random order of 0 .. count - 1.
inline std::vector<Index> permutation(Index count, Random& random) {
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (Index i = count - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
  return order;
}

// The same surface with vertices and faces in another order and each face started at another corner.
// new_index, where given, receives the vertex's number in the result.
inline DefaultMesh renumbered(const DefaultMesh& mesh, std::uint64_t seed,
                              std::vector<Index>* new_index = nullptr) {
  Random random(seed);
  const PolygonSoup soup = to_soup(mesh);
  const std::vector<Index> place = permutation(static_cast<Index>(soup.points.size()), random);
  const std::vector<Index> order = permutation(static_cast<Index>(soup.polygon_count()), random);
  PolygonSoup result;
  result.points.resize(soup.points.size());
  for (std::size_t v = 0; v < soup.points.size(); ++v) result.points[place[v]] = soup.points[v];
  for (const Index f : order) {
    const Index* c = &soup.corners[soup.begin[f]];
    const Index k = random.below(3);
    result.add_triangle(place[c[k]], place[c[(k + 1) % 3]], place[c[(k + 2) % 3]]);
  }
  if (new_index) *new_index = place;
  return to_mesh(result);
}

// Every vertex moved at random by up to `amount` of the mean edge length; below about 0.2 the surface stays
// embedded.
inline DefaultMesh jittered(const DefaultMesh& mesh, std::uint64_t seed, double amount) {
  double sum = 0;
  for (const auto e : mesh.edges()) sum += mesh.calc_edge_length(e);
  const double reach = amount * sum / static_cast<double>(mesh.n_edges());
  Random random(seed);
  return moved(mesh, [&](const Vector3& p) { return Vector3(p + reach * random.in_ball()); });
}

}  // namespace mspskel::test
