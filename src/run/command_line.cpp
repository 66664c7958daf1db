#include "command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "help_text.h"
#include "mspskel/base/error.h"
#include "mspskel/base/near_name.h"

namespace mspskel::cli {
namespace {

// The shortest text that reads back the same, whole numbers without an exponent.
std::string number_text(double x) {
  char digits[32];
  const bool whole = std::abs(x) < 1e16 && x == std::floor(x);
  const auto end = whole ? std::to_chars(digits, digits + sizeof digits, static_cast<std::int64_t>(x))
                         : std::to_chars(digits, digits + sizeof digits, x);
  return {digits, end.ptr};
}

}  // namespace

std::string range_text(Range range) {
  if (range.high < std::numeric_limits<double>::infinity())
    return number_text(range.low) + " to " + number_text(range.high);
  return "at least " + number_text(range.low);
}

std::string check_range(const std::string& value, Range range) {
  double number = 0;
  const auto parsed = std::from_chars(value.data(), value.data() + value.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr != value.data() + value.size())
    return value + " is not a number";
  if (number >= range.low && number <= range.high) return {};
  return value + " is not in the range " + range_text(range);
}

std::string check_word(const std::string& value, const std::vector<std::string>& words) {
  if (std::find(words.begin(), words.end(), value) != words.end()) return {};
  return value + " is none of " + CLI::detail::join(words, ", ") + did_you_mean(value, words);
}

CommandLine::CommandLine(const std::string& usage, const std::string& description)
    : app_(description), usage_(usage) {
  app_.set_help_flag("-h,--help", "print this help and exit");
  app_.allow_extras();  // answered by refuse_unknown, with a suggestion
}

void CommandLine::short_help(const std::vector<ShortGroup>& groups) {
  app_.set_help_flag("-h,--help", "print the options that most people need and exit");
  app_.set_help_all_flag("--help-all", "print all options and exit");
  for (const ShortGroup& group : groups)
    for (const std::string& name : group.names)
      if (app_.get_option_no_throw("--" + name) == nullptr)
        throw std::logic_error("no option --" + name + " for the short help");
  short_groups_ = groups;
}

CLI::Option* CommandLine::add(CLI::Option* option, const std::string& value, std::function<Json()> value_of) {
  option->group(group_)->option_text(value);
  values_.emplace_back(option->get_lnames().front(), std::move(value_of));
  return option;
}

CLI::Option* CommandLine::argument(const std::string& name, std::string& target, const std::string& help,
                                   const std::vector<std::string>& words) {
  arguments_.push_back({name, help, words});
  return app_.add_option(name, target, help);
}

CLI::Option* CommandLine::arguments(const std::string& name, std::vector<std::string>& target,
                                    const std::string& help) {
  arguments_.push_back({name, help, {}});
  return app_.add_option(name, target, help);
}

void CommandLine::flag(const std::string& names, bool& target, const std::string& help) {
  add(app_.add_flag(names, target, help), "", [&target] { return Json(target); });
}

void CommandLine::text(const std::string& names, std::string& target, const std::string& value,
                       const std::string& help) {
  add(app_.add_option(names, target, help), value, [&target] { return Json(target); });
}

void CommandLine::texts(const std::string& names, std::vector<std::string>& target, const std::string& value,
                        const std::string& help) {
  add(app_.add_option(names, target, help)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll),
      value, [&target] { return Json(target); });
}

void CommandLine::toggle(const std::string& name, bool& target, const std::string& help) {
  CLI::Option* option = app_.add_flag("--" + name + ",!--no-" + name, target, help);
  option->default_str(target ? "on" : "off");
  add(option, "", [&target] { return Json(target); });
}

bool CommandLine::parse(const std::vector<std::string>& arguments) {
  try {
    app_.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    std::cout << help_text(*this);
    return false;
  } catch (const CLI::CallForAllHelp&) {
    std::cout << full_help_text(*this);
    return false;
  } catch (const CLI::ParseError& error) {
    refuse_unknown();
    throw UsageError(error.what());
  }
  refuse_unknown();
  return true;
}

void CommandLine::set_unless_given(const std::string& name, const std::string& value) {
  CLI::Option* option = app_.get_option("--" + name);
  if (option->count() > 0) return;
  option->add_result(value);
  option->run_callback();
}

void CommandLine::refuse_unknown() const {
  std::vector<std::string> unknown = app_.remaining();
  // The mark after which all words are arguments counts as one that is left over.
  const auto mark = std::find(unknown.begin(), unknown.end(), "--");
  const bool is_argument = mark == unknown.begin() || unknown.front().compare(0, 1, "-") != 0;
  if (mark != unknown.end()) unknown.erase(mark);
  if (unknown.empty()) return;
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  if (is_argument) throw UsageError("too many arguments: " + word);
  std::vector<std::string> known;
  for (const CLI::Option* option : app_.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  throw UsageError("unknown option " + word + did_you_mean(word, known));
}

Json CommandLine::values() const {
  Json values = Json::object();
  for (const auto& [name, value_of] : values_) values[name] = value_of();
  return values;
}

OptionEntry CommandLine::entry_of(const CLI::Option& option) const {
  const std::string& name = option.get_lnames().front();
  const std::string spelling = option.get_fnames().empty() ? option.get_name(false, true) : "--[no-]" + name;
  return {name,
          spelling,
          option.get_group(),
          option.get_option_text(),
          option.get_default_str(),
          option.get_description()};
}

std::vector<OptionEntry> CommandLine::entries() const {
  std::vector<OptionEntry> entries;
  for (const auto& listed : values_) entries.push_back(entry_of(*app_.get_option("--" + listed.first)));
  return entries;
}

std::vector<OptionEntry> CommandLine::help_entries() const {
  std::vector<OptionEntry> entries{entry_of(*app_.get_help_ptr())};
  if (!short_groups_.empty()) entries.push_back(entry_of(*app_.get_help_all_ptr()));
  return entries;
}

}  // namespace mspskel::cli
