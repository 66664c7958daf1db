// mspskel: curve skeletons on the command line.
//
// The first word picks the command here, and not in CLI11, which would take `check a b` for a mesh named
// "check". A file of such a name is reached as ./check.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "commands.h"
#include "memory_limit.h"
#include "mspskel/base/error.h"
#include "mspskel/base/near_name.h"
#include "terminal.h"
#include "wait_policy.h"

namespace mspskel::cli {
namespace {

// A first word that names no command is a mesh; one that names no file either may be a mistyped command.
void refuse_mistyped_command(const std::string& word) {
  std::error_code ignored;
  if (word.find_first_of("./") != std::string::npos || word.front() == '-' ||
      std::filesystem::exists(word, ignored))
    return;
  const std::string near = did_you_mean(word, command_names());
  if (!near.empty()) throw UsageError(word + " is neither a command nor a file" + near);
}

int run(const std::vector<std::string>& words) {
  const std::string first = words.empty() ? "" : words.front();
  const auto chosen = std::find_if(commands().begin(), commands().end(),
                                   [&first](const CommandEntry& c) { return c.name == first; });
  const bool named = !first.empty() && chosen != commands().end();
  if (!first.empty() && !named) refuse_mistyped_command(first);
  const std::vector<std::string> rest(words.begin() + (named ? 1 : 0), words.end());
  const std::unique_ptr<Command> command = (named ? *chosen : commands().front()).make(rest);
  return command->line().parse(rest) ? command->run() : 0;
}

// What is left in the buffers, too: a full disk shows when they are emptied.
void finish_standard_output() {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw WriteError(std::string("cannot write standard output: ") + std::strerror(errno != 0 ? errno : EIO));
}

int run_and_report(const std::vector<std::string>& words) {
  try {
    const int status = run(words);
    finish_standard_output();
    return status;
  } catch (const Error& error) {
    Terminal().error(error.what());
    return static_cast<int>(error.kind());
  } catch (const std::bad_alloc&) {
    Terminal().error(out_of_memory_text());
    if (memory_is_limited()) return static_cast<int>(ErrorKind::kCancelled);
  } catch (const std::exception& error) {
    Terminal().error(error.what());
  }
  return static_cast<int>(ErrorKind::kNoSkeleton);
}

}  // namespace
}  // namespace mspskel::cli

int main(int argc, char** argv) {
  mspskel::cli::let_waiting_threads_sleep();
  return mspskel::cli::run_and_report(std::vector<std::string>(argv + 1, argv + argc));
}
