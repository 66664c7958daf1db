#include "man_page.h"

#include <cctype>
#include <sstream>

#include "commands.h"
#include "help_text.h"

namespace mspskel::cli {
namespace {

// Text that roff takes as it stands.
std::string escaped(const std::string& text) {
  std::string result;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
    begins = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string option_name(const OptionEntry& option) {
  if (option.spelling == "--[no-]" + option.name)
    return bold("--" + option.name) + ", " + bold("--no-" + option.name);
  std::string text;
  std::istringstream names(option.spelling);
  for (std::string name; std::getline(names, name, ',');) text += (text.empty() ? "" : ", ") + bold(name);
  return text + (option.value.empty() ? "" : " " + italic(option.value));
}

std::string item(const std::string& name, const std::string& help) {
  return ".TP\n" + name + "\n" + escaped(help) + "\n";
}

std::string arguments_and_options(const CommandLine& line, const std::string& heading) {
  std::string text;
  for (const ArgumentEntry& argument : line.arguments()) text += item(italic(argument.name), argument.help);
  for (const OptionGroup& group : option_groups(line)) {
    text += heading + escaped(group.heading) + (heading.back() == '"' ? "\"\n" : "\n");
    for (const OptionEntry& option : group.options)
      text += item(option_name(option),
                   option.help + (option.initial.empty() ? "" : " [" + option.initial + "]"));
  }
  return text;
}

std::string as_it_stands(const std::string& text) { return ".nf\n" + escaped(text) + ".fi\n"; }

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string synopsis(const CommandLine& line) { return escaped(line.usage()) + "\n.br\n"; }

}  // namespace

std::string man_page() {
  const std::unique_ptr<Command> main = commands().front().make({});
  const std::string version = version_text();
  std::string text =
      ".TH MSPSKEL 1 \"\" \"" + version.substr(0, version.find('\n')) + "\" \"User Commands\"\n";
  text += ".SH NAME\nmspskel \\- curve skeletons of closed triangle meshes\n.SH SYNOPSIS\n";
  std::string rest;
  for (const CommandEntry& entry : commands()) {
    const std::unique_ptr<Command> command = entry.make({});
    text += synopsis(command->line());
    if (entry.name.empty()) continue;
    rest += ".SS \"mspskel " + entry.name + "\"\n" + escaped(command->line().description()) + "\n";
    rest += arguments_and_options(command->line(), ".PP\n");
    for (const HelpSection& section : command->line().sections())
      rest += ".PP\n" + escaped(section.heading) + ":\n" + as_it_stands(section.text);
  }
  text += ".SH DESCRIPTION\n" + escaped(main->line().description()) + "\n";
  text += ".SH OPTIONS\n" + arguments_and_options(main->line(), ".SS \"");
  text += ".SH COMMANDS\n" + rest;
  for (const HelpSection& section : main->line().sections())
    text += ".SH \"" + escaped(upper(section.heading)) + "\"\n" + as_it_stands(section.text);
  return text;
}

}  // namespace mspskel::cli
