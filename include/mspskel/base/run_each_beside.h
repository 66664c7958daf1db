// Large pieces of work side by side, each on a thread of its own.
#pragma once

#include <algorithm>
#include <atomic>
#include <deque>
#include <exception>
#include <mutex>

#include "mspskel/base/progress.h"

namespace mspskel {

// Calls body(i, aside) for i in [0, count), each i once and begun in this order, as many at the same time as
// there are threads: for pieces of work that have parallel loops of their own, which run on one thread. On
// the calling thread the callback of `aside` is the caller's. On the others it says no once the caller's has
// or a body has thrown, which ends all; while the calling thread has nothing left, the caller's is asked with
// what they note. body may only write what belongs to i. Of several exceptions the first is rethrown.
template <class Body>
void run_each_beside(Index count, const Execution& execution, Body body) {
  std::atomic<Index> next{0};
  std::atomic<bool> stopped{false};
  std::mutex mutex;
  std::exception_ptr failure;
  const int threads = std::clamp(count, 1, thread_count(execution));
  std::deque<detail::FarSide> far(static_cast<std::size_t>(threads - 1));
  const auto stops_all = [&](auto&& work) {
    const std::exception_ptr thrown = detail::failure_of(work);
    if (!thrown) return;
    stopped = true;
    for (detail::FarSide& side : far) side.stop();
    const std::lock_guard<std::mutex> lock(mutex);
    if (!failure) failure = thrown;
  };
  const auto take = [&](const ProgressCallback& progress) {
    for (Index i = 0; !stopped && (i = next++) < count;) stops_all([&] { body(i, Execution{1, progress}); });
  };
  const auto take_near = [&] {
    take([&](const char* stage, double share) {
      return !stopped && (!execution.progress || execution.progress(stage, share));
    });
  };
#ifdef _OPENMP
#pragma omp parallel num_threads(threads)
  if (const int thread = omp_get_thread_num(); thread > 0) {
    detail::FarSide& side = far[static_cast<std::size_t>(thread) - 1];
    take([&](const char* stage, double share) { return side.note(stage, share); });
    side.end();
  } else {
    take_near();
    for (int other = 1; other < omp_get_num_threads(); ++other)
      stops_all([&] {
        if (!stopped) far[static_cast<std::size_t>(other) - 1].await(execution.progress);
      });
  }
#else
  take_near();
#endif
  if (failure) std::rethrow_exception(failure);
}

}  // namespace mspskel
