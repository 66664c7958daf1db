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

namespace {

class ConvertCommand : public Command {
 public:
  ConvertCommand() : Command("convert SKELETON OUT... [options]", "Writes a skeleton in other formats.") {
    CommandLine& table = line();
    table.argument("SKELETON", input_, "skeleton (.skel .obj .ply .json .swc .cgal .polylines.txt)")
        ->required();
    table.arguments(
        "OUT", outputs_,
        "skeletons, by extension: .skel .obj .ply .json .swc .vtp .graphml .cgal .polylines.txt; - is "
        ".skel on stdout");
    root_.add_to(table);
    table.flag("-q,--quiet", quiet_, "no warnings");
  }

  int run() override {
    if (outputs_.empty()) throw UsageError("convert takes a skeleton and one or more files to write");
    std::vector<FileRole> written;
    for (const std::string& output : outputs_) {
      skeleton_format_of(output);
      written.push_back({output, "an output"});
    }
    refuse_shared_files({{input_, "the skeleton"}}, written);
    const RootChoice choice = root_.resolve({});
    const CurveSkeleton skeleton = read_skeleton(input_);
    Terminal terminal(quiet_ ? Verbosity::kQuiet : Verbosity::kNormal);
    for (const std::string& output : outputs_) {
      for (const std::string& loss : losses_of_format(skeleton, skeleton_format_of(output)))
        terminal.warning(output + ": " + loss);
      write_skeleton(output, skeleton, "", choice);
    }
    return 0;
  }

 private:
  std::string input_;
  std::vector<std::string> outputs_;
  bool quiet_ = false;
  RootOption root_;
};

}  // namespace

std::unique_ptr<Command> make_convert_command(const std::vector<std::string>&) {
  return std::make_unique<ConvertCommand>();
}

}  // namespace mspskel::cli
