// What coarsening keeps: topology, components, the partition of the input's vertices, size, symmetry.
#include "mspskel/mesh/coarsen_surface.h"

#include <catch2/catch.hpp>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/self_intersection.h"
#include "support/meshes.h"
#include "support/random_solid.h"

using namespace mspskel;

namespace {

SurfaceSnapshot sample(const std::string& name, Index resolution) {
  SampleOptions options;
  options.resolution = resolution;
  return make_snapshot(test::to_mesh(make_sample(name, options)));
}

CoarseningOptions thinned_to(Index vertices) {
  CoarseningOptions options;
  options.vertices = vertices;
  return options;
}

double area(const SurfaceSnapshot& s) {
  return std::accumulate(s.vertex_area.begin(), s.vertex_area.end(), 0.0);
}

double volume(const SurfaceSnapshot& s) {
  double sum = 0;
  for (Index f = 0; f < s.face_count(); ++f)
    sum += s.position[s.origin[3 * f]].dot(s.face_normal_times_twice_area(f)) / 6;
  return sum;
}

// Twins that fit, no edge twice, one fan a vertex, no isolated vertices.
void check_manifold(const SurfaceSnapshot& s) {
  std::vector<std::pair<Index, Index>> directed;
  bool fits = true;
  for (Index h = 0; h < s.halfedge_count(); ++h) {
    fits = fits && s.twin[h] != h && s.twin[s.twin[h]] == h && s.origin[s.twin[h]] == s.target(h);
    directed.emplace_back(s.origin[h], s.target(h));
  }
  CHECK(fits);
  std::sort(directed.begin(), directed.end());
  CHECK(std::adjacent_find(directed.begin(), directed.end()) == directed.end());
  CHECK_NOTHROW(detail::check_vertex_fans(s));
  CHECK(std::count(s.vertex_halfedge.begin(), s.vertex_halfedge.end(), kNone) == 0);
}

// Vertices, Euler characteristic: per component.
std::vector<std::array<Index, 2>> topology(const SurfaceSnapshot& s) {
  std::vector<std::array<Index, 2>> result(s.component_count, {0, 0});
  for (Index v = 0; v < s.vertex_count(); ++v)
    if (s.component[v] != kNone) ++result[s.component[v]][0], ++result[s.component[v]][1];
  for (Index h = 0; h < s.halfedge_count(); ++h) {
    Index& chi = result[s.component[s.origin[h]]][1];
    if (h < s.twin[h]) --chi;
    if (h % 3 == 0) ++chi;
  }
  return result;
}

// Every coarse vertex stands for a connected, non-empty set of input vertices of its own component.
void check_partition(const SurfaceSnapshot& s, const CoarseSurface& c) {
  REQUIRE(c.coarse_vertex.size() == s.position.size());
  std::vector<Index> patches(c.surface.position.size(), 0), stack, component(s.component_count, kNone);
  std::vector<char> seen(s.position.size(), 0);
  bool fits = true;
  for (Index seed = 0; seed < s.vertex_count(); ++seed) {
    const Index to = c.coarse_vertex[seed];
    if (s.vertex_halfedge[seed] == kNone) {
      CHECK(to == kNone);
      continue;
    }
    REQUIRE((to >= 0 && to < c.surface.vertex_count()));
    Index& into = component[s.component[seed]];
    if (into == kNone) into = c.surface.component[to];
    fits = fits && into == c.surface.component[to];
    if (seen[seed]) continue;
    ++patches[to];
    seen[seed] = 1;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Index first = s.vertex_halfedge[stack.back()];
      stack.pop_back();
      Index h = first;
      do {
        const Index w = s.target(h);
        if (!seen[w] && c.coarse_vertex[w] == to) seen[w] = 1, stack.push_back(w);
        h = s.next_outgoing(h);
      } while (h != first);
    }
  }
  CHECK(fits);
  std::sort(component.begin(), component.end());
  CHECK(std::adjacent_find(component.begin(), component.end()) == component.end());
  CHECK(std::count(patches.begin(), patches.end(), 1) == c.surface.vertex_count());
}

