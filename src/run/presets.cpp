#include "presets.h"

#include <algorithm>

namespace mspskel::cli {
namespace {

std::string as_word(const std::pair<std::string, std::string>& setting) {
  if (setting.second == "false") return "--no-" + setting.first;
  return "--" + setting.first + " " + setting.second;
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all{
      {"general", "anything", {}},
      {"vessels",
       "blood vessels and other branching tubes",
       {{"coarsen", "false"}, {"root", "open"}, {"smoothness", "3"}}},
      {"neurons",
       "nerve cells with thin, far-reaching processes",
       {{"detail", "2"}, {"smallest", "0.001"}, {"smoothness", "3"}}},
      {"plants", "trees and shrubs with thin twigs", {{"detail", "2"}, {"smallest", "0.001"}}},
      {"cad", "machine parts with sharp edges", {{"limb-vertices", "20000"}, {"smallest", "0.03"}}},
      {"characters", "figures with eyes, teeth and clothes of their own", {{"components", "0.1"}}}};
  return all;
}

void PresetOption::add_to(CommandLine& line) {
  std::vector<std::pair<std::string, std::string>> kinds;
  for (const Preset& preset : presets()) kinds.emplace_back(preset.kind, preset.kind);
  line.choice<std::string>("--for", kind, kinds,
                           "settings that suit such models; options that are given come before them");
}

void PresetOption::apply(CommandLine& line) const {
  const auto preset =
      std::find_if(presets().begin(), presets().end(), [this](const Preset& p) { return p.kind == kind; });
  for (const auto& [name, value] : preset->settings)
    if (line.has(name)) line.set_unless_given(name, value);
}

std::string preset_list() {
  std::string text;
  for (const Preset& preset : presets()) {
    std::string words;
    for (const auto& setting : preset.settings) words += (words.empty() ? "" : " ") + as_word(setting);
    text += "  " + preset.kind + std::string(12 - preset.kind.size(), ' ') + preset.models + ": " +
            (words.empty() ? "the defaults" : words) + "\n";
  }
  return text;
}

}  // namespace mspskel::cli
