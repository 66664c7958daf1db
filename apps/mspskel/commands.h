// The commands of the program.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "command_line.h"

namespace mspskel::cli {

// What may be asked of it, as a table of arguments and options, and what it does then.
class Command {
 public:
  virtual ~Command() = default;
  // After the table has parsed the words; returns the exit status.
  virtual int run() = 0;

  CommandLine& line() { return line_; }
  const CommandLine& line() const { return line_; }

 protected:
  // `usage` is what follows the program's name.
  Command(const std::string& usage, const std::string& description)
      : line_("mspskel " + usage, description) {}

 private:
  CommandLine line_;
};

struct CommandEntry {
  std::string name;       // empty: what the program does without the name of a command
  std::string arguments;  // as --help lists them
  std::string summary;
  // From the words after the name, which are not parsed yet.
  std::unique_ptr<Command> (*make)(const std::vector<std::string>& words);
};

// The nameless one first.
const std::vector<CommandEntry>& commands();
std::vector<std::string> command_names();

std::unique_ptr<Command> make_extract_command(const std::vector<std::string>& words);
std::unique_ptr<Command> make_sample_command(const std::vector<std::string>& words);
std::unique_ptr<Command> make_render_command(const std::vector<std::string>& words);
std::unique_ptr<Command> make_check_command(const std::vector<std::string>& words);
std::unique_ptr<Command> make_convert_command(const std::vector<std::string>& words);
std::unique_ptr<Command> make_info_command(const std::vector<std::string>& words);
std::unique_ptr<Command> make_completion_command(const std::vector<std::string>& words);
std::unique_ptr<Command> make_man_command(const std::vector<std::string>& words);

// The version of the program and of the libraries that it was built with.
std::string version_text();

}  // namespace mspskel::cli
