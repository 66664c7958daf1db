// The OpenMesh module computes what the skeleton decimater computes, and its merging sets partition the
// vertices.
#include "mspskel/collapse/mod_msp_skeleton.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "mspskel/collapse/skeleton_decimater.h"

using namespace mspskel;

namespace {

struct FloatTraits : OpenMesh::DefaultTraits {};
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<FloatTraits>;

// A tube bent to a ring: rings × sides quads, split.
template <class Mesh>
Mesh torus(int rings, int sides) {
  Mesh mesh;
  mesh.request_vertex_status();
  mesh.request_edge_status();
  mesh.request_face_status();
  std::vector<typename Mesh::VertexHandle> v;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const double a = 2 * kPi * i / rings, b = 2 * kPi * j / sides, r = 3 + std::cos(b);
      typename Mesh::Point p;
      p[0] = static_cast<typename Mesh::Scalar>(r * std::cos(a));
      p[1] = static_cast<typename Mesh::Scalar>(r * std::sin(a));
      p[2] = static_cast<typename Mesh::Scalar>(std::sin(b));
      v.push_back(mesh.add_vertex(p));
    }
  const auto at = [&](int i, int j) { return v[static_cast<std::size_t>((i % rings) * sides + j % sides)]; };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

template <class Mesh>
std::vector<MergingVertex> random_vertices(const Mesh& mesh) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<MergingVertex> vertices;
  for (const auto v : mesh.vertices()) {
    MergingVertex vertex;
    vertex.position = to_vector3(mesh.point(v));
    vertex.perimeter = 1 + uniform(random);
    vertex.normal = Vector3{uniform(random), uniform(random), uniform(random) + 0.01}.normalized();
    vertex.error = uniform(random);
    vertex.area = 0.5 + uniform(random);
    vertices.push_back(vertex);
  }
  return vertices;
}

}  // namespace

TEMPLATE_TEST_CASE("policy values equal the skeleton decimater's for the same edges", "", DefaultMesh,
                   FloatMesh) {
  TestType mesh = torus<TestType>(12, 6);
  const auto vertices = random_vertices(mesh);
  const SurfaceSnapshot snapshot = make_snapshot(mesh);
  std::vector<MergingSet> sets;
  for (const MergingVertex& v : vertices) sets.emplace_back(v);
  CollapseOptions options;
  options.lambda = 0.3;
  options.angle_floor = 0.05;
  SkeletonDecimater skeleton(make_complex(snapshot), sets, options);

  OpenMesh::Decimater::DecimaterT<TestType> decimater(mesh);
  typename ModMspSkeletonT<TestType>::Handle handle;
  decimater.add(handle);
  auto& module = decimater.module(handle);
  module.set_vertices(vertices);
  module.set_options(options);
  REQUIRE(decimater.initialize());
  for (Index e = 0; e < skeleton.complex().edge_capacity(); ++e) {
    const auto [u, v] = skeleton.complex().ends(e);
    const typename TestType::VertexHandle a(u), b(v);
    CHECK(module.cost(a, b) == Approx(skeleton.cost(e)).epsilon(1e-12));
    OpenMesh::Decimater::CollapseInfoT<TestType> info(mesh, mesh.find_halfedge(a, b));
    CHECK(module.collapse_priority(info) == Approx(skeleton.cost(e)).epsilon(1e-6));
  }
}

TEMPLATE_TEST_CASE("merging sets partition the vertices after a stock decimation", "", DefaultMesh,
                   FloatMesh) {
  TestType mesh = torus<TestType>(16, 8);
  const auto vertices = random_vertices(mesh);
  double area = 0;
  for (const MergingVertex& v : vertices) area += v.area;
  const auto properties = [&] {
    return std::count_if(mesh.vprops_begin(), mesh.vprops_end(), [](const auto* p) { return p != nullptr; });
  };
  const auto before = properties();
  {
    OpenMesh::Decimater::DecimaterT<TestType> decimater(mesh);
    typename ModMspSkeletonT<TestType>::Handle handle;
    decimater.add(handle);
    auto& module = decimater.module(handle);
    module.set_vertices(vertices);
    REQUIRE(decimater.initialize());
    REQUIRE(decimater.decimate_to(20) > 0);
    std::vector<MergingSet> expected(vertices.size());
    const std::vector<Index> node = module.node_of_vertex();
    for (std::size_t v = 0; v < vertices.size(); ++v) expected[node[v]].merge(MergingSet(vertices[v]));
    Index covered = 0;
    double covered_area = 0;
    for (const auto v : mesh.vertices()) {
      const MergingSet &set = module.merging_set(v), &sum = expected[static_cast<std::size_t>(v.idx())];
      CHECK(set.count() == sum.count());
      CHECK((set.position() - sum.position()).norm() < 1e-9);
      CHECK((to_vector3(mesh.point(v)) - set.position()).norm() < 1e-5);
      covered += set.count();
      covered_area += set.area();
    }
    CHECK(covered == static_cast<Index>(vertices.size()));
    CHECK(covered_area == Approx(area));
  }
  CHECK(properties() == before);
}

TEST_CASE("the saturation constraint stops collapses between nodes of like areas") {
  for (const bool on : {false, true}) {
    DefaultMesh mesh = torus<DefaultMesh>(8, 4);
    OpenMesh::Decimater::DecimaterT<DefaultMesh> decimater(mesh);
    ModMspSkeletonT<DefaultMesh>::Handle handle;
    decimater.add(handle);
    decimater.module(handle).set_vertices(random_vertices(mesh));
    decimater.module(handle).set_saturation_constraint(on);
    REQUIRE(decimater.initialize());
    CHECK((decimater.decimate(5) == 0) == on);
  }
}

TEST_CASE("the module wants one entry a vertex") {
  DefaultMesh mesh = torus<DefaultMesh>(8, 4);
  OpenMesh::Decimater::DecimaterT<DefaultMesh> decimater(mesh);
  ModMspSkeletonT<DefaultMesh>::Handle handle;
  decimater.add(handle);
  CHECK_THROWS_AS(decimater.initialize(), UsageError);
}
