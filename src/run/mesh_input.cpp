#include "mesh_input.h"

#include <charconv>

#include "mspskel/base/error.h"
#include "mspskel/io/write_mesh.h"

namespace mspskel::cli {
namespace {

MeshInput mend(const PolygonSoup& soup, const RepairSettings& settings) {
  MeshInput input;
  input.mended = true;
  input.repair = mend_soup(soup, settings.options);
  input.built = build_mesh_with_report(input.repair.soup);
  const std::string done = summary(input.repair);
  if (!done.empty()) input.built.warnings.insert(input.built.warnings.begin(), "mended: " + done);
  input.repair.soup = {};
  return input;
}

Json opening_json(const Opening& opening) {
  const auto list = [](const Vector3& v) { return Json{v[0], v[1], v[2]}; };
  return {{"centre", list(opening.centre)}, {"normal", list(opening.normal)}, {"radius", opening.radius}};
}

}  // namespace

void RepairSettings::resolve() {
  double& share = options.smallest_component;
  if (components == "all" || components == "largest") {
    share = components == "all" ? 0 : 1;
    return;
  }
  const char* const end = components.data() + components.size();
  const auto [stop, error] = std::from_chars(components.data(), end, share);
  if (error != std::errc() || stop != end || !(share >= 0 && share <= 1))
    throw UsageError("--components: expected all, largest or a share from 0 to 1, not '" + components + "'");
}

void add_repair_options(CommandLine& line, RepairSettings& settings) {
  line.group("Repair, of a mesh that is not closed and manifold");
  line.choice<bool>("--repair", settings.repair, {{"auto", true}, {"off", false}},
                    "auto: mend it and say what was done; off: refuse it");
  line.text("--components", settings.components, "all|largest|SHARE",
            "pieces that stay: those whose extent is at least this share of the largest one's");
  line.number("--weld", settings.options.weld, {0, 0.01},
              "points nearer than this share of the extent are one; equal ones always are");
  line.choice<OpenEnds>(
      "--open", settings.options.open,
      {{"ends", OpenEnds::kEnds}, {"cap", OpenEnds::kCap}, {"fail", OpenEnds::kFail}},
      "ends: where a tube is open its skeleton ends, other holes are closed; cap: all are; fail: refuse");
}

CurveSkeleton MeshInput::of_file(const CurveSkeleton& skeleton) const {
  CurveSkeleton result = skeleton;
  if (!mended) return result;
  result.node_of_vertex.clear();
  for (const Index v : repair.vertex_of_point)
    result.node_of_vertex.push_back(v == kNone ? kNone : skeleton.node_of_vertex[v]);
  return result;
}

CurveSkeleton MeshInput::of_surface(const CurveSkeleton& skeleton) const {
  CurveSkeleton result = skeleton;
  if (!mended || skeleton.node_of_vertex.size() != repair.vertex_of_point.size()) return result;
  result.node_of_vertex.assign(built.mesh.n_vertices(), kNone);
  for (std::size_t p = 0; p < repair.vertex_of_point.size(); ++p)
    if (repair.vertex_of_point[p] != kNone)
      result.node_of_vertex[repair.vertex_of_point[p]] = skeleton.node_of_vertex[p];
  return result;
}

MeshInput prepare_mesh(const PolygonSoup& soup, const RepairSettings& settings) {
  const MendOptions defaults;
  const bool wants_more =
      settings.options.weld > 0 || settings.options.smallest_component != defaults.smallest_component;
  MeshInput input;
  if (!settings.repair) {
    input.built = build_mesh_with_report(soup);
  } else if (wants_more) {
    input = mend(soup, settings);
  } else {
    try {
      input.built = build_mesh_with_report(soup);
    } catch (const MeshError&) {
      input = mend(soup, settings);
    }
  }
  input.built.warnings.insert(input.built.warnings.begin(), soup.warnings.begin(), soup.warnings.end());
  if (!settings.write_mesh.empty()) write_mesh(settings.write_mesh, input.built.mesh);
  return input;
}

Json repair_facts(const MeshInput& input) {
  const MendCounts& c = input.repair.counts;
  Json openings = Json::array();
  for (const Opening& opening : input.repair.openings) openings.push_back(opening_json(opening));
  return {{"mended", input.mended},
          {"points", input.repair.vertex_of_point.size()},
          {"welded_points", c.welded_points},
          {"stitched_points", c.stitched_points},
          {"isolated_points", c.isolated_points},
          {"degenerate_faces", c.degenerate_faces},
          {"repeated_faces", c.repeated_faces},
          {"two_sided_faces", c.two_sided_faces},
          {"flap_faces", c.flap_faces},
          {"turned_faces", c.turned_faces},
          {"paired_edges", c.paired_edges},
          {"one_sided_edges", c.one_sided_edges},
          {"split_vertices", c.split_vertices},
          {"split_edges", c.split_edges},
          {"holes", c.holes},
          {"hole_faces", c.hole_faces},
          {"joined_pieces", c.joined_pieces},
          {"flat_components", c.flat_components},
          {"small_components", c.small_components},
          {"small_faces", c.small_faces},
          {"openings", openings}};
}

}  // namespace mspskel::cli
