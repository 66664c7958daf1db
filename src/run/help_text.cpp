#include "help_text.h"

#include <algorithm>
#include <sstream>

namespace mspskel::cli {
namespace {

constexpr std::size_t kColumn = 32, kWidth = 100;  // of the explanations; of a line

// `text` in lines of at most `width` letters.
std::vector<std::string> wrap(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

// A name and its explanation, below each other where the name is long.
std::string item(const std::string& name, const std::string& help) {
  std::string result = "  " + name;
  std::size_t begin = result.size();
  if (begin + 2 > kColumn) {
    result += "\n";
    begin = 0;
  }
  for (const std::string& line : wrap(help, kWidth - kColumn)) {
    result += std::string(kColumn - begin, ' ') + line + "\n";
    begin = 0;
  }
  return result;
}

std::string group_text(const OptionGroup& group) {
  std::string text = "\n" + group.heading + ":\n";
  for (const OptionEntry& option : group.options)
    text += item(option.spelling + (option.value.empty() ? "" : " " + option.value),
                 option.help + (option.initial.empty() ? "" : " [" + option.initial + "]"));
  return text;
}

std::string text_of(const CommandLine& line, const std::vector<OptionGroup>& groups, bool brief) {
  std::string text;
  for (const std::string& words : wrap(line.description(), kWidth)) text += words + "\n";
  text += "\nUsage: " + line.usage() + "\n";
  if (!line.arguments().empty()) text += "\nArguments:\n";
  for (const ArgumentEntry& argument : line.arguments()) text += item(argument.name, argument.help);
  for (const OptionGroup& group : groups) text += group_text(group);
  for (const HelpSection& section : line.sections())
    if (section.brief || !brief) text += "\n" + section.heading + ":\n" + section.text;
  return text;
}

std::vector<OptionGroup> short_option_groups(const CommandLine& line) {
  std::vector<OptionEntry> all = line.help_entries();
  for (OptionEntry& option : line.entries()) all.push_back(std::move(option));
  std::vector<OptionGroup> groups;
  for (const ShortGroup& group : line.short_groups()) {
    groups.push_back({group.heading, {}});
    for (const std::string& name : group.names)
      groups.back().options.push_back(*std::find_if(
          all.begin(), all.end(), [&name](const OptionEntry& option) { return option.name == name; }));
  }
  return groups;
}

}  // namespace

std::vector<OptionGroup> option_groups(const CommandLine& line) {
  std::vector<OptionGroup> groups;
  for (OptionEntry& option : line.entries()) {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&option](const OptionGroup& g) { return g.heading == option.group; });
    if (group == groups.end()) group = groups.insert(groups.end(), {option.group, {}});
    group->options.push_back(std::move(option));
  }
  if (groups.empty()) groups.push_back({"Options", {}});
  const std::vector<OptionEntry> help = line.help_entries();
  std::vector<OptionEntry>& first = groups.front().options;
  first.insert(first.begin(), help.begin(), help.end());
  return groups;
}

std::string help_text(const CommandLine& line) {
  const bool brief = !line.short_groups().empty();
  return text_of(line, brief ? short_option_groups(line) : option_groups(line), brief);
}

std::string full_help_text(const CommandLine& line) { return text_of(line, option_groups(line), false); }

}  // namespace mspskel::cli
