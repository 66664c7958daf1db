// mspskel check MESH SKELETON: is this the skeleton of that mesh?
#include <cstdio>
#include <optional>

#include "certificate.h"
#include "checked_extraction.h"
#include "commands.h"
#include "distinct_files.h"
#include "mesh_input.h"
#include "mspskel/base/counted.h"
#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/read_skeleton.h"
#include "mspskel/limbs/coverage.h"
#include "mspskel/mesh/bounding_volume_hierarchy.h"
#include "mspskel/mesh/surface_snapshot.h"
#include "mspskel/skeleton/check_skeleton.h"
#include "report.h"
#include "verdict.h"

namespace mspskel::cli {
namespace {

struct Checked {
  SkeletonChecks checks;
  TopologyCertificate certificate;
  std::vector<UncoveredPart> uncovered;
  bool wrapped = false;  // the surface that it was checked against
  std::string failure;   // a sentence; empty: none
};

void print(const Checked& checked) {
  const SkeletonChecks& c = checked.checks;
  const TopologyCertificate& certificate = checked.certificate;
  if (checked.wrapped) std::printf("surface      that round the mesh, which extraction wraps\n");
  std::printf("topology     %s: %s and %s on a surface of %s and genus %d\n", c.topology ? "right" : "WRONG",
              counted(c.b0, "piece").c_str(), counted(c.b1, "cycle").c_str(),
              counted(c.components, "component").c_str(), c.genus);
  if (certificate.small_handles > 0)
    std::printf("             without %s too small for a cycle\n",
                counted(certificate.small_handles, "handle").c_str());
  std::printf("certificate  %s%s%s\n", to_string(certificate.verdict), certificate.reason.empty() ? "" : ": ",
              certificate.reason.c_str());
  std::printf("inside       %.4g %% of the length; %s outside, %s through the surface\n", 100 * c.inside,
              counted(c.outside_nodes, "node").c_str(), counted(c.crossing_edges, "edge").c_str());
  std::printf("off centre   mean %.4f, 90th percentile %.4f (0: centred, 1: at the wall)\n",
              c.off_centre_mean, c.off_centre_p90);
  std::printf("cover        mean %.4f, 95th percentile %.4f of the diagonal\n", c.cover_mean, c.cover_p95);
  if (checked.uncovered.empty())
    std::printf("coverage     every part of %.3g widths has an arc\n", kMissedWidths);
  for (const UncoveredPart& part : checked.uncovered)
    std::printf("coverage     NO ARC in a %s of %.2g widths at %.6g %.6g %.6g\n",
                part.is_plate ? "plate" : "part", part.widths, part.position.x(), part.position.y(),
                part.position.z());
  std::printf("graph        %s, %s, %s, %s, %s\n", counted(c.nodes, "node").c_str(),
              counted(c.edges, "edge").c_str(), counted(c.leaves, "leaf", "leaves").c_str(),
              counted(c.joints, "joint").c_str(), counted(c.spurs, "spur").c_str());
  std::printf("arcs         length %.4f, longest edge %.4f of the diagonal, bend %.2f degrees\n", c.length,
              c.longest_edge, c.bend);
  std::printf("radius       off by %.3g of the diagonal at most\n", c.radius_error);
}

class CheckCommand : public Command {
 public:
  CheckCommand()
      : Command("check MESH SKELETON [options]",
                "Verifies a skeleton against its mesh: pieces, cycles, containment, centredness, radius.") {
    CommandLine& table = line();
    table.argument("MESH", mesh_path_, "mesh (.off .obj .ply .stl .vtk .vtp .gltf .glb .3mf), - for stdin")
        ->required();
    table.argument("SKELETON", skeleton_path_, "skeleton (.skel .obj .ply .json .swc .cgal .polylines.txt)")
        ->required();
    table.number("--least-inside", least_inside_, {0, 1}, "share of the length that must be inside");
    table.number("--smallest-handle", cocycle_options_.smallest_handle, {0, 1},
                 "handles round which a shorter loop runs have no cycle; share of the extent, 0: none");
    table.text("--json", json_path_, "FILE", "the figures as JSON; - for stdout, in place of the text");
    table.flag("-q,--quiet", quiet_, "no text, only the exit status");
    table.number("-t,--threads", execution_.threads, {0, 4096}, "0: as many as the machine has");
    add_repair_options(table, repair_);
    table.section(
        {"Exit status",
         "  0 if the certificate is not \"failed\" and enough of the skeleton inside, 5 if not.\n"});
  }

