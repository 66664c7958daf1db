// Small closed meshes for the fuzz targets: valid shapes, then edits that a user's tools make.
#pragma once

#include <map>
#include <string>

#include "fuzz/choices.h"
#include "mspskel/samples/samples.h"
#include "mspskel/samples/shapes.h"
#include "support/random_solid.h"
#include "topology/voxel_solids.h"

namespace mspskel::fuzz {

// The closed surface of an edited shape, and what was done to it, in words.
struct FuzzedMesh {
  PolygonSoup soup;
  std::string made;
};

// At most so many vertices: a run stays below about a second.
constexpr Index kMostVertices = 3000;

inline double extent(const PolygonSoup& soup) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : soup.points) box.extend(p);
  return soup.points.empty() ? 0.0 : box.sizes().maxCoeff();
}

// ---- Shapes

inline FuzzedMesh sample_shape(Choices& choices) {
  for (int attempt = 0;; ++attempt) {
    const std::vector<SampleInfo> all = list_samples();
    const SampleInfo& info = all[attempt < 8 ? choices.below(static_cast<Index>(all.size())) : 0];
    if (info.least_resolution > kMostVertices / 2) continue;
    SampleOptions options;
    options.resolution =
        static_cast<Index>(choices.magnitude(info.least_resolution, info.least_resolution + 1000.0));
    options.seed = static_cast<std::uint64_t>(choices.below(1000));
    if (choices.one_in(4)) options.jitter = choices.uniform(0, 0.3);
    try {
      return {make_sample(info.name, options), info.name};
    } catch (const UsageError&) {  // too coarse for this shape
      if (attempt > 8) return {make_sample("sphere"), "sphere"};
    }
  }
}

inline FuzzedMesh polyhedron(Choices& choices) {
  const auto sides = [&](Index least, Index most) { return least + choices.below(most - least + 1); };
  switch (choices.below(10)) {
    case 0:
      return {test::to_soup(test::tetrahedron()), "tetrahedron"};
    case 1:
      return {test::to_soup(test::octahedron()), "octahedron"};
    case 2:
      return {test::to_soup(test::cube()), "cube"};
    case 3: {
      const Index n = sides(3, 20), rings = sides(1, 20);
      return {test::to_soup(test::prism(n, choices.magnitude(0.01, 100), rings)), "prism"};
    }
    case 4: {
      const Index n = sides(3, 20), rings = sides(2, 30);
      return {test::to_soup(test::tube(choices.magnitude(0.001, 10), 1, n, rings)), "tube"};
    }
    case 5: {
      const Index nu = sides(3, 40), nv = sides(3, 20);
      return {test::to_soup(test::torus(1, choices.uniform(0.01, 0.99), nu, nv)), "torus"};
    }
    case 6: {
      const Index lobes = sides(2, 5), n = sides(8, 30);
      return {test::to_soup(test::saddle(lobes, n, sides(2, 10))), "saddle"};
    }
    case 7:
      return {test::csaszar_torus(), "csaszar"};
    default:
      return {test::to_soup(test::sphere(sides(12, 250))), "ball"};
  }
}

// Unit cells whose planes stand at random places: walls, plates and bars of any thickness.
inline PolygonSoup warped(PolygonSoup soup, int fine, Choices& choices) {
  std::array<std::map<double, double>, 3> place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Vector3& p : soup.points) place[axis][std::floor(p[axis] + 0.01 / fine)] = 0;
    double at = 0;
    for (auto& [plane, position] : place[axis]) {
      position = at;
      at += choices.magnitude(0.05, 3);
    }
  }
  return test::with_planes_at(std::move(soup), fine, place);
}

// U, L, T, H, plus, S, O profiles, drawn in the plane and given a height.
inline test::VoxelSolid profile(Index which) {
  static const std::vector<std::vector<std::string>> kDrawings{{"x.x", "x.x", "xxx"},
                                                               {"x..", "x..", "xxx"},
                                                               {"xxx", ".x.", ".x."},
                                                               {"x.x", "xxx", "x.x"},
                                                               {".x.", "xxx", ".x."},
                                                               {"xxx", "..x", "xxx", "x..", "xxx"},
                                                               {"xxx", "x.x", "xxx"},
                                                               {"x"},
                                                               {"xx"},
                                                               {"x.x.x", "xxxxx"}};
  return test::drawn(kDrawings[static_cast<std::size_t>(which) % kDrawings.size()]);
}

