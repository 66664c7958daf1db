// Two pieces of work at the same time: both are done whatever the threads, and no exception is lost.
#include <catch2/catch.hpp>
#include <stdexcept>
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
        [&] { ++there; });
    CHECK(here == 1);
    CHECK(there == 1);
    CHECK(at == std::this_thread::get_id());
  }
}

TEST_CASE("An exception of either is thrown again once both have ended, that of the first before the other") {
  for (const int threads : {1, 2}) {
    bool ended = false;
    const auto fail = [](const char* what) { return [what] { throw std::runtime_error(what); }; };
    CHECK_THROWS_WITH(run_beside(with_threads(threads), fail("here"), [&] { ended = true; }), "here");
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
      with_threads(2), [&] { fill(here, 2); }, [&] { fill(there, 2); });
  for (int i = 0; i < 100; ++i) {
    CHECK(here[i] == i);
    CHECK(there[i] == i);
  }
}
