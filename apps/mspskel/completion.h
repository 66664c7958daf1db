// Completion for shells, from the tables of the commands.
#pragma once

#include <string>

namespace mspskel::cli {

// Scripts that the shell loads; source: the tables that --help prints.
std::string bash_completion();
std::string zsh_completion();
std::string fish_completion();

}  // namespace mspskel::cli
