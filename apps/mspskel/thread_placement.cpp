#include "thread_placement.h"

#include <omp.h>

#ifdef __linux__
#include <sched.h>
#endif

namespace mspskel::cli {

#ifdef __linux__

void keep_threads_apart(int threads) {
  cpu_set_t allowed;
  const int here = sched_getcpu();
  if (threads < 2 || here < 0 || omp_get_proc_bind() != omp_proc_bind_false ||
      sched_getaffinity(0, sizeof allowed, &allowed) != 0 || threads != CPU_COUNT(&allowed))
    return;
  cpu_set_t own;
  CPU_ZERO(&own);
  CPU_SET(here, &own);
  CPU_CLR(here, &allowed);
#pragma omp parallel num_threads(threads)
  {
    const cpu_set_t& place = omp_get_thread_num() == 0 ? own : allowed;
    sched_setaffinity(0, sizeof place, &place);
  }
}

#else

void keep_threads_apart(int) {}

#endif

}  // namespace mspskel::cli
