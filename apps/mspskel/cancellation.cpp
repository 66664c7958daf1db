#include "cancellation.h"

#include <csignal>
#include <cstdint>

#include "mspskel/base/error.h"

namespace mspskel::cli {
namespace {

volatile std::sig_atomic_t signal_received = 0;

void remember_signal(int) { signal_received = 1; }

}  // namespace

Cancellation::Cancellation(double time_limit_seconds)
    : limited_(time_limit_seconds > 0),
      deadline_(std::chrono::steady_clock::now() +
                std::chrono::microseconds(static_cast<std::int64_t>(time_limit_seconds * 1e6))) {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

bool Cancellation::interrupted() { return signal_received != 0; }

bool Cancellation::timed_out() const { return limited_ && std::chrono::steady_clock::now() >= deadline_; }

void Cancellation::throw_if_requested() const {
  if (requested()) throw Cancelled();
}

}  // namespace mspskel::cli