void check_faithful(const SurfaceSnapshot& s, const CoarseSurface& c) {
  check_manifold(c.surface);
  check_partition(s, c);
  const auto before = topology(s), after = topology(c.surface);
  REQUIRE(before.size() == after.size());
  for (Index v = 0; v < s.vertex_count(); ++v)
    if (s.component[v] != kNone)
      REQUIRE(before[s.component[v]][1] == after[c.surface.component[c.coarse_vertex[v]]][1]);
  CHECK(c.surface.frame.scale == s.frame.scale);
  CHECK(c.surface.frame.origin == s.frame.origin);
}

}  // namespace

TEST_CASE("samples keep topology, components, area and volume") {
  for (const std::string name : {"torus", "plate", "chain", "y-tube"}) {
    INFO(name);
    const SurfaceSnapshot s = sample(name, 4000);
    const CoarseSurface c = coarsen_surface(s, thinned_to(1000));
    check_faithful(s, c);
    CHECK(c.surface.vertex_count() == 1000);
    CHECK(c.collapses == s.vertex_count() - 1000);
    CHECK(area(c.surface) == Approx(area(s)).epsilon(0.03));
    CHECK(volume(c.surface) == Approx(volume(s)).epsilon(0.03));
    CHECK(count_self_intersections(c.surface, BoundingVolumeHierarchy(c.surface)) == 0);
  }
}

TEST_CASE("random solids, slivers and all, thinned as far as permitted") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    INFO(seed);
    const SurfaceSnapshot s = make_snapshot(test::random_solid(seed));
    CoarseningOptions options = thinned_to(4);
    options.component_vertices = 4;
    check_faithful(s, coarsen_surface(s, options));
    options = thinned_to(s.vertex_count() / 2);
    check_faithful(s, coarsen_surface(s, options));
  }
}

TEST_CASE("no component is thinned below its least number of vertices") {
  PolygonSoup soup = test::to_soup(test::sphere(2000));
  append(soup, test::to_soup(test::translated(test::scaled(test::sphere(400), 0.05), {3, 0, 0})));
  append(soup, test::to_soup(test::translated(test::octahedron(), {9, 0, 0})));
  const SurfaceSnapshot s = make_snapshot(test::to_mesh(soup));
  const CoarseSurface c = coarsen_surface(s, thinned_to(150));
  check_faithful(s, c);
  auto counts = topology(c.surface);
  std::sort(counts.begin(), counts.end());
  REQUIRE(counts.size() == 3);
  CHECK(counts[0][0] == 6);
  CHECK(counts[1][0] >= 50);
  CHECK(counts[2][0] >= 50);
}

TEST_CASE("a thin limb keeps its cross-section") {
  // Thinner than the coarse edges elsewhere: only the angle between faces keeps it round.
  const SurfaceSnapshot s = make_snapshot(test::tube(0.02, 2, 12, 300));
  const CoarseSurface c = coarsen_surface(s, thinned_to(200));
  check_faithful(s, c);
  CHECK(volume(c.surface) == Approx(volume(s)).epsilon(0.1));
}

TEST_CASE("creases stay: a fine box keeps its volume") {
  const SurfaceSnapshot s = sample("plate", 6000);
  const CoarseSurface c = coarsen_surface(s, thinned_to(600));
  CHECK(volume(c.surface) == Approx(volume(s)).epsilon(0.01));
}

TEST_CASE("the same input gives the same output") {
  const SurfaceSnapshot s = sample("y-tube", 4000);
  const CoarseSurface a = coarsen_surface(s, thinned_to(800)), b = coarsen_surface(s, thinned_to(800));
  CHECK(a.surface.origin == b.surface.origin);
  CHECK(a.surface.position == b.surface.position);
  CHECK(a.coarse_vertex == b.coarse_vertex);
}

// Same numbering, same shape up to rounding.
void check_congruent(const SurfaceSnapshot& a, const SurfaceSnapshot& b) {
  REQUIRE(a.origin == b.origin);
  CHECK(a.twin == b.twin);
  double difference = 0;
  for (Index h = 0; h < a.halfedge_count(); ++h) {
    const auto length = [h](const SurfaceSnapshot& s) {
      return (s.position[s.target(h)] - s.position[s.origin[h]]).norm();
    };
    difference = std::max(difference, std::abs(length(a) - length(b)));
    difference =
        std::max(difference, std::abs(a.position[a.origin[h]].norm() - b.position[b.origin[h]].norm()));
  }
  CHECK(difference < 1e-9);
}

