// From mesh to skeleton: topology, containment, leaves, the map, and that nothing but the shape matters.
#include "mspskel/extract_skeleton.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/mesh_report.h"
#include "mspskel/samples/skin_graph.h"
#include "mspskel/skeleton/check_skeleton.h"
#include "mspskel/skeleton/surface_map.h"
#include "support/meshes.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

struct Sample {
  std::string name;
  Index vertices, count;  // 0: the sample's own
};

DefaultMesh mesh_of(const Sample& sample) {
  SampleOptions options;
  options.resolution = sample.vertices;
  if (sample.count > 0) options.count = sample.count;
  return to_mesh(make_sample(sample.name, options));
}

// Extracted once for all test cases.
const ExtractResult& default_result(const Sample& sample) {
  static std::map<std::string, ExtractResult> results;
  const auto found = results.find(sample.name);
  if (found != results.end()) return found->second;
  return results.emplace(sample.name, extract_skeleton(mesh_of(sample))).first->second;
}

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all{{"sphere", 200, 0},    {"capsule", 250, 0},    {"tube", 300, 0},
                                       {"torus", 350, 0},     {"y-tube", 450, 0},     {"plate", 700, 3},
                                       {"hopf-link", 400, 0}, {"quadruped", 2500, 0}, {"octoped", 2500, 0}};
  return all;
}

ExtractOptions options_for(Mode mode, int threads = 0) {
  ExtractOptions options = mode == Mode::kThesis ? thesis_options() : default_options();
  options.execution.threads = threads;
  return options;
}

void check_topology(const ExtractResult& result) {
  MeshReport surface;
  detail::measure_components(result.surface, surface);
  const GraphCounts counts = count_graph(result.skeleton);
  CHECK(counts.components == result.surface.component_count);
  CHECK(counts.cycles == surface.genus);
}

// Every vertex has one node, the patches are connected, the areas add up, the radii are the distances.
void check_nodes(const ExtractResult& result) {
  const SurfaceMapReport map = report_surface_map(result.surface, result.skeleton);
  CHECK(map.partition);
  CHECK(map.share_in_one_patch == 1.0);
  const double scale = result.surface.frame.scale;
  double nodes = 0, surface = 0;
  for (const SkeletonNode& node : result.skeleton.nodes) nodes += node.area;
  for (const double a : result.surface.vertex_area) surface += a * scale * scale;
  CHECK(nodes == Approx(surface));
}

bool same_bytes(const CurveSkeleton& a, const CurveSkeleton& b) {
  if (a.nodes.size() != b.nodes.size() || a.edges != b.edges || a.node_of_vertex != b.node_of_vertex)
    return false;
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    if (a.nodes[i].position != b.nodes[i].position || a.nodes[i].radius != b.nodes[i].radius ||
        a.nodes[i].area != b.nodes[i].area || a.nodes[i].perimeter != b.nodes[i].perimeter ||
        a.nodes[i].slice_error != b.nodes[i].slice_error)
      return false;
  return true;
}

std::vector<Vector3> points_along(const CurveSkeleton& skeleton, double step) {
  std::vector<Vector3> points;
  for (const auto& [a, b] : skeleton.edges) {
    const Vector3 &p = skeleton.nodes[a].position, &q = skeleton.nodes[b].position;
    const Index count = 1 + static_cast<Index>((q - p).norm() / step);
    for (Index i = 0; i <= count; ++i) points.push_back(p + (q - p) * i / count);
  }
  return points;
}

// Farthest that a point of either curve is from the other.
double curve_distance(const CurveSkeleton& a, const CurveSkeleton& b, double step) {
  const auto pa = points_along(a, step), pb = points_along(b, step);
  const auto one_way = [](const auto& from, const auto& to) {
    double farthest = 0;
    for (const Vector3& p : from) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3& q : to) nearest = std::min(nearest, (p - q).squaredNorm());
      farthest = std::max(farthest, nearest);
    }
    return std::sqrt(farthest);
  };
  return std::max(one_way(pa, pb), one_way(pb, pa));
}

