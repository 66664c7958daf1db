#include "completion.h"

#include <sstream>
#include <vector>

#include "commands.h"
#include "help_text.h"

namespace mspskel::cli {
namespace {

struct Completed {
  const CommandEntry* entry;
  std::unique_ptr<Command> command;
  std::vector<OptionEntry> options;
};

std::vector<Completed> completed_commands() {
  std::vector<Completed> all;
  for (const CommandEntry& entry : commands()) {
    Completed one{&entry, entry.make({}), {}};
    for (const OptionGroup& group : option_groups(one.command->line()))
      one.options.insert(one.options.end(), group.options.begin(), group.options.end());
    all.push_back(std::move(one));
  }
  return all;
}

// -t and --threads; both of --[no-]coarsen.
std::vector<std::string> spellings(const OptionEntry& option) {
  if (option.spelling == "--[no-]" + option.name) return {"--" + option.name, "--no-" + option.name};
  std::vector<std::string> names;
  std::istringstream list(option.spelling);
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

// Of a value such as thickest|tip|point:X,Y,Z those that are words.
std::vector<std::string> value_words(const std::string& value) {
  std::vector<std::string> words;
  std::istringstream list(value);
  for (std::string word; std::getline(list, word, '|');)
    if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos)
      words.push_back(word);
  return words;
}

bool is_file(const OptionEntry& option) { return option.value.rfind("FILE", 0) == 0; }
bool is_folder(const OptionEntry& option) { return option.value == "DIR"; }

std::string join(const std::vector<std::string>& words, const std::string& between = " ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::vector<std::string> all_spellings(const std::vector<OptionEntry>& options) {
  std::vector<std::string> all;
  for (const OptionEntry& option : options)
    for (const std::string& name : spellings(option)) all.push_back(name);
  return all;
}

std::string joined_command_names(const std::string& between = " ") { return join(command_names(), between); }

// In single quotes, for all three shells.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

// What stands after an option of a command, as branches of bash's case.
std::string bash_values(const Completed& one) {
  std::string text, numbers;
  for (const OptionEntry& option : one.options) {
    if (option.value.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : spellings(option)) patterns.push_back(one.entry->name + ":" + name);
    text += "    " + join(patterns, "|") + ") ";
    if (is_file(option))
      text += "kind=file ;;\n";
    else if (is_folder(option))
      text += "kind=folder ;;\n";
    else
      text += "kind=words words=" + quoted(join(value_words(option.value))) + " ;;\n";
  }
  return text;
}

// An option of zsh's _arguments: '(-t --threads)'{-t,--threads}'[help]:N:(words)'.
std::string zsh_option(const OptionEntry& option) {
  std::string help;
  for (const char c : option.help)
    help += c == '[' || c == ']' || c == ':' ? std::string("\\") + c : std::string(1, c);
  std::string action;
  if (is_file(option))
    action = ":file:_files";
  else if (is_folder(option))
    action = ":folder:_files -/";
  else if (!option.value.empty())
    action = ":value:(" + join(value_words(option.value)) + ")";
  const std::vector<std::string> names = spellings(option);
  if (names.size() == 1) return quoted(names.front() + "[" + help + "]" + action);
  return quoted("(" + join(names) + ")") + "{" + join(names, ",") + "}" + quoted("[" + help + "]" + action);
}

std::string zsh_arguments(const Completed& one) {
  std::string text = "_arguments -s -S";
  for (const OptionEntry& option : one.options) text += " \\\n        " + zsh_option(option);
  for (const ArgumentEntry& argument : one.command->line().arguments())
    if (!argument.words.empty())
      text += " \\\n        " + quoted("1:" + argument.name + ":(" + join(argument.words) + ")");
  return text + " \\\n        '*:file:_files'";
}

std::string fish_option(const OptionEntry& option, const std::string& condition) {
  std::string text;
  const std::string help = " -d " + quoted(option.help);
  std::string names, value;
  for (const std::string& name : spellings(option)) {
    if (name.rfind("--", 0) != 0)
      names += " -s " + name.substr(1);
    else if (option.spelling == name || option.spelling.find(',') != std::string::npos)
      names += " -l " + name.substr(2);
    else
      text += "complete -c mspskel -n " + condition + " -l " + name.substr(2) + help + "\n";
  }
  if (is_file(option) || is_folder(option))
    value = " -r";
  else if (!option.value.empty())
    value = " -x -a " + quoted(join(value_words(option.value)));
  return names.empty() ? text : text + "complete -c mspskel -n " + condition + names + value + help + "\n";
}

}  // namespace

std::string bash_completion() {
  std::string options, values, arguments;
  for (const Completed& one : completed_commands()) {
    options +=
        "    " + quoted(one.entry->name) + ") options=" + quoted(join(all_spellings(one.options))) + " ;;\n";
    values += bash_values(one);
    for (const ArgumentEntry& argument : one.command->line().arguments())
      if (!argument.words.empty())
        arguments +=
            "    " + one.entry->name + ":2) kind=words words=" + quoted(join(argument.words)) + " ;;\n";
  }
  return R"(# bash completion for mspskel: mspskel completion bash
_mspskel() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
  local command='' options='' kind='' words=''
  case ${COMP_WORDS[1]} in
    )" + joined_command_names("|") +
         R"() ((COMP_CWORD > 1)) && command=${COMP_WORDS[1]} ;;
  esac
  # --option=value comes as three words.
  if [[ $cur == '=' ]]; then
    cur=''
  elif [[ $prev == '=' ]]; then
    prev=${COMP_WORDS[COMP_CWORD-2]}
  fi
  case $command in
)" + options +
         R"(  esac
  case $command:$prev in
)" + values +
         R"(    *)
      case $command:$COMP_CWORD in
)" + arguments +
         R"(        *) kind=file ;;
      esac
      ((COMP_CWORD == 1)) && words=')" +
         joined_command_names() + R"('
      [[ $cur == -* ]] && kind=words words=$options
      ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
  local IFS=$'\n'
  [[ $kind == file ]] && COMPREPLY+=($(compgen -f -- "$cur"))
  [[ $kind == folder ]] && COMPREPLY+=($(compgen -d -- "$cur"))
  [[ $kind != words ]] && compopt -o filenames 2>/dev/null
  return 0
}
complete -F _mspskel mspskel
)";
}

