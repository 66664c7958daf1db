#include "extract_settings.h"

#include <algorithm>
#include <filesystem>

#include "commands.h"
#include "mspskel/base/error.h"
#include "mspskel/io/write_glb.h"

namespace mspskel::cli {
namespace {

constexpr const char* kExamples =
    R"(  mspskel hand.off hand.html                    a page to look at, pick and measure
  mspskel hand.off hand.skel hand.swc           skeletons for other programs
  mspskel cell.ply cell.swc --for neurons       settings that suit a kind of model
)";

constexpr const char* kExitStatus =
    R"(  0 done, 1 usage, 2 cannot read, 3 the mesh is not usable, 4 cannot write,
  5 no skeleton, or one whose pieces or cycles are not the mesh's or that lies
    outside it (see --keep-failed, --least-inside),
  6 time or memory limit, or interrupted: all files are as they were.
)";

std::string command_list() {
  std::string text;
  for (const CommandEntry& command : commands()) {
    if (command.name.empty()) continue;
    const std::string words = "  mspskel " + command.name + " " + command.arguments;
    text +=
        words + std::string(words.size() < 42 ? 42 - words.size() : 1, ' ') + " " + command.summary + "\n";
  }
  return text;
}

void add_segment_options(CommandLine& line, ExtractSettings& settings) {
  line.group("Parts");
  line.text("--segments", settings.segments, "FILE",
            "the parts of the surface: .seg has the number of each face's part, .ply the coloured surface");
  line.number("--parts", settings.segmentation.parts.count, {0, 1e9},
              "how many parts, as far as the skeleton has places to cut; 0: as many as the shape asks for");
}

void add_rig_options(CommandLine& line, ExtractSettings& settings) {
  line.group("Rig, for animation; .rig.txt files always have one");
  line.flag("--rig", settings.rig, "OUT.glb is a skinned mesh with joints");
  line.number("--joints", settings.rigging.joints, {0, 65535},
              "how many joints, as far as the skeleton has nodes; 0: as many as the shape asks for");
  line.texts("--pose", settings.poses, "JOINT=AXIS,ANGLE",
             "turn a joint by so many degrees; the axis is x, y, z or three numbers; may be repeated");
  line.text("--bent", settings.bent, "FILE", "the surface in the pose (.off .obj .ply)");
}

void check_shape_options(const CommandLine& line, const ExtractSettings& settings) {
  if (line.given("--parts") && settings.segments.empty())
    throw UsageError("--parts says how many parts --segments FILE is to have, which is missing");
  for (const char* option : {"--joints", "--pose"})
    if (line.given(option) && !settings.needs_rig())
      throw UsageError(std::string(option) +
                       " is about a rig: add --rig and an OUT.glb, an OUT.rig.txt or --bent FILE");
  if (settings.rig && std::none_of(settings.outputs.begin(), settings.outputs.end(), is_glb))
    throw UsageError("--rig puts joints into a .glb file: name an OUT.glb");
}

}  // namespace

bool ExtractSettings::needs_rig() const {
  return rig || !bent.empty() || std::any_of(outputs.begin(), outputs.end(), is_rig_text);
}

ExtractOptionTable::ExtractOptionTable(const std::vector<std::string>& words, ExtractSettings& settings,
                                       CommandLine& line)
    : settings_(settings), line_(line), run_(words, settings.run) {
  add_options();
  add_help();
}

void ExtractOptionTable::add_options() {
  line_.argument("IN", settings_.input, "mesh (.off .obj .ply .stl .vtk .vtp .gltf .glb .3mf), - for stdin");
  line_.arguments("OUT", settings_.outputs,
                  "skeletons, by extension: .skel .obj .ply .json .swc .vtp .graphml .cgal .polylines.txt; "
                  ".glb is glTF for viewers, with --rig for animation; .rig.txt is RigNet's form of a rig; "
                  ".html is a page to look at; - is .skel on stdout; IN with .skel by default");
  run_.add_general(line_);
  line_.number("--max-memory", settings_.max_memory, {0, 1e9},
               "megabytes that the program may take; 0: no limit");
  line_.text("--report", settings_.report, "FILE", "what was done and found, as JSON; - for stdout");
  line_.text("--stages", settings_.stages, "DIR",
             "what lies between the stages: msp.csv and coloured meshes");
  settings_.root.add_to(line_);
  line_.flag("--keep-failed", settings_.keep_failed,
             "write the skeleton even if it fails its checks; the exit status is 5 all the same");
  line_.flag("-q,--quiet", settings_.quiet, "no warnings, no progress");
  line_.flag("-v,--verbose", settings_.verbose, "a word about every stage");
  line_.flag("--version", settings_.version, "print the version and the libraries' versions and exit");
  add_repair_options(line_, settings_.run.repair);
  line_.text("--write-mesh", settings_.surface, "FILE",
             "the surface that the skeleton belongs to (.off .obj .ply)");
  run_.add_stages(line_);
  add_segment_options(line_, settings_);
  add_rig_options(line_, settings_);
}

void ExtractOptionTable::add_help() {
  line_.section({"Examples", kExamples});
  line_.section({"What --for sets, where no option says otherwise", preset_list(), false});
  line_.section({"Other commands, each with its own --help", command_list()});
  line_.section({"Exit status", kExitStatus});
  line_.short_help({{"Mesh", {"open", "components"}},
                    {"Skeleton", {"for", "smallest", "step"}},
                    {"Files", {"root", "report", "segments", "rig"}},
                    {"Run", {"threads", "time-limit", "quiet"}},
                    {"Help", {"help", "help-all", "version"}}});
}

void ExtractOptionTable::resolve() {
  if (settings_.input.empty()) throw UsageError("which mesh? usage: mspskel IN [OUT...] [options]");
  check_shape_options(line_, settings_);
  run_.resolve(line_);
  settings_.values = line_.values();
  if (settings_.root.text.rfind("open:", 0) != 0) settings_.root.resolve({});
  if (settings_.outputs.empty())
    settings_.outputs.push_back(
        settings_.input == "-" ? "-"
                               : std::filesystem::path(settings_.input).replace_extension(".skel").string());
}

}  // namespace mspskel::cli