inline FuzzedMesh blocks(Choices& choices) {
  test::VoxelSolid solid;
  std::string name = "profile";
  const int fine = 1 + choices.below(4);
  if (choices.one_in(2)) {
    solid = profile(choices.below(10));
  } else {
    name = "lattice";
    test::Random random = choices.numbers();
    const int n = 2 + choices.below(2);
    solid.add(test::random_lattice(n, choices.uniform(0.3, 0.9), random));
    if (solid.cells.empty()) solid.cells.insert({0, 0, 0});
  }
  PolygonSoup soup = test::boundary(solid, fine);
  if (static_cast<Index>(soup.points.size()) > kMostVertices) soup = test::boundary(solid);
  return {choices.one_in(3) ? soup : warped(std::move(soup), fine, choices), name};
}

inline FuzzedMesh skin(Choices& choices) {
  test::RandomSolidOptions options;
  options.most_genus = 4;
  options.least_vertices = 200;
  options.most_vertices = 1200;
  return {test::to_soup(test::random_solid(choices.numbers().next(), options)), "skin"};
}

inline FuzzedMesh shape(Choices& choices) {
  switch (choices.below(6)) {
    case 0:
      return sample_shape(choices);
    case 1:
      return skin(choices);
    case 2:
    case 3:
      return blocks(choices);
    default:
      return polyhedron(choices);
  }
}

// ---- Several components

inline Vector3 middle(const PolygonSoup& soup) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : soup.points) box.extend(p);
  return box.center();
}

inline PolygonSoup placed(PolygonSoup soup, double scale, const Vector3& shift) {
  const Vector3 centre = middle(soup);
  for (Vector3& p : soup.points) p = centre + scale * (p - centre) + shift;
  return soup;
}

// Copies beside each other, across each other, within each other; cavities; another shape.
inline void add_components(FuzzedMesh& mesh, Choices& choices) {
  const PolygonSoup first = mesh.soup;
  const Index most = kMostVertices / std::max<Index>(1, static_cast<Index>(first.points.size()));
  const double size = extent(first);
  const Index kind = choices.below(5), copies = 1 + choices.below(4);
  for (Index i = 0; i < std::min(copies, most - 1); ++i) {
    test::Random random = choices.numbers();
    PolygonSoup more = first;
    if (kind == 0) more = placed(first, 1, 1.2 * size * (i + 1) * Vector3::UnitX());
    if (kind == 1) more = placed(first, random.uniform(0.2, 1), 0.5 * size * random.in_ball());
    if (kind == 2) more = placed(first, std::pow(0.6, i + 1), Vector3::Zero());
    if (kind == 3) reverse_orientation(more = placed(first, std::pow(0.5, i + 1), Vector3::Zero()));
    if (kind == 4) more = placed(test::to_soup(test::tetrahedron()), 0.05 * size, size * random.in_ball());
    append(mesh.soup, more);
  }
  mesh.made += ", components " + std::to_string(kind);
}

// ---- Edits; every one leaves the surface closed

inline void round_coordinates(PolygonSoup& soup, double grid) {
  if (!(grid > 0)) return;
  for (Vector3& p : soup.points)
    for (double& x : p) x = grid * std::round(x / grid);
}

inline void add_noise(PolygonSoup& soup, double reach, test::Random random) {
  for (Vector3& p : soup.points) p += reach * random.in_ball();
}

// Faces are split at a point of theirs, which may lie on an edge or a corner.
inline void add_slivers(PolygonSoup& soup, Index count, test::Random random) {
  for (Index i = 0; i < count; ++i) {
    const Index f = random.below(static_cast<Index>(soup.polygon_count()));
    Index* corner = &soup.corners[static_cast<std::size_t>(soup.begin[static_cast<std::size_t>(f)])];
    const Index a = corner[0], b = corner[1], c = corner[2];
    double share[3];
    for (double& s : share) s = std::pow(random.uniform(), 8) * random.below(4);
    const double sum = share[0] + share[1] + share[2];
    const auto point = [&](Index v) -> const Vector3& { return soup.points[static_cast<std::size_t>(v)]; };
    const Vector3 p =
        sum > 0 ? Vector3((share[0] * point(a) + share[1] * point(b) + share[2] * point(c)) / sum) : point(a);
    const auto fresh = static_cast<Index>(soup.points.size());
    soup.points.push_back(p);
    corner[2] = fresh;
    soup.add_triangle(b, c, fresh);
    soup.add_triangle(c, a, fresh);
  }
}

