// Progress reports and cancellation, and what runs on several threads and honours both.
#pragma once

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
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

namespace detail {

// Work on another thread: how far it is, and whether it is to stop.
class FarSide {
 public:
  // From the other thread, as a progress callback. The stage is a literal.
  bool note(const char* stage, double share) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stage_ = stage;
    share_ = share;
    return !stopped_;
  }
  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopped_ = true;
  }
  void end() {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
    ended_.notify_all();
  }
  // Until the end; asks the callback meanwhile, with what the other thread notes. Throws Cancelled.
  void await(const ProgressCallback& progress) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ended_.wait_for(lock, std::chrono::milliseconds(50), [&] { return over_; })) {
      if (stage_ == nullptr) continue;
      const char* const stage = stage_;
      const double share = share_;
      lock.unlock();
      report_progress(progress, stage, share);
      lock.lock();
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  const char* stage_ = nullptr;  // until something is noted
  double share_ = 0;
  bool stopped_ = false, over_ = false;
};

template <class Work>
std::exception_ptr failure_of(Work&& work) {
  try {
    work();
  } catch (...) {
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace detail

// Calls here() and there(aside), where there are two threads at the same time: `here` on the calling thread,
// so it may report progress, `there` on another with an execution of its own: one thread, and a callback
// that says no once `here` has failed or the caller's callback has said no, which is asked while only `there`
// goes on. They must not write what the other one touches. Parallel loops in them run on one thread. Of two
// exceptions that of `here` is thrown. (Not std::async: a new thread often starts on the processor that the
// calling one runs on, and stays there for milliseconds.)
template <class Here, class There>
void run_beside(const Execution& execution, Here here, There there) {
  std::exception_ptr failure, other_failure;
  detail::FarSide far;
  const auto near_side = [&](auto&& work) {
    failure = detail::failure_of(work);
    if (failure) far.stop();
  };
  const auto far_side = [&](bool alone) {
    Execution aside;
    aside.threads = 1;
    aside.progress = [&far, &execution, alone](const char* stage, double share) {
      return far.note(stage, share) && (!alone || !execution.progress || execution.progress(stage, share));
    };
    other_failure = detail::failure_of([&] { there(aside); });
    far.end();
  };
#ifdef _OPENMP
#pragma omp parallel num_threads(std::min(2, thread_count(execution)))
  {
    const bool alone = omp_get_num_threads() == 1;
    if (omp_get_thread_num() == 0) near_side(here);
    if (omp_get_thread_num() == omp_get_num_threads() - 1) far_side(alone);
    if (omp_get_thread_num() == 0 && !failure) near_side([&] { far.await(execution.progress); });
  }
#else
  near_side(here);
  far_side(true);
#endif
  if (failure) std::rethrow_exception(failure);
  if (other_failure) std::rethrow_exception(other_failure);
}

}  // namespace mspskel