CurveSkeleton mapped(CurveSkeleton skeleton, const std::function<Vector3(const Vector3&)>& map) {
  for (SkeletonNode& node : skeleton.nodes) node.position = map(node.position);
  return skeleton;
}

void check_same_curve(const CurveSkeleton& expected, const CurveSkeleton& got, double extent) {
  CHECK(curve_distance(expected, got, 0.002 * extent) < 0.005 * extent);
  CHECK(count_graph(got).leaves == count_graph(expected).leaves);
  CHECK(count_graph(got).cycles == count_graph(expected).cycles);
}

}  // namespace

TEST_CASE("Default mode on samples: exact topology, wholly inside, the leaves that the shape has") {
  for (const Sample& sample : samples()) {
    INFO(sample.name);
    const ExtractResult& result = default_result(sample);
    check_topology(result);
    check_nodes(result);
    CHECK(result.warnings.empty());
    const BoundingVolumeHierarchy solid(result.surface);
    const SkeletonChecks checks = check_skeleton(result.surface, solid, result.skeleton);
    CHECK(checks.contained);
    CHECK(checks.radius_error < 1e-12);
    CHECK(checks.spurs == 0);
    SampleOptions options;
    if (sample.count > 0) options.count = sample.count;
    const Index leaves = describe_sample(sample.name, options).leaves;
    if (leaves != kNone && sample.name != "sphere") CHECK(checks.leaves == leaves);
  }
}

TEST_CASE("Thesis mode on samples: exact topology and a partition") {
  for (const Sample& sample : samples()) {
    if (mesh_of(sample).n_vertices() > 1000) continue;
    INFO(sample.name);
    const ExtractResult result = extract_skeleton(mesh_of(sample), thesis_options());
    check_topology(result);
    check_nodes(result);
  }
}

TEST_CASE("The same bytes with one thread, with two, and again") {
  for (const Mode mode : {Mode::kDefault, Mode::kThesis}) {
    const DefaultMesh mesh = mesh_of({"y-tube", 250, 0});
    const CurveSkeleton one = extract_skeleton(mesh, options_for(mode, 1)).skeleton;
    CHECK(same_bytes(one, extract_skeleton(mesh, options_for(mode, 1)).skeleton));
    CHECK(same_bytes(one, extract_skeleton(mesh, options_for(mode, 2)).skeleton));
    CHECK(same_bytes(one, extract_skeleton(mesh, options_for(mode, 3)).skeleton));
  }
}

TEST_CASE("Turned, moved, scaled and renumbered models have the same skeleton") {
  const Vector3 axis = Vector3(1, -2, 0.5).normalized(), shift(30, -20, 70);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, axis).toRotationMatrix();
  for (const Sample& sample : {samples()[4], samples()[3], samples()[5]}) {
    INFO(sample.name);
    const DefaultMesh mesh = mesh_of(sample);
    const ExtractResult& result = default_result(sample);
    const double extent = result.surface.frame.scale;
    const auto change = [&](const Vector3& p) -> Vector3 { return 7.0 * (turn * p) + shift; };
    check_same_curve(mapped(result.skeleton, change), extract_skeleton(moved(mesh, change)).skeleton,
                     7 * extent);
    check_same_curve(result.skeleton, extract_skeleton(renumbered(mesh, 5)).skeleton, extent);
  }
}

TEST_CASE("A renumbered mesh has the same skeleton in thesis mode") {
  const DefaultMesh mesh = mesh_of({"y-tube", 250, 0});
  const ExtractResult result = extract_skeleton(mesh, thesis_options());
  check_same_curve(result.skeleton, extract_skeleton(renumbered(mesh, 5), thesis_options()).skeleton,
                   result.surface.frame.scale);
}

TEST_CASE("A filtered skeleton of a coarser surface goes on to the arcs") {
  ExtractOptions options = default_options();
  options.filter_branches = true;
  options.coarsening.vertices = 100;
  options.coarsening.component_vertices = 20;
  options.subdivision.longest = 1;  // where edges are cut, no coarser surface comes with the result
  const ExtractResult result = extract_skeleton(mesh_of({"torus", 350, 0}), options);
  REQUIRE(result.coarse);
  check_topology(result);
}

