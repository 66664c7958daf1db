// mspskel sample NAME [OUT]: closed test models with known answers.
#include "commands.h"
#include "mspskel/io/write_mesh.h"
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
    table.number("--jitter", options_.jitter, {0, 0.3},
                 "random displacement of the vertices, in mean edge lengths");
    table.number("--count", options_.count, {-1, 1e6}, "what the list below says; -1: the sample's own");
    table.number("--ratio", options_.ratio, {0, 1e6}, "what the list below says; 0: the sample's own");
    table.number("--seed", options_.seed, kSeedRange, "of the places of the vertices");
    table.section({"Samples", sample_list()});
  }

  int run() override {
    write_mesh(output_.empty() ? name_ + ".off" : output_, make_sample(name_, options_));
    return 0;
  }

 private:
  std::string name_, output_;
  SampleOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_sample_command(const std::vector<std::string>&) {
  return std::make_unique<SampleCommand>();
}

}  // namespace mspskel::cli
