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
#include "mspskel/repair/separate_points.h"
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
  refuse_write_protected(path.string());
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
  if (!settings.bent.empty()) written_mesh_format_of(settings.bent);
  if (!settings.surface.empty()) written_mesh_format_of(settings.surface);
  written.push_back({settings.segments, "the file of the parts"});
  written.push_back({settings.bent, "the bent surface"});
  written.push_back({settings.surface, "the mended mesh"});
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
  if (!settings.surface.empty()) check_writable(settings.surface);
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
  std::string surface;    // the bytes of its file, if there is to be one
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
  extraction.rig =
      make_rig(result.surface, result.skeleton, settings.rigging, settings.run.extract.execution.progress);
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
  estimate.expect_components(faces, options);
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

void format_surface(const ExtractSettings& settings, const MeshInput& input, Extraction& extraction) {
  if (!settings.surface.empty())
    extraction.surface = format_mesh(separate_points(to_polygon_soup(input.built.mesh)),
                                     written_mesh_format_of(settings.surface));
}

// Of a mesh that carries no skeleton the surface is kept in `extraction`, too.
void extract_and_check(const ExtractSettings& settings, const Cancellation& cancellation,
                       ProgramSeconds& seconds, Terminal& terminal, Extraction& extraction) {
  const Stopwatch reading;
  const PolygonSoup soup = read_polygon_soup(settings.input);
  MeshInput input = prepare_mesh(soup, settings.run.repair, settings.run.extract.execution);
  format_surface(settings, input, extraction);
  const bool was_wrapped = input.wrapped.has_value();
  seconds.read = reading.seconds();
  settings.root.resolve(input.repair.openings);  // what is wrong with it shows before the work
  cancellation.throw_if_requested();
  if (!settings.quiet) expect(terminal.estimate(), input, settings.run.extract);
  extraction.reported = !settings.report.empty() || settings.verbose || writes_report(settings);
  extraction.made =
      extract_checked(soup, std::move(input), settings.run,
                      extraction.reported ? CertificateDepth::kFull : CertificateDepth::kVerdict);
  if (extraction.made.input.wrapped && !was_wrapped)
    format_surface(settings, extraction.made.input, extraction);
  add_losses(settings, extraction.made.result);
  add_renumbered(settings, extraction.made);
  if (needs_parts(settings, extraction.made.result)) segment(settings, extraction);
  if (settings.needs_rig()) add_rig(settings, extraction);
  if (extraction.reported) extraction.facts = facts_of(settings.input, extraction.made);
}

std::string glb_of(const ExtractSettings& settings, const Extraction& extraction) {
  const ExtractResult& result = extraction.made.result;
  const GlbScene scene{
      settings.input == "-" ? "standard input" : fs::path(settings.input).filename().string(),
      to_polygon_soup(result.surface), result.skeleton};
  return settings.rig ? format_rigged_glb(scene, *extraction.rig, extraction.pose) : format_glb(scene);
}

std::string bent_surface(const ExtractSettings& settings, const Extraction& extraction) {
  PolygonSoup surface = to_polygon_soup(extraction.made.result.surface);
  surface.points = bend(*extraction.rig, surface.points, extraction.pose);
  return format_mesh(surface, written_mesh_format_of(settings.bent));
}

// To its file, and a word of it about every part to those who want many.
void add_report(const ExtractSettings& settings, const Json& report, Terminal& terminal, OutputFiles& files) {
  terminal.clear_progress();
  for (const char* part : {"input", "counts", "seconds", "skeleton", "checks"})
    if (report.contains(part)) terminal.note(std::string(part) + " " + report_text(report[part], -1));
  if (!settings.report.empty()) files.add(settings.report, report_text(report));
}

void add_surface(const ExtractSettings& settings, Extraction& extraction, OutputFiles& files) {
  if (!extraction.surface.empty()) files.add(settings.surface, std::move(extraction.surface));
}

// Surface and report say why there is no result, too; an end that was asked for leaves nothing behind.
Extraction extract_or_report(const ExtractSettings& settings, const Cancellation& cancellation,
                             const Stopwatch& total, ProgramSeconds& seconds, Terminal& terminal,
                             OutputFiles& files) {
  Extraction extraction;
  try {
    extract_and_check(settings, cancellation, seconds, terminal, extraction);
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kCancelled) throw;
    add_surface(settings, extraction, files);
    add_report(settings, refusal_report(settings.input, settings.values, error, total.seconds()), terminal,
               files);
    files.commit();
    throw;
  }
  return extraction;
}

// Of what was extracted, where a report is wanted; a failure stands in it as an error.
void report_extraction(const ExtractSettings& settings, const Extraction& extraction,
                       const std::string& failure, ProgramSeconds& seconds, const Stopwatch& total,
                       Terminal& terminal, OutputFiles& files) {
  seconds.total = total.seconds();
  if (!extraction.reported) return;
  Json report = with_costs(extraction.facts, settings.values, extraction.made.result, seconds);
  if (!failure.empty()) report["error"] = error_json(NoSkeletonError(failure));
  add_report(settings, report, terminal, files);
}

std::string bytes_of(const std::string& output, const ExtractSettings& settings,
                     const Extraction& extraction) {
  if (is_glb(output)) return glb_of(settings, extraction);
  if (is_rig_text(output)) return format_rig_text(*extraction.rig);
  const CheckedExtraction& made = extraction.made;
  if (is_page(output))
    return format_viewer_page(make_page_scene(
        settings.input, made, extraction.facts, extraction.segmentation ? &*extraction.segmentation : nullptr,
        extraction.rig ? &*extraction.rig : nullptr, settings.run.extract.execution));
  return format_skeleton(made.input.of_file(made.result.skeleton), skeleton_format_of(output),
                         extraction.reported ? report_text(extraction.facts) : "",
                         settings.root.resolve(made.input.repair.openings));
}

void write_files(const ExtractSettings& settings, Extraction& extraction, const Stopwatch& total,
                 ProgramSeconds& seconds, Terminal& terminal, OutputFiles& files) {
  const Stopwatch writing;
  const ExtractResult& result = extraction.made.result;
  for (const std::string& output : settings.outputs)
    files.add(output, bytes_of(output, settings, extraction));
  if (!settings.segments.empty())
    files.add(settings.segments,
              format_segments(to_polygon_soup(result.surface), extraction.segmentation->part_of_face,
                              segment_format_of(settings.segments)));
  if (!settings.bent.empty()) files.add(settings.bent, bent_surface(settings, extraction));
  if (!settings.stages.empty()) add_stage_files(settings.stages, result, files);
  add_surface(settings, extraction, files);
  seconds.write = writing.seconds();
  report_extraction(settings, extraction, extraction.made.failure, seconds, total, terminal, files);
  files.commit();
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
  OutputFiles files([&](const char*, double) { return !cancellation.requested(); });
  Extraction extraction = extract_or_report(settings, cancellation, total, seconds, terminal, files);
  cancellation.throw_if_requested();
  const std::string failure = extraction.made.failure;
  show_warnings(extraction.made.result, terminal);
  if (!failure.empty() && !settings.keep_failed) {
    const NoSkeletonError refused(failure + " (--keep-failed writes it all the same)");
    add_surface(settings, extraction, files);
    report_extraction(settings, extraction, refused.what(), seconds, total, terminal, files);
    files.commit();
    throw refused;
  }
  write_files(settings, extraction, total, seconds, terminal, files);
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
