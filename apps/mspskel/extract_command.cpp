// mspskel IN [OUT...]: from a mesh file to skeleton files.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cancellation.h"
#include "commands.h"
#include "distinct_files.h"
#include "extract_settings.h"
#include "mesh_input.h"
#include "mspskel/base/error.h"
#include "mspskel/base/progress.h"
#include "mspskel/base/stopwatch.h"
#include "mspskel/graph/end_at_openings.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/write_skeleton.h"
#include "page_output.h"
#include "report.h"
#include "stage_files.h"
#include "terminal.h"
#include "thread_placement.h"
#include "verdict.h"

namespace mspskel::cli {
namespace {

namespace fs = std::filesystem;

void check_folder(const fs::path& path, const fs::path& folder) {
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw WriteError("cannot write " + path.string() + ": " + std::strerror(errno));
}

// A file can be made there, as far as one can tell beforehand.
void check_writable(const fs::path& path) {
  if (path == "-") return;
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw WriteError(path.string() + " is a folder");
  check_folder(path, fs::absolute(path, ignored).parent_path());
}

// The same for a folder, which is not made before there is something to put into it.
void check_folder_writable(const fs::path& path) {
  std::error_code ignored;
  fs::path there = fs::absolute(path, ignored);
  while (!fs::exists(there, ignored) && there.has_parent_path()) there = there.parent_path();
  if (!fs::is_directory(there, ignored))
    throw WriteError("cannot write to " + path.string() + ": " + there.string() + " is not a folder");
  check_folder(path, there);
}

// What is wrong with the places of the outputs shows before the work, not after it.
void check_outputs(const ExtractSettings& settings) {
  std::vector<FileRole> written;
  for (const std::string& output : settings.outputs) {
    if (!is_page(output)) skeleton_format_of(output);
    written.push_back({output, "an output"});
  }
  written.push_back({settings.report, "the report"});
  written.push_back({settings.repair.write_mesh, "the mended mesh"});
  if (!settings.stages.empty()) {
    written.push_back({settings.stages, "the folder of the stages"});
    for (const std::string& path : stage_file_paths(settings.stages))
      written.push_back({path, "a file of the stages"});
  }
  refuse_shared_files({{settings.input, "the mesh"}}, written);
  for (const std::string& output : settings.outputs) check_writable(output);
  if (!settings.report.empty()) check_writable(settings.report);
  if (!settings.repair.write_mesh.empty()) check_writable(settings.repair.write_mesh);
  if (!settings.stages.empty()) check_folder_writable(settings.stages);
}

// Some outputs hold the report.
bool writes_report(const ExtractSettings& settings) {
  return std::any_of(settings.outputs.begin(), settings.outputs.end(), [](const std::string& output) {
    return is_page(output) || skeleton_format_of(output) == SkeletonFormat::kJson;
  });
}

void add_losses(const ExtractSettings& settings, ExtractResult& result) {
  for (const std::string& output : settings.outputs) {
    if (is_page(output)) continue;
    for (const std::string& loss : losses_of_format(result.skeleton, skeleton_format_of(output)))
      result.warnings.push_back(output + ": " + loss);
  }
}

void show_warnings(const ExtractResult& result, Terminal& terminal) {
  terminal.clear_progress();
  for (const std::string& warning : result.warnings) terminal.warning(warning);
}

void end_at_open_ends(const MeshInput& input, const ExtractOptions& options, ExtractResult& result) {
  if (input.repair.openings.empty()) return;
  const BoundingVolumeHierarchy solid(result.surface);
  const OpeningEnds ends = end_at_openings(result.skeleton, result.surface, solid, input.repair.openings,
                                           options.refinement.centering.step);
  if (ends.missing > 0)
    result.warnings.push_back("the skeleton does not end at " + std::to_string(ends.missing) +
                              " of the open ends: no way there is straight");
}

struct Extraction {
  MeshInput input;
  ExtractResult result;
  bool reported = false;  // as JSON, somewhere
  Json facts;             // if so
  std::string failure;    // of the checks; empty: none
};

Extraction extract_and_check(const ExtractSettings& settings, const Cancellation& cancellation,
                             ProgramSeconds& seconds) {
  const Stopwatch reading;
  Extraction made;
  made.input = prepare_mesh(read_polygon_soup(settings.input), settings.repair, settings.options.execution);
  const BuiltMesh& input = made.input.built;
  seconds.read = reading.seconds();
  cancellation.throw_if_requested();
  made.result = extract_skeleton(input.mesh, settings.options);
  ExtractResult& result = made.result;
  end_at_open_ends(made.input, settings.options, result);
  result.warnings.insert(result.warnings.begin(), input.warnings.begin(), input.warnings.end());
  add_losses(settings, result);
  made.reported = !settings.report.empty() || settings.verbose || writes_report(settings);

  const Stopwatch checking;
  if (!result.solid) result.solid = std::make_shared<const BoundingVolumeHierarchy>(result.surface);
  const TopologyCertificate certificate =
      certify(result.surface, result.cocycles, *result.solid, result.skeleton,
              made.reported ? CertificateDepth::kFull : CertificateDepth::kVerdict);
  result.seconds.emplace_back("checks", checking.seconds());
  Verdict verdict = judge(result.surface, certificate);
  result.warnings.insert(result.warnings.end(), verdict.warnings.begin(), verdict.warnings.end());
  made.failure = std::move(verdict.failure);
  if (!made.reported) return made;
  made.facts = make_report(settings, result, certificate);
  made.facts["repair"] = repair_facts(made.input);
  return made;
}

void write_files(const ExtractSettings& settings, const Extraction& made, const Stopwatch& total,
                 ProgramSeconds& seconds, Terminal& terminal) {
  const Stopwatch writing;
  const CurveSkeleton skeleton = made.input.of_file(made.result.skeleton);
  for (const std::string& output : settings.outputs) {
    if (is_page(output))
      write_page(output, settings.input, made.result, made.facts);
    else
      write_skeleton(output, skeleton, made.reported ? report_text(made.facts) : "");
  }
  if (!settings.stages.empty()) write_stage_files(settings.stages, made.result);
  seconds.write = writing.seconds();
  seconds.total = total.seconds();
  if (!made.reported) return;
  const Json report = with_costs(made.facts, settings, made.result, seconds);
  terminal.clear_progress();
  for (const char* part : {"input", "counts", "seconds", "skeleton", "checks"})
    terminal.note(std::string(part) + " " + report_text(report[part], -1));
  if (!settings.report.empty()) write_file_atomically(settings.report, report_text(report));
}

void extract(const ExtractSettings& given, const Cancellation& cancellation, Terminal& terminal) {
  ExtractSettings settings = given;
  settings.options.execution.progress = [&](const char* stage, double fraction) {
    terminal.progress(stage, fraction);
    return !cancellation.requested();
  };
  const Stopwatch total;
  ProgramSeconds seconds;
  check_outputs(settings);
  keep_threads_apart(thread_count(settings.options.execution));
  const Extraction made = extract_and_check(settings, cancellation, seconds);
  cancellation.throw_if_requested();
  show_warnings(made.result, terminal);
  if (!made.failure.empty() && !settings.keep_failed)
    throw NoSkeletonError(made.failure + " (--keep-failed writes it all the same)");
  write_files(settings, made, total, seconds, terminal);
  if (!made.failure.empty()) throw NoSkeletonError(made.failure);
}

}  // namespace

int extract_command(const std::vector<std::string>& arguments) {
  ExtractSettings settings;
  if (!parse_extract_settings(arguments, settings)) return 0;
  const Cancellation cancellation(settings.time_limit);
  Terminal terminal(settings.verbosity());
  try {
    extract(settings, cancellation, terminal);
  } catch (const Cancelled&) {
    throw Error(ErrorKind::kCancelled, cancellation.reason());
  }
  return 0;
}

}  // namespace mspskel::cli
