// mspskel sample NAME [OUT]: closed test models with known answers.
#include "commands.h"
#include "distinct_files.h"
#include "mspskel/io/write_mesh.h"
#include "mspskel/io/write_skeleton.h"
#include "mspskel/samples/samples.h"

namespace mspskel::cli {
namespace {

std::string sample_list() {
  std::string text;
  for (const SampleInfo& info : list_samples()) {
    text += "  " + info.name + std::string(info.name.size() < 18 ? 18 - info.name.size() : 1, ' ') +
            info.description + "\n";
    if (!info.count_of.empty()) text += std::string(20, ' ') + "--count: " + info.count_of + "\n";
    if (!info.ratio_of.empty()) text += std::string(20, ' ') + "--ratio: " + info.ratio_of + "\n";
    if (info.has_sides) text += std::string(20, ' ') + "--side-x, --side-y, --side-z: its lengths\n";
    if (info.has_sections) text += std::string(20, ' ') + "--section: of its bars\n";
    if (!info.has_truth) text += std::string(20, ' ') + "no --truth: its skeleton is a matter of taste\n";
  }
  return text;
}

std::vector<std::string> sample_names() {
  std::vector<std::string> names;
  for (const SampleInfo& info : list_samples()) names.push_back(info.name);
  return names;
}

class SampleCommand : public Command {
 public:
  SampleCommand()
      : Command("sample NAME [OUT] [options]", "Makes a closed triangle mesh whose skeleton is known.") {
    CommandLine& table = line();
    table.argument("NAME", name_, "the sample, see below", sample_names())->required();
    table.argument("OUT", output_, "mesh (.off .obj .ply), - for .off on stdout; NAME.off by default");
    table.number("--resolution", options_.resolution, {0, 1e8},
                 "wanted number of vertices; 0: the sample's own");
    table.flag("--sparse", options_.sparse,
               "long triangles where the surface is flat or bent one way; few vertices stay");
    table.number("--jitter", options_.jitter, {0, 0.3},
                 "random displacement of the vertices, in mean edge lengths");
    table.number("--count", options_.count, {-1, 1e6}, "what the list below says; -1: the sample's own");
    table.number("--ratio", options_.ratio, {0, 1e6}, "what the list below says; 0: the sample's own");
    for (Eigen::Index k = 0; k < 3; ++k)
      table.number(std::string("--side-") + "xyz"[k], options_.sides[k], {0, 1e6},
                   "of a box or ellipsoid; 0: the sample's own");
    table.choice("--section", options_.section,
                 {{"own", Section::kOwn}, {"square", Section::kSquare}, {"round", Section::kRound}},
                 "of the bars, where the list below says so");
    table.text("--truth", truth_, "FILE",
               "the skeleton that the sample is made round (.skel .obj .ply .json .swc .vtp .graphml .cgal "
               ".polylines.txt)");
    table.number("--seed", options_.seed, kSeedRange, "of the places of the vertices");
    table.section({"Samples", sample_list()});
  }

  int run() override {
    const std::string output = output_.empty() ? name_ + ".off" : output_;
    refuse_shared_files({}, {{output, "the mesh"}, {truth_, "the skeleton"}});
    CurveSkeleton truth;
    if (!truth_.empty()) {
      skeleton_format_of(truth_);
      truth = sample_truth(name_, options_);
    }
    write_mesh(output, make_sample(name_, options_));
    if (!truth_.empty()) write_skeleton(truth_, truth);
    return 0;
  }

 private:
  std::string name_, output_, truth_;
  SampleOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_sample_command(const std::vector<std::string>&) {
  return std::make_unique<SampleCommand>();
}

}  // namespace mspskel::cli
