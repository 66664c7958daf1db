// What each stage took.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace mspskel {
namespace detail {

class StageClock {
 public:
  explicit StageClock(std::vector<std::pair<std::string, double>>& seconds) : seconds_(seconds) {}
  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    seconds_.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  std::vector<std::pair<std::string, double>>& seconds_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace detail
}  // namespace mspskel
