#include "command_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>

#include "mspskel/base/error.h"

namespace mspskel::cli {
namespace {

// Typing errors between two words: letters left out, put in, mistaken or swapped.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

// The shortest text that reads back the same, whole numbers without an exponent.
std::string number_text(double x) {
  char digits[32];
  const bool whole = std::abs(x) < 1e16 && x == std::floor(x);
  const auto end = whole ? std::to_chars(digits, digits + sizeof digits, static_cast<std::int64_t>(x))
                         : std::to_chars(digits, digits + sizeof digits, x);
  return {digits, end.ptr};
}

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

// Our line of usage, and options as "-t,--threads N   text [default]".
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) {}

  std::string make_usage(const CLI::App*, std::string) const override {
    return "\nUsage: mspskel " + usage_ + "\n";
  }

  std::string make_option(const CLI::Option* option, bool positional) const override {
    constexpr std::size_t kColumn = 32, kWidth = 100;
    std::string name = "  " + option->get_name(positional, true);
    if (!option->get_fnames().empty()) name = "  --[no-]" + option->get_lnames().front();
    if (option->get_option_text() != " " && !option->get_option_text().empty())
      name += " " + option->get_option_text();
    std::string help = option->get_description();
    if (!option->get_default_str().empty()) help += " [" + option->get_default_str() + "]";
    std::string result = std::move(name);
    if (result.size() + 2 > kColumn) result += "\n";
    std::size_t begin = result.back() == '\n' ? 0 : result.size();
    for (const std::string& line : wrap(help, kWidth - kColumn)) {
      result += std::string(kColumn - begin, ' ') + line + "\n";
      begin = 0;
    }
    return result;
  }

 private:
  std::string usage_;
};

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known) {
    // A beginning of a name counts as one error: --sat means --saturation.
    const bool begins = word.size() > 3 && candidate.compare(0, word.size(), word) == 0;
    const std::size_t distance = begins ? 1 : edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

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
  const std::string near = nearest(value, words);
  return value + " is none of " + CLI::detail::join(words, ", ") +
         (near.empty() ? "" : "; did you mean " + near + "?");
}

CommandLine::CommandLine(const std::string& usage, const std::string& description, const std::string& footer)
    : app_(description) {
  app_.formatter(std::make_shared<HelpFormatter>(usage));
  app_.footer(footer);
  app_.set_help_flag("-h,--help", "print this help and exit");
  app_.allow_extras();  // answered by refuse_unknown, with a suggestion
}

CLI::Option* CommandLine::add(CLI::Option* option, const std::string& value, std::function<Json()> value_of) {
  option->group(group_)->option_text(value);
  values_.emplace_back(option->get_lnames().front(), std::move(value_of));
  return option;
}

CLI::Option* CommandLine::argument(const std::string& name, std::string& target, const std::string& help) {
  return app_.add_option(name, target, help)->option_text(" ");
}

CLI::Option* CommandLine::arguments(const std::string& name, std::vector<std::string>& target,
                                    const std::string& help) {
  return app_.add_option(name, target, help)->option_text(" ");
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
    std::cout << app_.help();
    return false;
  } catch (const CLI::ParseError& error) {
    refuse_unknown();
    throw UsageError(error.what());
  }
  refuse_unknown();
  return true;
}

void CommandLine::refuse_unknown() const {
  std::vector<std::string> unknown = app_.remaining();
  // The mark after which all words are arguments counts as one that is left over.
  const auto mark = std::find(unknown.begin(), unknown.end(), "--");
  const bool is_argument = mark == unknown.begin() || unknown.front().front() != '-';
  if (mark != unknown.end()) unknown.erase(mark);
  if (unknown.empty()) return;
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  if (is_argument) throw UsageError("too many arguments: " + word);
  std::vector<std::string> known;
  for (const CLI::Option* option : app_.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  const std::string near = nearest(word, known);
  throw UsageError("unknown option " + word + (near.empty() ? "" : "; did you mean " + near + "?"));
}

Json CommandLine::values() const {
  Json values = Json::object();
  for (const auto& [name, value_of] : values_) values[name] = value_of();
  return values;
}

std::vector<OptionEntry> CommandLine::entries() const {
  std::vector<OptionEntry> entries;
  for (const auto& listed : values_) {
    const CLI::Option* option = app_.get_option("--" + listed.first);
    entries.push_back({listed.first, option->get_group(), option->get_option_text(),
                       option->get_default_str(), option->get_description()});
  }
  return entries;
}

}  // namespace mspskel::cli
