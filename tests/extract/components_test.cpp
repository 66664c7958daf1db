// Each component of a surface is extracted by itself: in its own solid, with its own extent and budget.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "extract/unusual_meshes.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/component_solids.h"
#include "mspskel/pipeline/component_order.h"
#include "mspskel/refine/find_digits.h"
#include "mspskel/samples/samples.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

PolygonSoup sample(const char* name, double count = -1) {
  SampleOptions options;
  options.count = static_cast<decltype(options.count)>(count);
  return make_sample(name, options);
}

SurfaceSnapshot snapshot_of(const PolygonSoup& soup) { return make_snapshot(to_mesh(soup)); }

// Nodes of the skeleton that stand for a component, by the surface map.
std::vector<Index> component_of_nodes(const ExtractResult& result) {
  std::vector<Index> component(result.skeleton.nodes.size(), kNone);
  for (std::size_t v = 0; v < result.skeleton.node_of_vertex.size(); ++v)
    if (result.skeleton.node_of_vertex[v] != kNone)
      component[result.skeleton.node_of_vertex[v]] = result.surface.component[v];
  for (std::size_t round = 0; round < component.size(); ++round)  // nodes without vertices: their neighbours'
    for (const auto& [a, b] : result.skeleton.edges) {
      if (component[a] == kNone) component[a] = component[b];
      if (component[b] == kNone) component[b] = component[a];
    }
  return component;
}

// Every node and edge lies in the solid of its component.
void check_inside(const ExtractResult& result) {
  const ComponentSolids solids = find_component_solids(result.surface);
  std::vector<BoundingVolumeHierarchy> solid;
  for (const auto& faces : solids.faces) solid.emplace_back(result.surface, faces);
  const std::vector<Index> component = component_of_nodes(result);
  const auto at = [&](Index n) {
    return result.surface.frame.to_normalised(result.skeleton.nodes[n].position);
  };
  for (const auto& [a, b] : result.skeleton.edges) {
    REQUIRE(component[a] == component[b]);
    CHECK(solid[component[a]].inside(at(a)));
    CHECK(solid[component[a]].inside(at(b)));
    CHECK_FALSE(solid[component[a]].segment_crosses(at(a), at(b)));
  }
}

Index leaves(const CurveSkeleton& skeleton) { return count_graph(skeleton).leaves; }

}  // namespace

TEST_CASE("Copies of a shape have the skeleton of the shape alone, however many and wherever they are") {
  const PolygonSoup one = sample("quadruped");
  const ExtractResult alone = extract_skeleton(to_mesh(one));
  PolygonSoup several = one;
  append(several, shifted(one, 0.001, Vector3(5, 0, 0)));
  append(several, shifted(one, 30.0, Vector3(200, 3, 0)));
  const ExtractResult result = extract_skeleton(to_mesh(several));
  CHECK(leaves(result.skeleton) == 3 * leaves(alone.skeleton));
  REQUIRE(result.skeleton.nodes.size() == 3 * alone.skeleton.nodes.size());
  const double unit = alone.surface.frame.scale;
  for (std::size_t i = 0; i < alone.skeleton.nodes.size(); ++i) {
    const Vector3& x = alone.skeleton.nodes[i].position;
    CHECK((result.skeleton.nodes[i].position - x).norm() < 1e-6 * unit);
    CHECK(result.skeleton.nodes[i].radius == Approx(alone.skeleton.nodes[i].radius));
  }
  check_inside(result);
}

TEST_CASE(
    "A shell inside another that is turned the same way is a solid of its own, and so is the outer one") {
  PolygonSoup nested = make_sphere(1.0, {});
  append(nested, shifted(to_soup(tube(0.1, 1.0, 12, 20)), 0.5, Vector3(0.2, 0, 0)));
  const SurfaceSnapshot surface = snapshot_of(nested);
  const ComponentSolids solids = find_component_solids(surface);
  CHECK(solids.around == std::vector<Index>{kNone, 0});
  CHECK(solids.cavity == std::vector<std::uint8_t>{0, 0});
  CHECK(static_cast<Index>(solids.faces[0].size() + solids.faces[1].size()) == surface.face_count());
  check_inside(extract_skeleton(to_mesh(nested)));
}

