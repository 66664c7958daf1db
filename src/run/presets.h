// --for: settings that suit a kind of model.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command_line.h"

namespace mspskel::cli {

// Only what measurably helps on such meshes is set; docs/presets.md has the figures.
struct Preset {
  std::string kind;
  std::string models;                                         // that it is for
  std::vector<std::pair<std::string, std::string>> settings;  // option without dashes, value
};

// "general", which sets nothing, first.
const std::vector<Preset>& presets();

struct PresetOption {
  std::string kind = "general";

  void add_to(CommandLine& line);
  // After parsing: gives the preset's values to those of its options that the line has and that were not
  // given, wherever --for stands among them.
  void apply(CommandLine& line) const;
};

// The presets as lines of help: kind, models, options.
std::string preset_list();

}  // namespace mspskel::cli