  int run() override;

 private:
  Checked check_against(const MeshInput& input, const CurveSkeleton& read) const;
  // Nothing where extraction with the same repair options would not wrap the mesh.
  std::optional<Checked> check_against_wrap(const PolygonSoup& soup, const MeshInput& input,
                                            const CurveSkeleton& read) const;

  std::string mesh_path_, skeleton_path_, json_path_;
  double least_inside_ = 1;
  bool quiet_ = false;
  CocycleOptions cocycle_options_;
  Execution execution_;
  RepairSettings repair_;
};

Checked CheckCommand::check_against(const MeshInput& input, const CurveSkeleton& read) const {
  const SurfaceSnapshot surface = make_snapshot(input.built.mesh);
  const CurveSkeleton skeleton = input.of_surface(read);
  const BoundingVolumeHierarchy solid(surface);
  const VolumeCocycles cocycles = compute_volume_cocycles(surface, {}, cocycle_options_);
  Checked checked;
  checked.wrapped = input.wrapped.has_value();
  SkeletonChecks& checks = checked.checks;
  const SolidHierarchies solids(surface, solid, execution_.progress);
  checks = check_skeleton(surface, solids, skeleton, execution_);
  checked.certificate = certify(surface, cocycles, solids, skeleton, CertificateDepth::kFull, execution_);
  checks.genus -= checked.certificate.small_handles;
  checks.topology = checks.b0 == checks.components && checks.b1 == checks.genus;
  checked.uncovered = find_uncovered_parts(surface, solids, skeleton, CoverageOptions{}, execution_);
  checked.failure = judge(surface, checked.certificate, checked.uncovered, least_inside_).failure;
  if (checked.failure.empty() && least_inside_ >= 1 && !checks.contained)
    checked.failure = "the skeleton leaves the solid";
  return checked;
}

// Extraction wraps a mesh whose own surface carries no skeleton, so such a mesh is extracted to know it.
std::optional<Checked> CheckCommand::check_against_wrap(const PolygonSoup& soup, const MeshInput& input,
                                                        const CurveSkeleton& read) const {
  RunOptions run;
  run.repair = repair_;
  run.extract = default_options();
  run.extract.execution = execution_;
  const CheckedExtraction made = extract_checked(soup, MeshInput(input), run, CertificateDepth::kVerdict);
  if (!made.input.wrapped) return std::nullopt;
  return check_against(made.input, read);
}

int CheckCommand::run() {
  repair_.resolve();
  refuse_shared_files({{mesh_path_, "the mesh"}, {skeleton_path_, "the skeleton"}},
                      {{json_path_, "the figures"}});
  const PolygonSoup soup = read_polygon_soup(mesh_path_);
  const MeshInput input = prepare_mesh(soup, repair_, execution_);
  const CurveSkeleton skeleton = read_skeleton(skeleton_path_);
  Checked checked = check_against(input, skeleton);
  if (!checked.failure.empty() && !input.wrapped && repair_.wrap_mode == WrapMode::kAuto)
    if (const std::optional<Checked> of_wrap = check_against_wrap(soup, input, skeleton)) checked = *of_wrap;
  if (!json_path_.empty()) {
    Json figures = checks_json(checked.checks, checked.certificate, checked.uncovered);
    figures["wrapped"] = checked.wrapped;
    write_file_atomically(json_path_, report_text(figures));
  }
  if (!quiet_ && json_path_ != "-") print(checked);
  if (!checked.failure.empty()) throw NoSkeletonError(checked.failure);
  return 0;
}

}  // namespace

std::unique_ptr<Command> make_check_command(const std::vector<std::string>&) {
  return std::make_unique<CheckCommand>();
}

}  // namespace mspskel::cli
