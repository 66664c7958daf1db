// What files hold that are no closed meshes: shapes that were damaged, and faces that never were a shape.
#pragma once

#include "fuzz/fuzzed_meshes.h"
#include "support/damage.h"

namespace mspskel::fuzz {

// Few points, often in the same places, and a handful of polygons on them; some corners may be of no point.
inline FuzzedMesh handful(Choices& choices) {
  test::Random random = choices.numbers();
  FuzzedMesh mesh;
  mesh.made = "handful";
  const Index points = 3 + choices.below(14), faces = 1 + choices.below(40), grid = choices.below(5);
  const Index most_corners = 3 + choices.below(4);
  for (Index v = 0; v < points; ++v) {
    Vector3 p = random.in_ball();
    if (grid > 0) p = (grid * p).array().round();
    mesh.soup.points.push_back(p);
  }
  const Index strays = choices.one_in(10) ? 1 : 0;
  for (Index f = 0; f < faces; ++f) {
    const Index corners = choices.one_in(20) ? 1 + random.below(2) : 3 + random.below(most_corners - 2);
    for (Index k = 0; k < corners; ++k)
      mesh.soup.corners.push_back(random.below(points + 2 * strays) - strays);
    mesh.soup.begin.push_back(static_cast<Index>(mesh.soup.corners.size()));
  }
  return mesh;
}

inline bool in_range(const PolygonSoup& soup) {
  return std::all_of(soup.corners.begin(), soup.corners.end(),
                     [&](Index v) { return v >= 0 && v < static_cast<Index>(soup.points.size()); });
}

inline bool all_triangles(const PolygonSoup& soup) {
  for (std::size_t f = 0; f < soup.polygon_count(); ++f)
    if (soup.begin[f + 1] - soup.begin[f] != 3) return false;
  return true;
}

// One kind of damage. Several may follow each other, so that no soup is too bad for any of them.
inline void damage(FuzzedMesh& mesh, Choices& choices) {
  PolygonSoup& soup = mesh.soup;
  const double size = extent(soup);
  const auto said = [&](const std::string& what, double value) {
    mesh.made += ", " + what + " " + std::to_string(value);
  };
  switch (choices.below(13)) {
    case 0:
    case 1: {
      const Index patches = 1 + choices.below(8);
      const double share = choices.magnitude(1e-3, 0.3);
      soup = test::without_patches(soup, patches, share, choices.numbers());
      return said("patches removed", patches);
    }
    case 2: {
      const double share = choices.uniform(0.01, 1);
      soup = test::with_turned_faces(std::move(soup), share, choices.numbers());
      return said("turned", share);
    }
    case 3:
      soup = test::split(soup);
      return said("split", 0);
    case 4: {
      if (!all_triangles(soup)) return;
      const double share = choices.magnitude(1e-9, 0.3);
      soup = test::drawn_in(soup, share);
      return said("drawn in", share);
    }
    case 5: {
      if (!all_triangles(soup)) return;
      const double share = choices.uniform(0.05, 1);
      soup = test::with_polygons(soup, share, choices.numbers());
      return said("polygons", share);
    }
    case 6: {
      const double share = choices.uniform(0.01, 0.6);
      soup = test::with_repeated_faces(soup, share, choices.numbers());
      return said("repeated", share);
    }
    case 7: {
      const Index count = 1 + choices.below(30);
      const double reach = choices.magnitude(1e-3, 1) * size;
      soup = test::with_fins(std::move(soup), count, reach, choices.numbers());
      return said("fins", count);
    }
    case 8: {
      const Index count = 1 + choices.below(20);
      soup = test::with_merged_points(std::move(soup), count, choices.numbers());
      return said("merged", count);
    }
    case 9: {
      const Index count = 1 + choices.below(10);
      soup = test::with_spoilt_points(std::move(soup), count, choices.numbers());
      return said("spoilt", count);
    }
    case 10: {
      const double scale = choices.of({5e-324, 1e-300, 1e-160, 1e-100, 1e-20, 1e20, 1e100, 1e160, 1e300});
      for (Vector3& p : soup.points) p *= scale;
      mesh.made += scale < 1 ? ", minute" : ", vast";
      return;
    }
    case 11: {
      // A copy beside it, in contact, hardly elsewhere, or far enough into it.
      const double shift = choices.of({1.0, 1.0, 0.0, 1e-12, 1e-6, 1e-3, 0.02, 0.3}) * size;
      const PolygonSoup first = soup;
      append(soup, placed(first, choices.of({1.0, 1.0, 0.999, 0.3}), shift * Vector3::UnitX()));
      return said("copy at", shift);
    }
    default: {
      const Index count = 1 + choices.below(20);
      test::Random random = choices.numbers();
      for (Index i = 0; i < count; ++i) soup.points.push_back(size * random.in_ball());
      return said("isolated points", count);
    }
  }
}

// A small one, if one comes up soon: damage is as good on it, and more of it is tried.
inline FuzzedMesh small_mesh(Choices& choices) {
  constexpr std::size_t kSmall = 600;
  FuzzedMesh mesh = fuzzed_mesh(choices);
  for (int attempt = 0; attempt < 4 && mesh.soup.points.size() > kSmall; ++attempt)
    mesh = fuzzed_mesh(choices);
  return mesh;
}

inline FuzzedMesh fuzzed_soup(Choices& choices) {
  if (choices.one_in(4)) {
    FuzzedMesh mesh = handful(choices);
    if (in_range(mesh.soup) && choices.one_in(2)) damage(mesh, choices);
    return mesh;
  }
  FuzzedMesh mesh = small_mesh(choices);
  if (choices.one_in(5)) {  // shapes that touch, cross or hold each other
    const FuzzedMesh other = small_mesh(choices);
    const double ratio = extent(other.soup) > 0 ? extent(mesh.soup) / extent(other.soup) : 1;
    test::Random random = choices.numbers();
    const Vector3 shift = middle(mesh.soup) - middle(other.soup) + 0.5 * extent(mesh.soup) * random.in_ball();
    append(mesh.soup, placed(other.soup, ratio * choices.magnitude(0.1, 1), shift));
    mesh.made += " with " + other.made;
  }
  for (Index kinds = 1 + choices.below(3); kinds > 0; --kinds) damage(mesh, choices);
  return mesh;
}

}  // namespace mspskel::fuzz
