// Options of mending, drawn from the ranges that docs/command_line.md gives, where a run stays short.
#pragma once

#include "fuzz/fuzzed_options.h"
#include "mesh_input.h"

namespace mspskel::fuzz {

// Half of the inputs are repaired as users do who give no options.
inline cli::RepairSettings fuzzed_repair(Choices& choices, std::string& said) {
  cli::RepairSettings settings;
  said += ";";
  // The surface round everything has many faces: most inputs do without.
  if (!choices.one_in(8)) settings.wrap_mode = cli::WrapMode::kNever, said += " --wrap never";
  if (choices.one_in(2)) return settings;
  OptionDraw draw(choices, said);
  draw.pick("--repair", settings.repair, {true, true, false});
  draw.range("--weld", settings.options.weld, 0, 0.01);
  draw.range("--components", settings.options.smallest_component, 0, 1);
  draw.range("touching part", settings.options.touching_part, 0, 1);
  draw.pick("--open", settings.options.open, {OpenEnds::kEnds, OpenEnds::kCap, OpenEnds::kFail});
  draw.pick("--shells", settings.unite, {true, false});
  if (choices.one_in(16)) {
    settings.wrap_mode = cli::WrapMode::kAlways;
    draw.range("--wrap", settings.wrapping.gap, 0.03, 0.2);
  }
  return settings;
}

}  // namespace mspskel::fuzz
