#include "extract_settings.h"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "commands.h"
#include "mspskel/base/error.h"
#include "mspskel/io/write_glb.h"

namespace mspskel::cli {
namespace {

constexpr const char* kDescription =
    "Curve skeleton of a closed triangle mesh by minimum slice perimeter (MSP).";

constexpr const char* kFooter =
    R"(Other commands, each with its own --help:
  mspskel sample NAME [OUT]                closed meshes with known answers
  mspskel render MESH [SKELETON] OUT.png   a picture
  mspskel check MESH SKELETON              verifies a skeleton against its mesh
  mspskel convert SKELETON OUT...          the same skeleton in other formats
  mspskel info FILE                        what a mesh or a skeleton is, in numbers

Exit status: 0 done, 1 usage, 2 cannot read, 3 the mesh is not usable, 4 cannot write,
5 no skeleton, or one whose pieces or cycles are not the mesh's (see --keep-failed),
6 time limit or interrupted.
)";

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

bool parse_extract_settings(const std::vector<std::string>& arguments, ExtractSettings& settings) {
  CommandLine line("IN [OUT...] [options]", kDescription, kFooter);
  RunOptionTable table(arguments, settings.run);
  bool version = false;

  line.argument("IN", settings.input, "mesh (.off .obj .ply .stl), - for stdin");
  line.arguments("OUT", settings.outputs,
                 "skeletons, by extension: .skel .obj .ply .json .swc .vtp .graphml .cgal .polylines.txt; "
                 ".glb is glTF for viewers, with --rig for animation; .rig.txt is RigNet's form of a rig; "
                 ".html is a page to look at; - is .skel on stdout; IN with .skel by default");
  table.add_general(line);
  line.text("--report", settings.report, "FILE", "what was done and found, as JSON; - for stdout");
  line.text("--stages", settings.stages, "DIR", "what lies between the stages: msp.csv and coloured meshes");
  settings.root.add_to(line);
  line.flag("--keep-failed", settings.keep_failed,
            "write the skeleton even if it fails its checks; the exit status is 5 all the same");
  line.flag("-q,--quiet", settings.quiet, "no warnings, no progress");
  line.flag("-v,--verbose", settings.verbose, "a word about every stage");
  line.flag("--version", version, "print the version and the libraries' versions and exit");
  add_repair_options(line, settings.run.repair);
  line.text("--write-mesh", settings.run.repair.write_mesh, "FILE",
            "the surface that the skeleton belongs to (.off .obj .ply)");
  table.add_stages(line);
  add_segment_options(line, settings);
  add_rig_options(line, settings);
  if (!line.parse(arguments)) return false;
  if (version) {
    std::cout << version_text();
    return false;
  }
  if (settings.input.empty()) throw UsageError("which mesh? usage: mspskel IN [OUT...] [options]");
  check_shape_options(line, settings);
  table.resolve(line);
  settings.values = line.values();
  if (settings.root.text.rfind("open:", 0) != 0) settings.root.resolve({});
  if (settings.outputs.empty())
    settings.outputs.push_back(
        settings.input == "-" ? "-"
                              : std::filesystem::path(settings.input).replace_extension(".skel").string());
  return true;
}

}  // namespace mspskel::cli
