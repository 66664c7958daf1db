// Two pieces of work at the same time: both are done whatever the threads, no exception is lost, and both
// stop where the caller asks for it.
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "mspskel/base/progress.h"

using namespace mspskel;

namespace {

Execution with_threads(int threads) {
  Execution execution;
  execution.threads = threads;
  return execution;
}

}  // namespace

TEST_CASE("Both pieces of work are done once, the first on the calling thread") {
  for (const int threads : {1, 2, 5}) {
    int here = 0, there = 0;
    std::thread::id at;
    run_beside(
        with_threads(threads),
        [&] {
          ++here;
          at = std::this_thread::get_id();
        },
        [&](const Execution& aside) {
          CHECK(aside.threads == 1);
          ++there;
        });
    CHECK(here == 1);
    CHECK(there == 1);
    CHECK(at == std::this_thread::get_id());
  }
}

TEST_CASE("An exception of either is thrown again once both have ended, that of the first before the other") {
  for (const int threads : {1, 2}) {
    bool ended = false;
    const auto fail = [](const char* what) {
      return [what](const auto&...) { throw std::runtime_error(what); };
    };
    CHECK_THROWS_WITH(
        run_beside(with_threads(threads), fail("here"), [&](const Execution&) { ended = true; }), "here");
    CHECK(ended);
    CHECK_THROWS_WITH(run_beside(
                          with_threads(threads), [] {}, fail("there")),
                      "there");
    CHECK_THROWS_WITH(run_beside(with_threads(threads), fail("here"), fail("there")), "here");
  }
}

TEST_CASE("Parallel loops work in both pieces") {
  std::vector<int> here(100, 0), there(100, 0);
  const auto fill = [](std::vector<int>& values, int threads) {
    parallel_for(
        100, "test", with_threads(threads), [] { return 0; }, [&](Index i, int) { values[i] = i; });
  };
  run_beside(
      with_threads(2), [&] { fill(here, 2); }, [&](const Execution&) { fill(there, 2); });
  for (int i = 0; i < 100; ++i) {
    CHECK(here[i] == i);
    CHECK(there[i] == i);
  }
}

namespace {

// Work that ends only where its callback says no.
void work_without_end(const Execution& aside) {
  for (;;) report_progress(aside.progress, "far", 0.5);
}

}  // namespace

TEST_CASE("While only the other side goes on, the callback is asked on the calling thread, and stops it") {
  for (const int threads : {1, 2}) {
    Execution execution = with_threads(threads);
    int asked = 0;
    const std::thread::id caller = std::this_thread::get_id();
    execution.progress = [&](const char* stage, double share) {
      CHECK(std::string(stage) == "far");
      CHECK(share == 0.5);
      CHECK(std::this_thread::get_id() == caller);
      return ++asked < 3;
    };
    CHECK_THROWS_AS(run_beside(
                        execution, [] {}, work_without_end),
                    Cancelled);
    CHECK(asked == 3);
  }
}

TEST_CASE("Where the near side fails the other one stops, and a callback that said no is not asked again") {
  for (const int threads : {1, 2}) {
    Execution execution = with_threads(threads);
    int asked = 0;
    execution.progress = [&](const char*, double) { return ++asked < 1; };
    CHECK_THROWS_AS(run_beside(
                        execution, [&] { report_progress(execution.progress, "near", 0); }, work_without_end),
                    Cancelled);
    CHECK(asked == 1);
    CHECK_THROWS_WITH(run_beside(
                          with_threads(threads), [] { throw std::runtime_error("near"); }, work_without_end),
                      "near");
  }
}
