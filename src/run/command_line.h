// A thin layer over CLI11: ranges and units in one table that serves parsing, --help and the report.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mspskel::cli {

using Json = nlohmann::ordered_json;

// Both ends belong to it.
struct Range {
  double low;
  double high;
};

// What --help says of an option.
struct OptionEntry {
  std::string name;      // without dashes
  std::string spelling;  // -t,--threads; --[no-]coarsen
  std::string group;     // heading
  std::string value;     // N, FILE, words with bars between them; empty for a switch
  std::string initial;
  std::string help;
};

// What --help says of an argument that has a place, not a name.
struct ArgumentEntry {
  std::string name;
  std::string help;
  std::vector<std::string> words;  // that it may be; empty: a file
};

// Lines that stand below the options under a heading of their own.
struct HelpSection {
  std::string heading;
  std::string text;   // every line ends in a newline
  bool brief = true;  // also in a short help
};

// Names of options, without dashes, that stand together in a short help.
struct ShortGroup {
  std::string heading;
  std::vector<std::string> names;
};

// One command's options. Errors are UsageErrors; an unknown option is answered with the nearest known one.
class CommandLine {
 public:
  // `usage` is the whole line, with the program's name.
  CommandLine(const std::string& usage, const std::string& description);
  CommandLine(const CommandLine&) = delete;  // options refer to it
  CommandLine& operator=(const CommandLine&) = delete;

  // `words`: what it may be, for completion; empty for a file.
  CLI::Option* argument(const std::string& name, std::string& target, const std::string& help,
                        const std::vector<std::string>& words = {});
  CLI::Option* arguments(const std::string& name, std::vector<std::string>& target, const std::string& help);

  // The options that follow are listed under this heading.
  void group(const std::string& heading) { group_ = heading; }
  void flag(const std::string& names, bool& target, const std::string& help);
  // May be given several times, each with one value.
  void texts(const std::string& names, std::vector<std::string>& target, const std::string& value,
             const std::string& help);
  void text(const std::string& names, std::string& target, const std::string& value, const std::string& help);
  // --name and --no-name.
  void toggle(const std::string& name, bool& target, const std::string& help);
  // One of several words; `target` says which is the default.
  template <class Value>
  void choice(const std::string& names, Value& target,
              const std::vector<std::pair<std::string, Value>>& choices, const std::string& help);

  // `help` states meaning and unit; the range is added to it.
  template <class Number>
  void number(const std::string& names, Number& target, Range range, const std::string& help);

  void section(HelpSection section) { sections_.push_back(std::move(section)); }
  // --help is to show these options only, and --help-all is to show all. After all options are listed; throws
  // std::logic_error for a name that is none.
  void short_help(const std::vector<ShortGroup>& groups);

  // False if help was asked for and has been printed to stdout. Throws UsageError.
  bool parse(const std::vector<std::string>& arguments);
  // Whether there is such an option, its name without dashes.
  bool has(const std::string& name) const { return app_.get_option_no_throw("--" + name) != nullptr; }
  // After parsing: gives a value to an option that has none from the words that were parsed.
  void set_unless_given(const std::string& name, const std::string& value);
  // Whether the option was given.
  bool given(const std::string& name) const { return app_.count(name) > 0; }
  // Values of all options, by name without dashes, in order of their listing.
  Json values() const;
  // All options that have values, in order of their listing.
  std::vector<OptionEntry> entries() const;
  // Those that ask for help, which stand in the first group.
  std::vector<OptionEntry> help_entries() const;
  const std::vector<ArgumentEntry>& arguments() const { return arguments_; }
  const std::vector<HelpSection>& sections() const { return sections_; }
  const std::vector<ShortGroup>& short_groups() const { return short_groups_; }
  const std::string& usage() const { return usage_; }
  std::string description() const { return app_.get_description(); }

 private:
  CLI::Option* add(CLI::Option* option, const std::string& value, std::function<Json()> value_of);
  OptionEntry entry_of(const CLI::Option& option) const;
  void refuse_unknown() const;

  CLI::App app_;
  std::string usage_;
  std::string group_ = "Options";
  std::vector<std::pair<std::string, std::function<Json()>>> values_;
  std::vector<ArgumentEntry> arguments_;
  std::vector<HelpSection> sections_;
  std::vector<ShortGroup> short_groups_;
};

// Seeds are exact in JSON and in doubles.
inline constexpr Range kSeedRange{0, 9007199254740992.0};

std::string range_text(Range range);
// Empty, or what is wrong with the value.
std::string check_range(const std::string& value, Range range);
std::string check_word(const std::string& value, const std::vector<std::string>& words);

template <class Number>
void CommandLine::number(const std::string& names, Number& target, Range range, const std::string& help) {
  CLI::Option* option = app_.add_option(names, target, help + "; " + range_text(range));
  option->capture_default_str();
  option->check(CLI::Validator([range](std::string& value) { return check_range(value, range); }, ""));
  add(option, "N", [&target] { return Json(target); });
}

template <class Value>
void CommandLine::choice(const std::string& names, Value& target,
                         const std::vector<std::pair<std::string, Value>>& choices, const std::string& help) {
  const auto word_of = [choices, &target] {
    for (const auto& [word, value] : choices)
      if (value == target) return word;
    return std::string();
  };
  CLI::Option* option = app_.add_option_function<std::string>(
      names,
      [choices, &target](const std::string& given) {
        for (const auto& [word, value] : choices)
          if (word == given) target = value;
      },
      help);
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back(word);
  option->check(CLI::Validator([words](std::string& value) { return check_word(value, words); }, ""));
  option->default_str(word_of());
  add(option, CLI::detail::join(words, "|"), [word_of] { return Json(word_of()); });
}

}  // namespace mspskel::cli
