// mspskel IN [OUT...]: from a mesh file to skeleton files.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "cancellation.h"
#include "commands.h"
#include "extract_settings.h"
#include "mspskel/base/error.h"
#include "mspskel/base/progress.h"
#include "mspskel/base/stopwatch.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/write_skeleton.h"
#include "mspskel/mesh/build_mesh.h"
#include "report.h"
#include "stage_files.h"
#include "terminal.h"
#include "thread_placement.h"

namespace mspskel::cli {
namespace {

// A file can be made there, or the folder can, as far as one can tell beforehand.
void check_writable(const std::filesystem::path& path) {
  if (path == "-") return;
  std::error_code ignored;
  std::filesystem::path folder = std::filesystem::absolute(path, ignored).parent_path();
  if (std::filesystem::is_directory(path, ignored)) throw WriteError(path.string() + " is a folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw WriteError("cannot write " + path.string() + ": " + std::strerror(errno));
}

// A wrong extension or folder shows before the work, not after it.
void check_outputs(const ExtractSettings& settings) {
  for (const std::string& output : settings.outputs) skeleton_format_of(output);
  for (const std::string& output : settings.outputs) check_writable(output);
  if (!settings.report.empty()) check_writable(settings.report);
  if (!settings.stages.empty()) make_stage_folder(settings.stages);
}

bool writes_json(const ExtractSettings& settings) {
  return std::any_of(settings.outputs.begin(), settings.outputs.end(), [](const std::string& output) {
    return skeleton_format_of(output) == SkeletonFormat::kJson;
  });
}

void add_losses(const ExtractSettings& settings, ExtractResult& result) {
  for (const std::string& output : settings.outputs)
    for (const std::string& loss : losses_of_format(result.skeleton, skeleton_format_of(output)))
      result.warnings.push_back(output + ": " + loss);
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
  BuiltMesh input = build_mesh_with_report(read_polygon_soup(settings.input));
  seconds.read = total.seconds();
  cancellation.throw_if_requested();
  ExtractResult result = extract_skeleton(input.mesh, settings.options);
  result.warnings.insert(result.warnings.begin(), input.warnings.begin(), input.warnings.end());
  add_losses(settings, result);
  const bool reported = !settings.report.empty() || settings.verbose || writes_json(settings);
  const Json facts = reported ? make_report(settings, result) : Json();
  cancellation.throw_if_requested();

  const Stopwatch writing;
  for (const std::string& output : settings.outputs)
    write_skeleton(output, result.skeleton, reported ? report_text(facts) : "");
  if (!settings.stages.empty()) write_stage_files(settings.stages, result);
  seconds.write = writing.seconds();
  seconds.total = total.seconds();
  terminal.clear_progress();
  for (const std::string& warning : result.warnings) terminal.warning(warning);
  if (!reported) return;
  const Json report = with_costs(facts, settings, result, seconds);
  for (const char* part : {"input", "counts", "seconds", "skeleton", "checks"})
    terminal.note(std::string(part) + " " + report_text(report[part], -1));
  if (!settings.report.empty()) write_file_atomically(settings.report, report_text(report));
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
