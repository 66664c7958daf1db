// mspskel convert SKELETON OUT...: the same skeleton in other formats.
#include <vector>

#include "commands.h"
#include "distinct_files.h"
#include "mspskel/base/error.h"
#include "mspskel/io/read_skeleton.h"
#include "mspskel/io/write_skeleton.h"
#include "root_option.h"
#include "terminal.h"

namespace mspskel::cli {

int convert_command(const std::vector<std::string>& arguments) {
  std::string input;
  std::vector<std::string> outputs;
  bool quiet = false;
  RootOption root;
  CommandLine line("convert SKELETON OUT... [options]", "Writes a skeleton in other formats.");
  line.argument("SKELETON", input, "skeleton (.skel .obj .ply .json)")->required();
  line.arguments(
      "OUT", outputs,
      "skeletons, by extension: .skel .obj .ply .json .swc .vtp .graphml .cgal .polylines.txt; - is "
      ".skel on stdout");
  root.add_to(line);
  line.flag("-q,--quiet", quiet, "no warnings");
  if (!line.parse(arguments)) return 0;
  if (outputs.empty()) throw UsageError("convert takes a skeleton and one or more files to write");
  std::vector<FileRole> written;
  for (const std::string& output : outputs) {
    skeleton_format_of(output);
    written.push_back({output, "an output"});
  }
  refuse_shared_files({{input, "the skeleton"}}, written);
  const RootChoice choice = root.resolve({});
  const CurveSkeleton skeleton = read_skeleton(input);
  Terminal terminal(quiet ? Verbosity::kQuiet : Verbosity::kNormal);
  for (const std::string& output : outputs) {
    for (const std::string& loss : losses_of_format(skeleton, skeleton_format_of(output)))
      terminal.warning(output + ": " + loss);
    write_skeleton(output, skeleton, "", choice);
  }
  return 0;
}

}  // namespace mspskel::cli