std::string zsh_completion() {
  std::string names, branches, nameless;
  for (const Completed& one : completed_commands()) {
    if (one.entry->name.empty()) {
      nameless = zsh_arguments(one);
      continue;
    }
    names += "    " + quoted(one.entry->name + ":" + one.entry->summary) + "\n";
    branches += "    " + one.entry->name + ")\n      shift words\n      ((CURRENT--))\n      " +
                zsh_arguments(one) + "\n      ;;\n";
  }
  return "#compdef mspskel\n# zsh completion for mspskel: mspskel completion zsh\n_mspskel() {\n"
         "  local -a commands=(\n" +
         names + "  )\n  ((CURRENT == 2)) && _describe -t commands command commands\n  case $words[2] in\n" +
         branches + "    *)\n      " + nameless + "\n      ;;\n  esac\n}\n_mspskel \"$@\"\n";
}

std::string fish_completion() {
  std::string text = "# fish completion for mspskel: mspskel completion fish\n";
  const std::string names = joined_command_names();
  for (const Completed& one : completed_commands()) {
    const std::string& name = one.entry->name;
    const std::string condition = quoted(name.empty() ? "not __fish_seen_subcommand_from " + names
                                                      : "__fish_seen_subcommand_from " + name);
    if (!name.empty())
      text += "complete -c mspskel -n __fish_use_subcommand -a " + name + " -d " +
              quoted(one.entry->summary) + "\n";
    for (const OptionEntry& option : one.options) text += fish_option(option, condition);
    for (const ArgumentEntry& argument : one.command->line().arguments())
      if (!argument.words.empty())
        text += "complete -c mspskel -n " + condition + " -a " + quoted(join(argument.words)) + "\n";
  }
  return text;
}

}  // namespace mspskel::cli
