#include "commands.h"

namespace mspskel::cli {

const std::vector<CommandEntry>& commands() {
  static const std::vector<CommandEntry> all{
      {"", "IN [OUT...]", "skeletons of a mesh", make_extract_command},
      {"sample", "NAME [OUT]", "closed meshes with known answers", make_sample_command},
      {"render", "MESH [SKELETON] OUT.png", "a picture", make_render_command},
      {"check", "MESH SKELETON", "verifies a skeleton against its mesh", make_check_command},
      {"convert", "SKELETON OUT...", "the same skeleton in other formats", make_convert_command},
      {"info", "FILE", "what a mesh or a skeleton is, in numbers", make_info_command},
      {"completion", "bash|zsh|fish", "a script for a shell", make_completion_command},
      {"man", "", "the manual page", make_man_command}};
  return all;
}

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const CommandEntry& entry : commands())
    if (!entry.name.empty()) names.push_back(entry.name);
  return names;
}

}  // namespace mspskel::cli
