// mspskel: curve skeletons on the command line.
//
// The first word picks the command here, and not in CLI11, which would take `check a b` for a mesh named
// "check". A file of such a name is reached as ./check.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "commands.h"
#include "mspskel/base/error.h"
#include "terminal.h"
#include "wait_policy.h"

namespace mspskel::cli {
namespace {

int run(const std::vector<std::string>& words) {
  using Command = int (*)(const std::vector<std::string>&);
  const std::pair<const char*, Command> commands[] = {{"sample", sample_command},
                                                      {"render", render_command},
                                                      {"check", check_command},
                                                      {"convert", convert_command},
                                                      {"info", info_command}};
  for (const auto& [name, command] : commands) {
    if (!words.empty() && words.front() == name) return command({words.begin() + 1, words.end()});
  }
  return extract_command(words);
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
    Terminal().error("not enough memory");
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
