// Meshes that a user may hand in and nobody would make on purpose.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mspskel/samples/shapes.h"
#include "support/meshes.h"

namespace mspskel::test {

inline PolygonSoup shifted(PolygonSoup soup, double scale, const Vector3& shift) {
  for (Vector3& p : soup.points) p = scale * p + shift;
  return soup;
}

// Three bars and two more across: the boundary of a frame with two windows, 6 × 3 cells with the fewest
// faces.
inline DefaultMesh coarse_double_torus() {
  PolygonSoup soup;
  std::vector<Index> number(6 * 4 * 2, kNone);
  const auto vertex = [&](Index x, Index y, Index z) {
    Index& n = number[(x * 4 + y) * 2 + z];
    if (n == kNone) {
      n = static_cast<Index>(soup.points.size());
      soup.points.push_back(Vector3(x, y, z));
    }
    return n;
  };
  const auto solid = [](Index x, Index y) {
    return x >= 0 && x < 5 && y >= 0 && y < 3 && !(y == 1 && (x == 1 || x == 3));
  };
  const auto quad = [&](Index a, Index b, Index c, Index d) {
    soup.add_triangle(a, b, c);
    soup.add_triangle(a, c, d);
  };
  for (Index x = 0; x < 5; ++x)
    for (Index y = 0; y < 3; ++y) {
      if (!solid(x, y)) continue;
      const auto v = [&](Index i, Index j, Index z) { return vertex(x + i, y + j, z); };
      quad(v(0, 0, 1), v(1, 0, 1), v(1, 1, 1), v(0, 1, 1));
      quad(v(0, 0, 0), v(0, 1, 0), v(1, 1, 0), v(1, 0, 0));
      if (!solid(x - 1, y)) quad(v(0, 0, 0), v(0, 0, 1), v(0, 1, 1), v(0, 1, 0));
      if (!solid(x + 1, y)) quad(v(1, 0, 0), v(1, 1, 0), v(1, 1, 1), v(1, 0, 1));
      if (!solid(x, y - 1)) quad(v(0, 0, 0), v(1, 0, 0), v(1, 0, 1), v(0, 0, 1));
      if (!solid(x, y + 1)) quad(v(0, 1, 0), v(0, 1, 1), v(1, 1, 1), v(1, 1, 0));
    }
  return to_mesh(soup);
}

inline PolygonSoup scattered_tetrahedra(Index count) {
  Random random(7);
  PolygonSoup soup;
  const PolygonSoup one = to_soup(tetrahedron());
  for (Index i = 0; i < count; ++i) {
    const double size = random.uniform(1e-4, 0.3);
    append(soup, shifted(one, size, 4 * random.in_ball()));
  }
  return soup;
}

// A ball with a smaller ball and a ring cut out of it.
inline PolygonSoup ball_with_cavities() {
  Tessellation coarse;
  coarse.edge = 0.35;
  PolygonSoup soup = make_sphere(1.0, coarse);
  PolygonSoup cavity = shifted(make_sphere(1.0, coarse), 0.2, Vector3(0, 0, 0));
  append(cavity, shifted(to_soup(torus(1.0, 0.3, 10, 5)), 0.5, Vector3::Zero()));
  reverse_orientation(cavity);
  append(soup, cavity);
  return soup;
}

inline PolygonSoup crossing_rings() {
  PolygonSoup soup = to_soup(torus(1, 0.3, 16, 8));
  append(soup, shifted(soup, 1.0, Vector3(0.9, 0.05, 0.1)));
  Tessellation coarse;
  coarse.edge = 0.3;
  append(soup, shifted(make_sphere(0.6, coarse), 1.0, Vector3(0.5, 0.6, 0)));
  return soup;
}

// A vertex in the middle of an edge of two faces each: four faces, two of them without area.
inline DefaultMesh tetrahedron_with_flat_faces() {
  return from_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}},
                        {{4, 0, 2}, {2, 1, 4}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

// Császár's torus, turned and pressed to a billionth of its width: sections within it are wide, and the walls
// have hardly any distance. Fewer digits are another shape.
inline DefaultMesh flat_csaszar_torus() {
  return from_triangles({{1.4483167676333373e-09, 3.1376524992025203, 2.461202010165013},
                         {-3.942923895302917e-09, 0.39578650630563916, 1.8156828460046783},
                         {-2.1102234204183504e-09, -1.8958685170626475, 2.439803205573874},
                         {2.356522592831144e-09, -1.8740987317734654, 2.221385876663815},
                         {4.025023619440514e-09, -1.6524422559176768, -0.26195315192544855},
                         {-1.4483167676333373e-09, -3.1376524992025203, -2.461202010165013},
                         {6.157479310319845e-10, -9.424918122090283, 11.652972705594223}},
                        {{0, 1, 3},
                         {0, 3, 2},
                         {1, 2, 4},
                         {1, 4, 3},
                         {2, 3, 5},
                         {2, 5, 4},
                         {3, 4, 6},
                         {3, 6, 5},
                         {4, 5, 0},
                         {4, 0, 6},
                         {5, 6, 1},
                         {5, 1, 0},
                         {6, 0, 2},
                         {6, 2, 1}});
}

// Every vertex of the upper half of a sphere at the pole.
inline DefaultMesh sphere_with_collapsed_cap() {
  return moved(sphere(60), [](const Vector3& p) { return p.z() > 0.3 ? Vector3(0, 0, 1) : p; });
}

inline DefaultMesh with_far_isolated_vertex(DefaultMesh mesh) {
  mesh.add_vertex({1e6, 1e6, 1e6});
  return mesh;
}

inline std::vector<std::pair<std::string, DefaultMesh>> unusual_meshes() {
  const auto flat = [](double z) {
    return [=](const Vector3& p) { return Vector3(p.x(), p.y(), z * p.z()); };
  };
  Random random(11);
  std::vector<std::pair<std::string, DefaultMesh>> all{
      {"tetrahedron", tetrahedron()},
      {"octahedron", octahedron()},
      {"cube", cube()},
      {"sphere of 12 vertices", sphere(12)},
      {"sphere of 40 vertices inside out",
       [] {
         PolygonSoup soup = to_soup(sphere(40));
         reverse_orientation(soup);
         return to_mesh(soup);
       }()},
      {"torus of 7 vertices", to_mesh(make_csaszar_torus())},
      {"torus of 7 vertices pressed flat", flat_csaszar_torus()},
      {"torus of 3 by 3", torus(1, 0.4, 3, 3)},
      {"coarse double torus", coarse_double_torus()},
      {"needle", tube(1e-3, 1, 6, 12)},
      {"thinner needle", tube(1e-7, 1, 5, 8)},
      {"flat sheet", moved(sphere(120), flat(1e-3))},
      {"thinner sheet", moved(sphere(120), flat(1e-9))},
      {"sheet without thickness", moved(cube(), flat(0))},
      {"tiny components", to_mesh(scattered_tetrahedra(40))},
      {"cavities", to_mesh(ball_with_cavities())},
      {"rings that cross", to_mesh(crossing_rings())},
      {"faces without area", tetrahedron_with_flat_faces()},
      {"collapsed cap", sphere_with_collapsed_cap()},
      {"isolated vertex far away", with_far_isolated_vertex(prism(8, 6, 5))},
      {"roughened beyond embedding", jittered(torus(1, 0.4, 16, 8), 3, 1.5)},
      {"random positions", moved(torus(1, 0.4, 8, 5), [&](const Vector3&) { return random.in_ball(); })},
      {"far from the origin", translated(prism(7, 5, 6), {1e7, -1e8, 1e9})},
  };
  for (const double scale : {1e-30, 1e30})
    all.push_back({scale < 1 ? "tiny" : "huge", scaled(torus(1, 0.4, 12, 7), scale)});
  return all;
}

}  // namespace mspskel::test
