// Nothing crashes, hangs, is not finite or loses topology, whatever the mesh looks like.
#include "extract/unusual_meshes.h"

#include <catch2/catch.hpp>
#include <set>

#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/mesh_report.h"
#include "mspskel/skeleton/surface_map.h"

using namespace mspskel;
using namespace mspskel::test;

namespace {

void check_result(const ExtractResult& result) {
  const CurveSkeleton& skeleton = result.skeleton;
  MeshReport surface;
  detail::measure_components(result.surface, surface);
  const GraphCounts counts = count_graph(skeleton);
  CHECK(counts.components == result.surface.component_count);
  CHECK(counts.cycles == surface.genus);
  for (const SkeletonNode& node : skeleton.nodes) {
    REQUIRE(node.position.allFinite());
    REQUIRE((std::isfinite(node.radius) && node.radius >= 0));
    REQUIRE((std::isfinite(node.area) && std::isfinite(node.perimeter) && std::isfinite(node.slice_error)));
  }
  CHECK(report_surface_map(result.surface, skeleton).partition);
  std::set<std::array<Index, 2>> edges(skeleton.edges.begin(), skeleton.edges.end());
  CHECK(edges.size() == skeleton.edges.size());
  for (const auto& [a, b] : skeleton.edges) CHECK(a < b);
}

}  // namespace

TEST_CASE("Unusual meshes keep their topology in both modes") {
  for (const auto& [name, mesh] : unusual_meshes())
    for (ExtractOptions options : {default_options(), thesis_options()}) {
      options.execution.threads = 1;
      INFO(name << (options.mode == Mode::kThesis ? ", thesis mode" : ", default mode"));
      check_result(extract_skeleton(mesh, options));
    }
}

TEST_CASE("A vertex that no face uses changes nothing") {
  const DefaultMesh mesh = prism(8, 6, 5);
  const auto alone = extract_skeleton(mesh).skeleton;
  const auto with_far = extract_skeleton(with_far_isolated_vertex(mesh)).skeleton;
  REQUIRE(with_far.nodes.size() == alone.nodes.size());
  for (std::size_t i = 0; i < alone.nodes.size(); ++i)
    REQUIRE((with_far.nodes[i].position - alone.nodes[i].position).norm() < 1e-9);
  REQUIRE(with_far.node_of_vertex.back() == kNone);
}
