// What --help and --help-all print of a command line.
#pragma once

#include <string>
#include <vector>

#include "command_line.h"

namespace mspskel::cli {

// Options in the order of their listing, the headings in that of their first options.
struct OptionGroup {
  std::string heading;
  std::vector<OptionEntry> options;
};

// All options, with those that ask for help at the beginning of the first group.
std::vector<OptionGroup> option_groups(const CommandLine& line);

// The options that most people need, where the line names such; else all.
std::string help_text(const CommandLine& line);
std::string full_help_text(const CommandLine& line);

}  // namespace mspskel::cli