namespace {

struct FloatTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3f;
  VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  FaceAttributes(OpenMesh::Attributes::Status);
  VertexTraits { int marker = 3; };
};
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<FloatTraits>;

FloatMesh float_mesh(const DefaultMesh& mesh) {
  FloatMesh result;
  for (const auto v : mesh.vertices())
    result.add_vertex(OpenMesh::vector_cast<OpenMesh::Vec3f>(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    auto v = mesh.cfv_iter(f);
    const OpenMesh::VertexHandle a = *v++, b = *v++, c = *v;
    result.add_face(a, b, c);
  }
  return result;
}

}  // namespace

TEST_CASE("A float mesh with traits of its own gives the skeleton of the double mesh") {
  const Sample& sample = samples()[4];
  const ExtractResult& expected = default_result(sample);
  const FloatMesh mesh = float_mesh(mesh_of(sample));
  const ExtractResult result = extract_skeleton(mesh);
  check_topology(result);
  check_same_curve(expected.skeleton, result.skeleton, expected.surface.frame.scale);
}

TEST_CASE("The input is only read") {
  const DefaultMesh mesh = mesh_of({"torus", 150, 0});
  const PolygonSoup before = to_soup(mesh);
  (void)extract_skeleton(mesh);
  const PolygonSoup after = to_soup(mesh);
  CHECK(after.points == before.points);
  CHECK(after.corners == before.corners);
}

TEST_CASE("Progress names every stage in order, with shares from 0 to 1") {
  const std::map<Mode, std::vector<std::string>> expected{
      {Mode::kDefault,
       {"subdivision", "coarsening", "slice search", "slice error", "skeletal points", "cocycles", "collapse",
        "arcs", "digits", "radius", "surface map", "cocycles"}},
      {Mode::kThesis,
       {"slices", "slice error", "cone refinement", "slice error", "skeletal points", "cocycles", "collapse",
        "radius"}}};
  const DefaultMesh mesh = mesh_of({"torus", 150, 0});
  for (const auto& [mode, names] : expected) {
    ExtractOptions options = options_for(mode, 2);
    std::vector<std::string> seen;
    bool in_range = true;
    options.execution.progress = [&](const char* stage, double share) {
      if (seen.empty() || seen.back() != stage) seen.push_back(stage);
      in_range = in_range && share >= 0 && share <= 1;
      return true;
    };
    (void)extract_skeleton(mesh, options);
    CHECK(in_range);
    CHECK(seen == names);
  }
}

TEST_CASE("A callback that says no is not asked again, and the call throws Cancelled") {
  const DefaultMesh mesh = mesh_of({"torus", 600, 0});
  for (const Mode mode : {Mode::kDefault, Mode::kThesis}) {
    ExtractOptions options = options_for(mode, 2);
    int calls = 0, last = 0;
    options.execution.progress = [&](const char*, double) { return ++calls, true; };
    const CurveSkeleton whole = extract_skeleton(mesh, options).skeleton;
    const int all = calls;
    CHECK(all > 20);
    for (const int share : {0, 1, 3, 5, 7, 9}) {
      calls = 0;
      last = 1 + all * share / 10;
      options.execution.progress = [&](const char*, double) { return ++calls < last; };
      // The number of calls may differ a little from run to run with two threads; the last ones are certain.
      try {
        (void)extract_skeleton(mesh, options);
        CHECK(calls < last);
      } catch (const Cancelled&) {
        CHECK(calls == last);
      }
    }
    options.execution.progress = nullptr;
    CHECK(same_bytes(whole, extract_skeleton(mesh, options).skeleton));
  }
}

