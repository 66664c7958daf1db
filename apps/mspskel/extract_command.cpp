// mspskel IN [OUT...]: from a mesh file to skeleton files.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <optional>

#include "cancellation.h"
#include "checked_extraction.h"
#include "commands.h"
#include "distinct_files.h"
#include "extract_settings.h"
#include "memory_limit.h"
#include "mspskel/base/error.h"
#include "mspskel/base/near_name.h"
#include "mspskel/base/progress.h"
#include "mspskel/base/stopwatch.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/write_glb.h"
#include "mspskel/io/write_mesh.h"
#include "mspskel/io/write_segments.h"
#include "mspskel/io/write_skeleton.h"
#include "mspskel/render/render.h"
#include "page_scene.h"
#include "report.h"
#include "stage_files.h"
#include "terminal.h"
#include "thread_placement.h"

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

bool is_skeleton_file(const std::string& path) {
  return !is_page(path) && !is_glb(path) && !is_rig_text(path);
}

void refuse_unknown_format(const std::string& path) {
  std::vector<std::string> known = skeleton_extensions();
  try {
    skeleton_format_of(path);
  } catch (const UsageError&) {
    known.insert(known.end(), {".glb", ".rig.txt", ".html"});
    throw unknown_extension("format", path, known);
  }
}

// What is wrong with the places of the outputs shows before the work, not after it.
void check_outputs(const ExtractSettings& settings) {
  std::vector<FileRole> written;
  for (const std::string& output : settings.outputs) {
    if (is_skeleton_file(output)) refuse_unknown_format(output);
    written.push_back({output, "an output"});
  }
  written.push_back({settings.report, "the report"});
  if (!settings.segments.empty()) segment_format_of(settings.segments);
  written.push_back({settings.segments, "the file of the parts"});
  written.push_back({settings.bent, "the bent surface"});
  written.push_back({settings.run.repair.write_mesh, "the mended mesh"});
  if (!settings.stages.empty()) {
    written.push_back({settings.stages, "the folder of the stages"});
    for (const std::string& path : stage_file_paths(settings.stages))
      written.push_back({path, "a file of the stages"});
  }
  refuse_shared_files({{settings.input, "the mesh"}}, written);
  for (const std::string& output : settings.outputs) check_writable(output);
  if (!settings.report.empty()) check_writable(settings.report);
  if (!settings.segments.empty()) check_writable(settings.segments);
  if (!settings.bent.empty()) check_writable(settings.bent);
  if (!settings.run.repair.write_mesh.empty()) check_writable(settings.run.repair.write_mesh);
  if (!settings.stages.empty()) check_folder_writable(settings.stages);
}

// Some outputs hold the report.
bool writes_report(const ExtractSettings& settings) {
  return std::any_of(settings.outputs.begin(), settings.outputs.end(), [](const std::string& output) {
    return is_page(output) ||
           (is_skeleton_file(output) && skeleton_format_of(output) == SkeletonFormat::kJson);
  });
}

bool needs_parts(const ExtractSettings& settings, const ExtractResult& result) {
  const bool shown = std::any_of(settings.outputs.begin(), settings.outputs.end(), is_page);
  return !settings.segments.empty() || (shown && !result.skeleton.nodes.empty());
}

void add_losses(const ExtractSettings& settings, ExtractResult& result) {
  for (const std::string& output : settings.outputs) {
    if (!is_skeleton_file(output)) continue;
    for (const std::string& loss : losses_of_format(result.skeleton, skeleton_format_of(output)))
      result.warnings.push_back(output + ": " + loss);
  }
}

void show_warnings(const ExtractResult& result, Terminal& terminal) {
  terminal.clear_progress();
  for (const std::string& warning : result.warnings) terminal.warning(warning);
}

struct Extraction {
  CheckedExtraction made;
  bool reported = false;  // as JSON, somewhere
  Json facts;             // if so
  std::optional<Segmentation> segmentation;
  std::optional<Rig> rig;
  std::vector<JointTurn> pose;  // of the rig
};

// Pages show parts, too: those of the options' defaults where no file of parts is written.
void segment(const ExtractSettings& settings, Extraction& extraction) {
  const Stopwatch segmenting;
  ExtractResult& result = extraction.made.result;
  extraction.segmentation = segment_surface(
      result.surface, result.skeleton, settings.segments.empty() ? SegmentOptions{} : settings.segmentation,
      result.coarse ? &*result.coarse : nullptr, settings.run.extract.execution.progress);
  result.seconds.emplace_back("parts", segmenting.seconds());
}

