// mspskel sample NAME [OUT]: closed test models with known answers.
#include <cstdio>
#include <iostream>

#include "command_line.h"
#include "commands.h"
#include "mspskel/base/error.h"
#include "mspskel/io/write_mesh.h"
#include "mspskel/samples/samples.h"

namespace mspskel::cli {
namespace {

std::string sample_list() {
  std::string text = "Samples:\n";
  for (const SampleInfo& info : list_samples()) {
    text += "  " + info.name + std::string(info.name.size() < 18 ? 18 - info.name.size() : 1, ' ') +
            info.description + "\n";
    if (!info.count_of.empty()) text += std::string(20, ' ') + "--count: " + info.count_of + "\n";
    if (!info.ratio_of.empty()) text += std::string(20, ' ') + "--ratio: " + info.ratio_of + "\n";
  }
  return text;
}

}  // namespace

int sample_command(const std::vector<std::string>& arguments) {
  std::string name, output;
  SampleOptions options;
  CommandLine line("sample NAME [OUT] [options]", "Makes a closed triangle mesh whose skeleton is known.",
                   sample_list());
  line.argument("NAME", name, "the sample, see below")->required();
  line.argument("OUT", output, "mesh (.off .obj .ply), - for .off on stdout; NAME.off by default");
  line.number("--resolution", options.resolution, {0, 1e8}, "wanted number of vertices; 0: the sample's own");
  line.number("--jitter", options.jitter, {0, 0.3},
              "random displacement of the vertices, in mean edge lengths");
  line.number("--count", options.count, {-1, 1e6}, "what the list below says; -1: the sample's own");
  line.number("--ratio", options.ratio, {0, 1e6}, "what the list below says; 0: the sample's own");
  line.number("--seed", options.seed, kSeedRange, "of the places of the vertices");
  if (!line.parse(arguments)) return 0;
  write_mesh(output.empty() ? name + ".off" : output, make_sample(name, options));
  return 0;
}

}  // namespace mspskel::cli