TEST_CASE("motion, scale and numbering leave the result as it is") {
  // A horn: bent and tapering, regular, its left the mirror image of its right, so costs are equal by the
  // dozen.
  const auto bent = [](double along, double r, double round) {
    const double out = 1.5 + r * std::cos(round);
    return Vector3(out * std::cos(along), out * std::sin(along), r * std::sin(round));
  };
  const auto at = [&](Index ring, Index i) {
    return bent(2.0 * ring / 79, 0.3 - 0.1 * ring / 79, 2 * kPi * i / 24);
  };
  const DefaultMesh horn = test::stacked_rings(24, 80, at, bent(0, 0, 0), bent(2, 0, 0));
  const DefaultMesh irregular = test::jittered(test::y_tube(3000), 5, 0.2);
  for (const DefaultMesh* given : {&horn, &irregular}) {
    const DefaultMesh& mesh = *given;
    const CoarseSurface c = coarsen_surface(make_snapshot(mesh), thinned_to(600));
    const DefaultMesh changed[] = {
        test::rotated(mesh, Vector3(1, 2, 3).normalized(), 0.7),
        test::scaled(mesh, 1e3),
        test::translated(mesh, {5, -7, 2}),
        test::renumbered(mesh, 3),
    };
    for (const DefaultMesh& other : changed)
      check_congruent(c.surface, coarsen_surface(make_snapshot(other), thinned_to(600)).surface);
  }
}

TEST_CASE("meshes that cannot or need not be thinned are unchanged") {
  CoarseningOptions least = thinned_to(4);
  least.component_vertices = 4;
  PolygonSoup seven;  // Möbius' torus: each vertex is joined to all others
  for (Index i = 0; i < 7; ++i)
    seven.points.push_back({std::cos(i * 1.0), std::sin(i * 2.0), std::cos(i * i * 1.0)});
  for (Index i = 0; i < 7; ++i) {
    seven.add_triangle(i, (i + 1) % 7, (i + 3) % 7);
    seven.add_triangle(i, (i + 3) % 7, (i + 2) % 7);
  }
  for (const DefaultMesh& mesh : {test::tetrahedron(), test::octahedron(), test::to_mesh(seven)}) {
    const SurfaceSnapshot s = make_snapshot(mesh);
    for (const CoarseningOptions& options : {least, CoarseningOptions()}) {
      const CoarseSurface c = coarsen_surface(s, options);
      CHECK(c.collapses == 0);
      const auto sorted = [](std::vector<Vector3> points) {
        std::sort(points.begin(), points.end(), [](const Vector3& p, const Vector3& q) {
          return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
        });
        return points;
      };
      CHECK(sorted(c.surface.position) == sorted(s.position));
      check_faithful(s, c);
    }
  }
}

TEST_CASE("isolated vertices map nowhere") {
  DefaultMesh mesh = test::sphere(500);
  const Index isolated = mesh.add_vertex({9, 9, 9}).idx();
  const SurfaceSnapshot s = make_snapshot(mesh);
  for (const Index target : {100, 10000}) {
    const CoarseSurface c = coarsen_surface(s, thinned_to(target));
    CHECK(c.coarse_vertex[isolated] == kNone);
    if (target == 100) check_faithful(s, c);
  }
}

TEST_CASE("options out of range are refused by name") {
  const SurfaceSnapshot s = make_snapshot(test::tetrahedron());
  const auto refuses = [&](const char* name, auto change) {
    CoarseningOptions options;
    change(options);
    CHECK_THROWS_WITH(coarsen_surface(s, options), Catch::Contains(name));
    CHECK_THROWS_AS(coarsen_surface(s, options), UsageError);
  };
  const double nan = std::nan("");
  refuses("vertices", [](auto& o) { o.vertices = 3; });
  refuses("component_vertices", [](auto& o) { o.component_vertices = 0; });
  refuses("spread", [&](auto& o) { o.spread = nan; });
  refuses("spread", [](auto& o) { o.spread = 0; });
  refuses("most_turn", [](auto& o) { o.most_turn = 91; });
  refuses("most_dihedral", [](auto& o) { o.most_dihedral = 0; });
  refuses("least_shape", [](auto& o) { o.least_shape = 1; });
  refuses("most_valence", [](auto& o) { o.most_valence = 33; });
}

TEST_CASE("a progress callback can stop it") {
  Execution execution;
  execution.progress = [](const char*, double fraction) { return fraction < 0.5; };
  CHECK_THROWS_AS(coarsen_surface(sample("torus", 4000), thinned_to(500), execution), Cancelled);
}