void add_rig(const ExtractSettings& settings, Extraction& extraction) {
  const Stopwatch rigging;
  ExtractResult& result = extraction.made.result;
  extraction.rig = make_rig(result.surface, result.skeleton, settings.rigging);
  result.seconds.emplace_back("rig", rigging.seconds());
  for (const std::string& pose : settings.poses)
    extraction.pose.push_back(parse_joint_turn(*extraction.rig, pose));
  if (const std::size_t cut = extraction.rig->cut.size(); cut > 0)
    result.warnings.push_back("a rig has no loops: " + std::to_string(cut) +
                              " of the skeleton's are cut at their far ends");
}

void expect(ProgressEstimate& estimate, const MeshInput& input, const ExtractOptions& options) {
  const auto vertices = static_cast<Index>(input.built.mesh.n_vertices());
  estimate.expect_stages(options, vertices > options.coarsening.vertices);
  if (input.built.component_count < 2) return;
  const SurfaceSnapshot surface = make_snapshot(input.built.mesh);
  std::vector<std::size_t> faces(surface.component_count, 0);
  for (Index f = 0; f < surface.face_count(); ++f) ++faces[surface.component[surface.origin[3 * f]]];
  estimate.expect_components(faces);
}

// Files that number vertices or faces number the surface's, which are not the file's where it was mended or
// its shells were united.
void add_renumbered(const ExtractSettings& settings, CheckedExtraction& made) {
  if (!made.input.renumbered()) return;
  std::vector<std::string> numbering;
  std::copy_if(settings.outputs.begin(), settings.outputs.end(), std::back_inserter(numbering), is_rig_text);
  if (!settings.segments.empty()) numbering.push_back(settings.segments);
  if (!settings.stages.empty()) numbering.push_back(settings.stages);
  const std::string surface = made.input.united_shells() ? "surface of the united shells" : "mended surface";
  for (const std::string& path : numbering)
    made.result.warnings.push_back(path + ": vertices and faces are numbered as on the " + surface +
                                   "; --write-mesh writes it");
}

Extraction extract_and_check(const ExtractSettings& settings, const Cancellation& cancellation,
                             ProgramSeconds& seconds, Terminal& terminal) {
  const Stopwatch reading;
  const PolygonSoup soup = read_polygon_soup(settings.input);
  MeshInput input = prepare_mesh(soup, settings.run.repair, settings.run.extract.execution);
  seconds.read = reading.seconds();
  settings.root.resolve(input.repair.openings);  // what is wrong with it shows before the work
  cancellation.throw_if_requested();
  if (!settings.quiet) expect(terminal.estimate(), input, settings.run.extract);
  Extraction extraction;
  extraction.reported = !settings.report.empty() || settings.verbose || writes_report(settings);
  extraction.made =
      extract_checked(soup, std::move(input), settings.run,
                      extraction.reported ? CertificateDepth::kFull : CertificateDepth::kVerdict);
  add_losses(settings, extraction.made.result);
  add_renumbered(settings, extraction.made);
  if (needs_parts(settings, extraction.made.result)) segment(settings, extraction);
  if (settings.needs_rig()) add_rig(settings, extraction);
  if (extraction.reported) extraction.facts = facts_of(settings.input, extraction.made);
  return extraction;
}

void write_glb(const std::string& path, const ExtractSettings& settings, const Extraction& extraction) {
  const ExtractResult& result = extraction.made.result;
  const GlbScene scene{
      settings.input == "-" ? "standard input" : fs::path(settings.input).filename().string(),
      to_polygon_soup(result.surface), result.skeleton};
  write_file_atomically(
      path, settings.rig ? format_rigged_glb(scene, *extraction.rig, extraction.pose) : format_glb(scene));
}

void write_bent(const ExtractSettings& settings, const Extraction& extraction) {
  PolygonSoup surface = to_polygon_soup(extraction.made.result.surface);
  surface.points = bend(*extraction.rig, surface.points, extraction.pose);
  write_mesh(settings.bent, surface);
}

// To its file, and a word of it about every part to those who want many.
void write_report(const ExtractSettings& settings, const Json& report, Terminal& terminal) {
  terminal.clear_progress();
  for (const char* part : {"input", "counts", "seconds", "skeleton", "checks"})
    if (report.contains(part)) terminal.note(std::string(part) + " " + report_text(report[part], -1));
  if (!settings.report.empty()) write_file_atomically(settings.report, report_text(report));
}

