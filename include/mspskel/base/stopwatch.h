// Wall time since a moment.
#pragma once

#include <chrono>

namespace mspskel {

class Stopwatch {
 public:
  // Since construction.
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace mspskel
