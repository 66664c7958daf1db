// mspskel: curve skeletons on the command line.
//
// The first word picks the command here, and not in CLI11, which would take `check a b` for a mesh named
// "check". A file of such a name is reached as ./check.
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "commands.h"
#include "mspskel/base/error.h"
#include "terminal.h"

namespace mspskel::cli {
namespace {

// Threads that spin while they wait for one another take the processor from the one that they wait for
// wherever something else runs. Asleep they cost a little on an idle machine and save a third of the time and
// more on a busy one. OpenMP reads that setting when it is loaded, before main, so the program starts itself
// once more; where that fails it goes on as it is.
void let_waiting_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
  std::error_code failed;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed || setenv("OMP_WAIT_POLICY", "passive", 1) != 0) return;
  execv(self.c_str(), argv);
}

int run(const std::vector<std::string>& words, char** argv) {
  using Command = int (*)(const std::vector<std::string>&);
  const std::pair<const char*, Command> commands[] = {
      {"sample", sample_command}, {"render", render_command}, {"check", check_command}};
  for (const auto& [name, command] : commands) {
    if (!words.empty() && words.front() == name) return command({words.begin() + 1, words.end()});
  }
  if (!words.empty()) let_waiting_threads_sleep(argv);
  return extract_command(words);
}

int run_and_report(const std::vector<std::string>& words, char** argv) {
  try {
    return run(words, argv);
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
  return mspskel::cli::run_and_report(std::vector<std::string>(argv + 1, argv + argc), argv);
}