// The report says why there is no result, too; an end that was asked for leaves nothing behind.
Extraction extract_or_report(const ExtractSettings& settings, const Cancellation& cancellation,
                             const Stopwatch& total, ProgramSeconds& seconds, Terminal& terminal) {
  try {
    return extract_and_check(settings, cancellation, seconds, terminal);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kCancelled && error.kind() != ErrorKind::kWrite)
      write_report(settings, refusal_report(settings.input, settings.values, error, total.seconds()),
                   terminal);
    throw;
  }
}

// Of what was extracted, where a report is wanted; a failure stands in it as an error.
void report_extraction(const ExtractSettings& settings, const Extraction& extraction,
                       const std::string& failure, ProgramSeconds& seconds, const Stopwatch& total,
                       Terminal& terminal) {
  seconds.total = total.seconds();
  if (!extraction.reported) return;
  Json report = with_costs(extraction.facts, settings.values, extraction.made.result, seconds);
  if (!failure.empty()) report["error"] = error_json(NoSkeletonError(failure));
  write_report(settings, report, terminal);
}

void write_files(const ExtractSettings& settings, const Extraction& extraction, const Stopwatch& total,
                 ProgramSeconds& seconds, Terminal& terminal) {
  const Stopwatch writing;
  const CheckedExtraction& made = extraction.made;
  const CurveSkeleton skeleton = made.input.of_file(made.result.skeleton);
  for (const std::string& output : settings.outputs) {
    if (is_page(output))
      write_viewer_page(output, make_page_scene(settings.input, made, extraction.facts,
                                                extraction.segmentation ? &*extraction.segmentation : nullptr,
                                                extraction.rig ? &*extraction.rig : nullptr));
    else if (is_glb(output))
      write_glb(output, settings, extraction);
    else if (is_rig_text(output))
      write_file_atomically(output, format_rig_text(*extraction.rig));
    else
      write_skeleton(output, skeleton, extraction.reported ? report_text(extraction.facts) : "",
                     settings.root.resolve(made.input.repair.openings));
  }
  if (!settings.segments.empty())
    write_segments(settings.segments, to_polygon_soup(made.result.surface),
                   extraction.segmentation->part_of_face);
  if (!settings.bent.empty()) write_bent(settings, extraction);
  if (!settings.stages.empty()) write_stage_files(settings.stages, made.result);
  seconds.write = writing.seconds();
  report_extraction(settings, extraction, made.failure, seconds, total, terminal);
}

void extract(const ExtractSettings& given, const Cancellation& cancellation, Terminal& terminal) {
  ExtractSettings settings = given;
  settings.run.extract.execution.progress = [&](const char* stage, double fraction) {
    terminal.progress(stage, fraction);
    return !cancellation.requested();
  };
  const Stopwatch total;
  ProgramSeconds seconds;
  check_outputs(settings);
  keep_threads_apart(thread_count(settings.run.extract.execution));
  const Extraction extraction = extract_or_report(settings, cancellation, total, seconds, terminal);
  cancellation.throw_if_requested();
  const std::string& failure = extraction.made.failure;
  show_warnings(extraction.made.result, terminal);
  if (!failure.empty() && !settings.keep_failed) {
    const NoSkeletonError refused(failure + " (--keep-failed writes it all the same)");
    report_extraction(settings, extraction, refused.what(), seconds, total, terminal);
    throw refused;
  }
  write_files(settings, extraction, total, seconds, terminal);
  if (!failure.empty()) throw NoSkeletonError(failure);
}

class ExtractCommand : public Command {
 public:
  explicit ExtractCommand(const std::vector<std::string>& words)
      : Command("IN [OUT...] [options]", kExtractDescription), options_(words, settings_, line()) {}

  int run() override {
    if (settings_.version) {
      std::cout << version_text();
      return 0;
    }
    options_.resolve();
    limit_memory(settings_.max_memory, thread_count(settings_.run.extract.execution));
    const Cancellation cancellation(settings_.run.time_limit);
    Terminal terminal(settings_.verbosity());
    try {
      extract(settings_, cancellation, terminal);
    } catch (const Cancelled&) {
      throw Error(ErrorKind::kCancelled, cancellation.reason());
    }
    return 0;
  }

 private:
  ExtractSettings settings_;
  ExtractOptionTable options_;
};

}  // namespace

std::unique_ptr<Command> make_extract_command(const std::vector<std::string>& words) {
  return std::make_unique<ExtractCommand>(words);
}

}  // namespace mspskel::cli
