#include "memory_limit.h"

#include <sys/resource.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "mspskel/base/error.h"

namespace mspskel::cli {
namespace {

double limit = 0;  // megabytes

// What RLIMIT_DATA counts: private, writable memory.
double megabytes_in_use() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmData:", 0) == 0) return std::atof(line.c_str() + 7) * 1024e-6;
  return 0;
}

std::string megabytes_text(double megabytes) { return std::to_string(static_cast<long>(megabytes)) + " MB"; }

}  // namespace

void limit_memory(double megabytes, int threads) {
  if (megabytes == 0) return;
  std::atomic<int> started{0};
#pragma omp parallel num_threads(threads)
  ++started;
  if (const double used = megabytes_in_use(); used >= megabytes)
    throw UsageError("--max-memory: the program alone takes " + megabytes_text(used + 1));
  rlimit bound{};
  getrlimit(RLIMIT_DATA, &bound);
  bound.rlim_cur = static_cast<rlim_t>(megabytes * 1e6);
  if (bound.rlim_max != RLIM_INFINITY && bound.rlim_cur > bound.rlim_max) bound.rlim_cur = bound.rlim_max;
  if (setrlimit(RLIMIT_DATA, &bound) != 0)
    throw UsageError(std::string("--max-memory cannot be set here: ") + std::strerror(errno));
  limit = megabytes;
}

bool memory_is_limited() { return limit > 0; }

std::string out_of_memory_text() {
  if (limit == 0) return "not enough memory";
  return "more than the " + megabytes_text(limit) + " of --max-memory are needed";
}

}  // namespace mspskel::cli
