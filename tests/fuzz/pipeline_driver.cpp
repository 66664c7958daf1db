// The fuzz targets without a fuzzer: one input a seed, in a child process, so that a crash is a
// finding and not the end. Prints executions and findings, each with its seed; exit status 1 if there are
// any.
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <new>

#include "fuzz/trial.h"
#include "mspskel/io/write_mesh.h"

using namespace mspskel;
using namespace mspskel::fuzz;

namespace {

struct Settings {
  std::uint64_t seed = 1, runs = 0;
  double seconds = 0;
  int longest = 180;   // processor seconds of an input
  double most = 3072;  // megabytes
  bool soups = false;
  std::string write;
};

// What the child tells its parent, also if it dies.
struct Shared {
  std::atomic<std::uint64_t> seed{0}, done{0}, broken{0};
  std::atomic<std::uint64_t> outcomes[std::size(kOutcomeNames)]{};
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool goes_on(const Settings& settings, const Shared& shared, Clock::time_point start) {
  return (settings.runs == 0 || shared.done < settings.runs) &&
         (settings.seconds == 0 || seconds_since(start) < settings.seconds);
}

// Processor time: a busy machine makes no finding.
void limit_processor_time(int seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &timer, nullptr);
}

// Megabytes that the process has had at most.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void report(std::uint64_t seed, const std::string& what, const std::string& made) {
  std::printf("finding: seed %llu: %s | %s\n", static_cast<unsigned long long>(seed), what.c_str(),
              made.c_str());
  std::fflush(stdout);
}

void run_seed(const Settings& settings, Shared& shared) {
  const std::uint64_t seed = shared.seed;
  Choices choices(seed);
  const Trial trial = make_trial(settings.soups, choices);
  limit_processor_time(settings.longest);
  try {
    ++shared.outcomes[static_cast<std::size_t>(trial.check(choices))];
    hold(peak_memory() <= settings.most, "memory is bounded");
  } catch (const std::exception& broken) {
    ++shared.broken;
    report(seed, broken.what(), trial.mesh.made);
  }
  limit_processor_time(0);
}

// Runs seeds until the time is over, or one of them kills the process or leaves it too large for the next.
[[noreturn]] void work(const Settings& settings, Shared& shared, Clock::time_point start) {
  while (goes_on(settings, shared, start) && peak_memory() <= settings.most) {
    run_seed(settings, shared);
    ++shared.done;
    ++shared.seed;
  }
  std::fflush(stdout);
  _exit(0);
}

void await(pid_t child, const Settings& settings, Shared& shared) {
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  Choices choices(shared.seed);
  const std::string what = !WIFSIGNALED(status)          ? "a sanitizer's report"
                           : WTERMSIG(status) == SIGPROF ? "no end"
                                                         : strsignal(WTERMSIG(status));
  ++shared.broken;
  report(shared.seed, what, make_trial(settings.soups, choices).mesh.made);
  ++shared.done;
  ++shared.seed;
}

int run(const Settings& settings) {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  Shared& shared = *new (memory) Shared;
  shared.seed = settings.seed;
  const Clock::time_point start = Clock::now();
  while (goes_on(settings, shared, start)) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process for the inputs");
    if (child == 0) work(settings, shared, start);
    await(child, settings, shared);
  }
  const auto count = [](const std::atomic<std::uint64_t>& n) { return static_cast<unsigned long long>(n); };
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  std::printf("%llu executions in %.0f s, %ld of the processor, from seed %llu:", count(shared.done),
              seconds_since(start), static_cast<long>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec),
              static_cast<unsigned long long>(settings.seed));
  for (std::size_t i = 0; i < std::size(kOutcomeNames); ++i)
    if (shared.outcomes[i] > 0) std::printf(" %llu %s,", count(shared.outcomes[i]), kOutcomeNames[i]);
  std::printf(" %llu findings\n", count(shared.broken));
  return shared.broken == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Runs the whole pipeline on made-up meshes and options and checks its laws.");
  app.add_flag("--soups", settings.soups, "soups that are to be mended, not closed meshes");
  app.add_option("--seed", settings.seed, "the first input's")->capture_default_str();
  app.add_option("--runs", settings.runs, "at most so many inputs; 0: no limit")->capture_default_str();
  app.add_option("--seconds", settings.seconds, "stop after so many seconds; 0: never")
      ->capture_default_str();
  app.add_option("--longest", settings.longest, "processor seconds of one input")->capture_default_str();
  app.add_option("--memory", settings.most, "megabytes of one input")->capture_default_str();
  app.add_option("--write", settings.write, "only write the mesh of --seed to this file and say its options");
  CLI11_PARSE(app, argc, argv);
  if (settings.write.empty()) return run(settings);
  Choices choices(settings.seed);
  const Trial trial = make_trial(settings.soups, choices);
  std::printf("%s\n", trial.mesh.made.c_str());
  try {
    write_mesh(settings.write, trial.mesh.soup);
  } catch (const Error& error) {  // of coordinates that no file may have
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.kind());
  }
  return 0;
}
