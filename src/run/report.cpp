#include "report.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "certificate.h"
#include "mesh_input.h"

namespace mspskel::cli {
namespace {

// Of this program alone: what getrusage knows of may be that of the process that started it.
std::optional<std::int64_t> peak_resident_set() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::atoll(line.c_str() + 6) * 1024;  // in kilobytes
  return std::nullopt;
}

std::int64_t peak_memory_bytes() {
  if (const auto peak = peak_resident_set()) return *peak;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in kilobytes
}

double refined_share(const VertexSlices& slices) {
  if (slices.refined.empty()) return 0;
  const auto refined = std::count(slices.refined.begin(), slices.refined.end(), 1);
  return static_cast<double>(refined) / static_cast<double>(slices.refined.size());
}

Json input_facts(const std::string& file, const ExtractResult& result) {
  const SurfaceSnapshot& surface = result.surface;
  Index genus = 0;
  for (const Index g : result.cocycles.genus) genus += g;
  return {{"file", file},
          {"vertices", surface.vertex_count()},
          {"faces", surface.face_count()},
          {"components", surface.component_count},
          {"genus", genus}};
}

Json work_counts(const ExtractResult& result) {
  const CollapseCounts& collapse = result.collapsed.counts;
  return {{"slices", result.slices.slices},
          {"steps", result.slices.steps},
          {"refined_share", refined_share(result.slices)},
          {"without_slice", result.skeleton_mesh.without_slice},
          {"collapses", collapse.collapses},
          {"refusals",
           {{"labels", collapse.refused_labels},
            {"loop", collapse.refused_loop},
            {"skeleton_edge", collapse.listed}}},
          {"deleted_faces", collapse.deleted_faces + collapse.thinned_faces},
          {"deleted_edges", collapse.deleted_edges},
          {"pruned_branches", result.refinement.pruned},
          {"merged_joints", result.refinement.joints_merged}};
}

Json stage_seconds(const ExtractResult& result, const ProgramSeconds& program) {
  Json seconds{{"total", program.total}, {"read", program.read}};
  for (const auto& [stage, time] : result.seconds) {
    if (!seconds.contains(stage)) seconds[stage] = 0.0;
    seconds[stage] = seconds[stage].get<double>() + time;  // a stage may run twice
  }
  seconds["write"] = program.write;
  return seconds;
}

Json coverage_json(const std::vector<UncoveredPart>& uncovered) {
  Json parts = Json::array();
  for (const UncoveredPart& part : uncovered)
    parts.push_back({{"vertex", part.vertex},
                     {"position", {part.position.x(), part.position.y(), part.position.z()}},
                     {"depth", part.depth},
                     {"widths", part.widths},
                     {"plate", part.is_plate}});
  return {{"uncovered", parts}};
}

}  // namespace

Json make_report(const std::string& file, const ExtractResult& result, const TopologyCertificate& certificate,
                 const std::vector<UncoveredPart>& uncovered) {
  const GraphCounts graph = count_graph(result.skeleton);
  Json checks = certificate_json(certificate);
  checks["coverage"] = coverage_json(uncovered);
  return {{"input", input_facts(file, result)},
          {"counts", work_counts(result)},
          {"skeleton",
           {{"nodes", graph.nodes},
            {"edges", graph.edges},
            {"components", graph.components},
            {"cycles", graph.cycles},
            {"leaves", graph.leaves},
            {"length", graph.length}}},
          {"checks", checks},
          {"warnings", result.warnings}};
}

Json with_costs(const Json& report, const Json& options, const ExtractResult& result,
                const ProgramSeconds& seconds) {
  return {{"input", report["input"]},
          {"repair", report["repair"]},
          {"options", options},
          {"counts", report["counts"]},
          {"seconds", stage_seconds(result, seconds)},
          {"peak_memory_bytes", peak_memory_bytes()},
          {"skeleton", report["skeleton"]},
          {"checks", report["checks"]},
          {"warnings", report["warnings"]}};
}

Json error_json(const Error& error) {
  return {{"status", static_cast<int>(error.kind())}, {"message", error.what()}};
}

Json refusal_report(const std::string& file, const Json& options, const Error& error, double seconds) {
  Json report{{"input", {{"file", file}}}};
  if (const auto* mending = dynamic_cast<const MendError*>(&error))
    report["repair"] = counts_json(mending->counts);
  report.update({{"options", options},
                 {"seconds", {{"total", seconds}}},
                 {"peak_memory_bytes", peak_memory_bytes()},
                 {"error", error_json(error)}});
  return report;
}

Json checks_json(const SkeletonChecks& checks, const TopologyCertificate& certificate,
                 const std::vector<UncoveredPart>& uncovered) {
  return Json{{"topology", checks.topology},
              {"certificate", certificate_json(certificate)},
              {"coverage", coverage_json(uncovered)},
              {"b0", checks.b0},
              {"b1", checks.b1},
              {"components", checks.components},
              {"genus", checks.genus},
              {"contained", checks.contained},
              {"inside", checks.inside},
              {"outside_nodes", checks.outside_nodes},
              {"crossing_edges", checks.crossing_edges},
              {"nodes", checks.nodes},
              {"edges", checks.edges},
              {"leaves", checks.leaves},
              {"joints", checks.joints},
              {"spurs", checks.spurs},
              {"length", checks.length},
              {"longest_edge", checks.longest_edge},
              {"off_centre_mean", checks.off_centre_mean},
              {"off_centre_p90", checks.off_centre_p90},
              {"cover_mean", checks.cover_mean},
              {"cover_p95", checks.cover_p95},
              {"bend", checks.bend},
              {"radius_error", checks.radius_error},
              {"diagonal", checks.diagonal}};
}

std::string report_text(const Json& report, int indent) {
  return report.dump(indent, ' ', false, Json::error_handler_t::replace) + (indent < 0 ? "" : "\n");
}

}  // namespace mspskel::cli