TEST_CASE("A solid keeps clear of its cavities, and a cavity's skeleton lies in the hollow") {
  for (ExtractOptions options : {default_options(), thesis_options()}) {
    options.execution.threads = 1;
    const ExtractResult result = extract_skeleton(to_mesh(ball_with_cavities()), options);
    const ComponentSolids solids = find_component_solids(result.surface);
    CHECK(solids.cavity[0] == 0);
    CHECK(static_cast<Index>(solids.faces[0].size()) > 0);
    if (options.mode == Mode::kDefault) check_inside(result);
    CHECK(result.warnings.size() >= 1);
  }
}

TEST_CASE("A part with cavities names the component's faces as the part without them does") {
  // The cavity's faces have the smaller numbers in the whole.
  PolygonSoup soup = shifted(make_sphere(1.0, {}), 0.2, Vector3::Zero());
  reverse_orientation(soup);
  append(soup, make_sphere(1.0, {}));
  const SurfaceSnapshot whole = snapshot_of(soup);
  const ComponentSolids solids = find_component_solids(whole);
  REQUIRE(solids.cavity == std::vector<std::uint8_t>{1, 0});
  const std::vector<Index>& faces = solids.faces[1];
  const std::size_t own = faces.size() / 2;
  const SurfaceSnapshot alone =
      surface_part(whole, {faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(own)}).surface;
  const SurfaceSnapshot bounds = solid_part(whole, faces, own, alone.frame).surface;
  REQUIRE(bounds.face_count() == 2 * alone.face_count());
  for (Index h = 0; h < alone.halfedge_count(); ++h) {
    CHECK(bounds.position[bounds.origin[h]] == alone.position[alone.origin[h]]);
    CHECK(bounds.twin[h] == alone.twin[h]);
  }
  for (Index h = 0; h < bounds.halfedge_count(); ++h) CHECK(bounds.twin[bounds.twin[h]] == h);

  // A leaf that ends beside the cavity's wall has no digits, and asks for no face that the surface lacks.
  const double scale = alone.frame.scale;
  ArcGraph graph;
  graph.add_hub(Vector3(0.8, 0, 0) / scale);
  graph.add_hub(Vector3(0.21, 0, 0) / scale);
  Arc arc;
  arc.hub = {0, 1};
  for (double x = 0.8; x > 0.22; x -= 0.01) arc.points.push_back(Vector3(x, 0, 0) / scale);
  arc.points.push_back(graph.hub_position[1]);
  graph.arcs.push_back(arc);
  CHECK(find_digits(graph, alone, BoundingVolumeHierarchy(bounds), {}).empty());
}

TEST_CASE("Pieces that cross lie in neither, whichever way they are turned") {
  // The first vertex of each lies in the other one; mirrored, the other one is turned inward.
  PolygonSoup both = to_soup(cube());
  PolygonSoup other = both;
  for (Vector3& p : other.points) p = -p - Vector3(0.9, 0.9, 0.9);
  append(both, other);
  const SurfaceSnapshot surface = snapshot_of(both);
  const ComponentSolids solids = find_component_solids(surface);
  CHECK(solids.around == std::vector<Index>{kNone, kNone});
  CHECK(solids.signed_volume[0] * solids.signed_volume[1] < 0);
  CHECK(solids.cavity == std::vector<std::uint8_t>{0, 0});
  CHECK(extract_skeleton(to_mesh(both)).skeleton.nodes.size() > 1);
}

TEST_CASE("The budget of vertices is each component's own") {
  const ExtractResult result = extract_skeleton(to_mesh(sample("chain", 40)));
  CHECK(result.surface.component_count == 40);
  CHECK(count_graph(result.skeleton).cycles == 40);
  check_inside(result);
}

