// Progress reports and cancellation, and what runs on several threads and honours both.
#pragma once

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <utility>

#include "mspskel/base/error.h"
#include "mspskel/base/types.h"

namespace mspskel {

// Called from the thread that runs the stage, never concurrently: the stage's name and the share done, 0
// to 1. Return false to cancel; the stage then throws Cancelled and leaves nothing behind.
using ProgressCallback = std::function<bool(const char* stage, double fraction)>;

// Throws Cancelled if the callback asks to stop. An empty callback is fine.
inline void report_progress(const ProgressCallback& progress, const char* stage, double fraction) {
  if (progress && !progress(stage, fraction)) throw Cancelled();
}

// What a parallel stage needs from its caller.
struct Execution {
  int threads = 0;  // 0: as many as OpenMP offers
  ProgressCallback progress;
};

inline int thread_count(const Execution& execution) {
#ifdef _OPENMP
  return execution.threads > 0 ? execution.threads : omp_get_max_threads();
#else
  (void)execution;
  return 1;
#endif
}

// Calls body(i, state) for i in [0, count), each i once; `state` is one value of make_state() a thread
// (scratch memory). body may only write what belongs to i, so the result does not depend on the number of
// threads. The first exception is rethrown. Threads take `grain` items at a time; the callback is asked after
// each such block of the calling thread.
template <class MakeState, class Body>
void parallel_for(Index count, const char* stage, const Execution& execution, MakeState make_state, Body body,
                  Index grain = 16) {
  std::atomic<bool> stop{false};
  std::exception_ptr failure;
  report_progress(execution.progress, stage, 0.0);
#ifdef _OPENMP
#pragma omp parallel num_threads(thread_count(execution))
#endif
  {
    try {
      auto state = make_state();
#ifdef _OPENMP
      const bool reports = omp_get_thread_num() == 0;
#pragma omp for schedule(dynamic, 1) nowait
#else
      const bool reports = true;
#endif
      for (Index block = 0; block < (count + grain - 1) / grain; ++block) {
        if (stop.load(std::memory_order_relaxed)) continue;
        try {
          const Index end = std::min(count, (block + 1) * grain);
          for (Index i = block * grain; i < end; ++i) body(i, state);
          if (reports) report_progress(execution.progress, stage, static_cast<double>(end) / count);
        } catch (...) {
          stop = true;
#ifdef _OPENMP
#pragma omp critical(mspskel_parallel_failure)
#endif
          if (!failure) failure = std::current_exception();
        }
      }
    } catch (...) {
      stop = true;
#ifdef _OPENMP
#pragma omp critical(mspskel_parallel_failure)
#endif
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

// Calls both, where there are two threads at the same time: `here` on the calling thread, so it may report
// progress, `there` on another. They must not write what the other one touches. Parallel loops in them run on
// one thread. Of two exceptions that of `here` is thrown. (Not std::async: a new thread often starts on the
// processor that the calling one runs on, and stays there for milliseconds.)
template <class Here, class There>
void run_beside(const Execution& execution, Here here, There there) {
  std::exception_ptr failure, other_failure;
  const auto guarded = [](auto& work, std::exception_ptr& thrown) {
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
  };
#ifdef _OPENMP
#pragma omp parallel num_threads(std::min(2, thread_count(execution)))
  {
    if (omp_get_thread_num() == 0) guarded(here, failure);
    if (omp_get_thread_num() == omp_get_num_threads() - 1) guarded(there, other_failure);
  }
#else
  (void)execution;
  guarded(here, failure);
  guarded(there, other_failure);
#endif
  if (failure) std::rethrow_exception(failure);
  if (other_failure) std::rethrow_exception(other_failure);
}

}  // namespace mspskel