// What lies beyond a plane is mirrored in it: sheets that lie in or cross each other.
inline void fold(PolygonSoup& soup, double share, test::Random random) {
  const Vector3 axis = random.below(2) ? Vector3(Vector3::Unit(random.below(3)))
                                       : Vector3(random.in_ball() + Vector3(0, 0, 1e-3)).normalized();
  double low = soup.points.front().dot(axis), high = low;
  for (const Vector3& p : soup.points) low = std::min(low, p.dot(axis)), high = std::max(high, p.dot(axis));
  const double level = low + share * (high - low);
  for (Vector3& p : soup.points)
    if (p.dot(axis) > level) p -= 2 * (p.dot(axis) - level) * axis;
}

// Vertices near a vertex go to its place: pinched, or collapsed as a whole.
inline void pinch(PolygonSoup& soup, double reach, test::Random random) {
  const Vector3 at =
      soup.points[static_cast<std::size_t>(random.below(static_cast<Index>(soup.points.size())))];
  for (Vector3& p : soup.points)
    if ((p - at).norm() <= reach) p = at;
}

// Some vertices lie where others do, or far outside.
inline void misplace(PolygonSoup& soup, Index count, test::Random random) {
  const auto any = [&]() -> Vector3& {
    return soup.points[static_cast<std::size_t>(random.below(static_cast<Index>(soup.points.size())))];
  };
  const double size = extent(soup);
  for (Index i = 0; i < count; ++i) {
    const Vector3 there = any();
    any() = random.below(3) ? there : Vector3(there + 3 * size * random.in_ball());
  }
}

inline void edit(FuzzedMesh& mesh, Choices& choices) {
  PolygonSoup& soup = mesh.soup;
  const double size = extent(soup);
  const auto said = [&](const std::string& what, double value) {
    mesh.made += ", " + what + " " + std::to_string(value);
  };
  switch (choices.below(11)) {
    case 0:
    case 1: {
      const double parts = choices.of({12.0, 20.0, 50.0, 100.0, 200.0, 1000.0});
      round_coordinates(soup, size / parts);
      return said("rounded to 1 /", parts);
    }
    case 2: {
      const double reach = choices.magnitude(1e-6, 0.2);
      add_noise(soup, reach * size, choices.numbers());
      return said("noise", reach);
    }
    case 3: {
      const Index count = 1 + choices.below(50);
      add_slivers(soup, count, choices.numbers());
      return said("slivers", count);
    }
    case 4: {
      const double share = choices.uniform(0.1, 0.95);
      fold(soup, share, choices.numbers());
      return said("folded at", share);
    }
    case 5: {
      const double reach = choices.magnitude(0.02, 0.5);
      pinch(soup, reach * size, choices.numbers());
      return said("pinched", reach);
    }
    case 6: {
      const Index count = 1 + choices.below(20);
      misplace(soup, count, choices.numbers());
      return said("misplaced", count);
    }
    case 7: {
      const double factor = choices.of({0.0, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 10.0, 100.0});
      const auto axis = static_cast<std::size_t>(choices.below(3));
      for (Vector3& p : soup.points) p[axis] *= factor;
      return said("stretched", factor);
    }
    case 8: {
      const double scale = choices.of({1e-150, 1e-30, 1e-6, 1e6, 1e30, 1e150});
      for (Vector3& p : soup.points) p *= scale;
      mesh.made += scale < 1 ? ", tiny" : ", huge";
      return;
    }
    case 9: {
      const double far = choices.magnitude(1, 1e9);
      for (Vector3& p : soup.points) p += far * size * Vector3(1, -2, 0.5);
      return said("moved", far);
    }
    default: {
      test::Random random = choices.numbers();
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(random.uniform(0, 6), Vector3(random.in_ball() + Vector3(0, 0, 2)).normalized())
              .toRotationMatrix();
      soup = moved(std::move(soup), turn, Vector3::Zero());
      mesh.made += ", turned";
    }
  }
}

inline FuzzedMesh fuzzed_mesh(Choices& choices) {
  FuzzedMesh mesh = shape(choices);
  if (choices.one_in(4)) add_components(mesh, choices);
  for (Index edits = choices.below(4); edits > 0; --edits) edit(mesh, choices);
  return mesh;
}

}  // namespace mspskel::fuzz