TEST_CASE("Stages of several components are joined in the frame of the whole") {
  PolygonSoup two = to_soup(torus(1.0, 0.3, 24, 12));
  append(two, shifted(to_soup(torus(1.0, 0.3, 24, 12)), 0.1, Vector3(3, 1, 0)));
  const ExtractResult result = extract_skeleton(to_mesh(two));
  REQUIRE(result.cocycles.rank == 2);
  CHECK(result.cocycles.genus == std::vector<Index>{1, 1});
  const double unit = result.surface.frame.scale;
  for (Index v = 0; v < result.surface.vertex_count(); ++v) {
    const double size = result.surface.component[v] == 0 ? 1.0 : 0.1;
    CHECK(unit * result.slices.perimeter[v] == Approx(2 * kPi * 0.3 * size).epsilon(0.05));
    CHECK((result.skeleton_mesh.position[v] - result.surface.position[v]).norm() * unit < 0.5 * size);
  }
  for (Index f = 0; f < result.surface.face_count(); ++f) {
    CocycleLabel sum;
    for (Index h = 3 * f; h < 3 * f + 3; ++h) sum += result.cocycles.label[h];
    CHECK(sum.is_zero());
  }
  double area = 0;
  for (const CollapsedNode& node : result.collapsed.nodes) area += node.area;
  double whole = 0;
  for (const double a : result.surface.vertex_area) whole += a;
  CHECK(area == Approx(whole).epsilon(0.01));  // the nodes are of surfaces that are coarser
}

TEST_CASE("What is more than a thread's share of the work left has all threads, the others one each") {
  const auto alone = [](const std::vector<std::size_t>& faces, int threads, double working_faces = 3200) {
    return order_components(faces, working_faces, threads).alone;
  };
  CHECK(order_components({10, 3000, 10, 200}, 3200, 2).components == std::vector<Index>{1, 3, 0, 2});
  CHECK(alone({3000, 200, 100}, 2) == 3);  // nothing is left to be beside 100
  CHECK(alone({3000, 200, 100, 100}, 2) == 1);
  CHECK(alone({3000, 3000}, 2) == 0);
  CHECK(alone({3000, 3000, 3000}, 2) == 0);
  CHECK(alone({40000, 3200, 3200}, 2) == 0);  // coarsened to as many
  CHECK(alone({40000, 3200, 3200}, 2, 1e9) == 1);
  CHECK(alone({3000, 3000}, 1) == 2);
  CHECK(alone({3000, 3000, 3000}, 4) == 3);
  CHECK(alone({3000, 3000, 3000, 3000}, 4) == 0);
  CHECK(alone({}, 4) == 0);
}

TEST_CASE("Components side by side report how far they are together, which never falls") {
  SideBySideShare together(8);
  CHECK(together.share() == 0);
  together.begin(4);
  together.begin(3);
  CHECK(together.share() == Approx(3.5 / 8));
  together.end(3);
  together.begin(1);
  CHECK(together.share() == Approx(5.5 / 8));
  together.end(1);
  together.end(4);
  CHECK(together.share() == Approx(1));

  // The callback is asked on the calling thread, while a component of its own is under way or another one's.
  const DefaultMesh mesh = to_mesh(scattered_tetrahedra(40));
  ExtractOptions options;
  options.execution.threads = 2;
  std::vector<double> shares;
  options.execution.progress = [&](const char* stage, double share) {
    if (std::string(stage) == kSideBySideStage) shares.push_back(share);
    return true;
  };
  extract_skeleton(mesh, options);
  CHECK(std::is_sorted(shares.begin(), shares.end()));
  for (const double share : shares) CHECK((share > 0 && share <= 1));
}

TEST_CASE("Components give the same bytes on any number of threads, and a budget of nodes is shared") {
  const DefaultMesh mesh = to_mesh(scattered_tetrahedra(40));
  ExtractOptions options;
  std::vector<CurveSkeleton> skeletons;
  for (const int threads : {1, 2, 3}) {
    options.execution.threads = threads;
    skeletons.push_back(extract_skeleton(mesh, options).skeleton);
  }
  for (const CurveSkeleton& other : {skeletons[1], skeletons[2]}) {
    REQUIRE(other.nodes.size() == skeletons[0].nodes.size());
    for (std::size_t i = 0; i < other.nodes.size(); ++i)
      CHECK(other.nodes[i].position == skeletons[0].nodes[i].position);
  }
  options.refinement.nodes = 160;
  CHECK(extract_skeleton(mesh, options).skeleton.nodes.size() <= 160);
}

TEST_CASE("A callback that says stop ends the extraction of many components") {
  ExtractOptions options;
  int polls = 0;
  options.execution.progress = [&](const char*, double) { return ++polls < 5; };
  CHECK_THROWS_AS(extract_skeleton(to_mesh(scattered_tetrahedra(200)), options), Cancelled);
  CHECK(polls == 5);
}