TEST_CASE("Options out of range are named before any work") {
  const DefaultMesh mesh = tetrahedron();
  const auto fails = [&](const std::function<void(ExtractOptions&)>& change) {
    ExtractOptions options = default_options();
    change(options);
    bool asked = false;
    options.execution.progress = [&](const char*, double) { return asked = true; };
    CHECK_THROWS_AS(extract_skeleton(mesh, options), UsageError);
    CHECK_FALSE(asked);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  fails([](ExtractOptions& o) { o.search.angles = 0; });
  fails([](ExtractOptions& o) { o.search.max_tilt = 90; });
  fails([](ExtractOptions& o) { o.sampling.planes = 0; });
  fails([&](ExtractOptions& o) { o.coherence.strength = nan; });
  fails([](ExtractOptions& o) { o.collapse.lambda = -1; });
  fails([](ExtractOptions& o) { o.collapse.angle_floor = 2; });
  fails([&](ExtractOptions& o) { o.refinement.centering.step = nan; });
  fails([](ExtractOptions& o) { o.refinement.centering.step = 0; });
  fails([](ExtractOptions& o) { o.refinement.centering.rays = 257; });
  fails([](ExtractOptions& o) { o.refinement.centering.damping = 0; });
  fails([](ExtractOptions& o) { o.refinement.extension.tip_clearance = 0; });
  fails([](ExtractOptions& o) { o.refinement.zip.closeness = 3; });
  fails([](ExtractOptions& o) { o.refinement.joint_overlap = -1; });
  fails([&](ExtractOptions& o) { o.refinement.limbs.slenderness = nan; });
}

TEST_CASE("Meshes that are no closed surface are refused") {
  CHECK_THROWS_AS(extract_skeleton(DefaultMesh()), MeshError);
  DefaultMesh triangle;
  const auto a = triangle.add_vertex({0, 0, 0}), b = triangle.add_vertex({1, 0, 0}),
             c = triangle.add_vertex({0, 1, 0});
  CHECK_THROWS_AS(extract_skeleton(triangle), MeshError);  // vertices, but no face
  triangle.add_face(a, b, c);
  CHECK_THROWS_AS(extract_skeleton(triangle), MeshError);  // open
  DefaultMesh broken = tetrahedron();
  broken.set_point(OpenMesh::VertexHandle(2), {0, std::numeric_limits<double>::infinity(), 0});
  CHECK_THROWS_AS(extract_skeleton(broken), MeshError);
  CHECK_THROWS_AS(extract_skeleton(scaled(tetrahedron(), 0)), MeshError);  // one point
}

// A thread of radius 0.5 along a circle's arc with twigs of that radius at even distances: what a twig
// protrudes by is a two hundredth of the extent, and more than the thread is thick.
TEST_CASE("A long thread keeps its short twigs: what is small is told by the width that it sits on") {
  constexpr Index kTwigs = 9;
  constexpr double kApart = 16, kTwig = 2.6;
  BallGraph thread;
  for (Index i = 0; i < kTwigs + 2; ++i) {
    const double turn = kApart * (i - 0.5 * (kTwigs + 1)) / 400;
    thread.nodes.push_back({{400 * std::sin(turn), 400 * std::cos(turn), 0}, 0.5});
    if (i > 0) thread.edges.push_back({i - 1, i});
  }
  for (Index i = 1; i <= kTwigs; ++i) {
    const double angle = 2.4 * i;  // about the thread
    const Vector3 root = thread.nodes[i].position, out = root.normalized();
    thread.edges.push_back({i, static_cast<Index>(thread.nodes.size())});
    thread.nodes.push_back(
        {root + kTwig * (std::cos(angle) * out + std::sin(angle) * Vector3::UnitZ()), 0.4});
  }
  const ExtractResult result = extract_skeleton(to_mesh(skin_graph(thread, 6000)));
  std::vector<int> edges_at(result.skeleton.nodes.size(), 0);
  for (const auto& [a, b] : result.skeleton.edges) ++edges_at[a], ++edges_at[b];
  CHECK(std::count(edges_at.begin(), edges_at.end(), 1) == kTwigs + 2);
  CHECK(result.coarse.has_value());
}
