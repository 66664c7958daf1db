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
  std::string name;   // without dashes
  std::string group;  // heading
  std::string value;  // N, FILE, words with bars between them; empty for a switch
  std::string initial;
  std::string help;
};

// One command's options. Errors are UsageErrors; an unknown option is answered with the nearest known one.
class CommandLine {
 public:
  // `usage` is the line of arguments after the program's name.
  CommandLine(const std::string& usage, const std::string& description, const std::string& footer = "");

  CLI::Option* argument(const std::string& name, std::string& target, const std::string& help);
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

  // False if --help was asked for and has been printed to stdout. Throws UsageError.
  bool parse(const std::vector<std::string>& arguments);
  // Whether the option was given.
  bool given(const std::string& name) const { return app_.count(name) > 0; }
  // Values of all options, by name without dashes, in order of their listing.
  Json values() const;
  std::string help() const { return app_.help(); }
  // All options in order of their listing.
  std::vector<OptionEntry> entries() const;

 private:
  CLI::Option* add(CLI::Option* option, const std::string& value, std::function<Json()> value_of);
  void refuse_unknown() const;

  CLI::App app_;
  std::string group_ = "Options";
  std::vector<std::pair<std::string, std::function<Json()>>> values_;
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

// The entry of `known` that is the fewest typing errors away; empty if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace mspskel::cli
