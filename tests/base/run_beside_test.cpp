// Pieces of work at the same time, two or many: each is done once whatever the threads, no exception is lost,
// and all stop where the caller asks for it.
#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "mspskel/base/progress.h"
#include "mspskel/base/run_each_beside.h"

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

TEST_CASE("Each piece is done once, on one thread, whatever the number of threads") {
  for (const int threads : {1, 2, 5})
    for (const Index count : {0, 1, 2, 40}) {
      std::vector<int> done(static_cast<std::size_t>(count), 0);
      std::atomic<int> others{0};
      run_each_beside(count, with_threads(threads), [&](Index i, const Execution& aside) {
        if (aside.threads != 1) ++others;
        ++done[i];
      });
      CHECK(others == 0);
      CHECK(done == std::vector<int>(static_cast<std::size_t>(count), 1));
    }
}

TEST_CASE("Two pieces that wait for each other are there at the same time") {
#ifdef _OPENMP
  std::atomic<int> there{0};
  run_each_beside(2, with_threads(2), [&](Index, const Execution&) {
    ++there;
    while (there < 2) std::this_thread::yield();
  });
  CHECK(there == 2);
#endif
}

TEST_CASE("What a piece throws ends the others and is thrown again") {
  for (const int threads : {1, 2, 5})
    for (const Index thrower : {0, 1}) {
      std::atomic<int> begun{0};
      CHECK_THROWS_WITH(run_each_beside(100, with_threads(threads),
                                        [&](Index i, const Execution& aside) {
                                          ++begun;
                                          if (i == thrower) throw std::runtime_error("piece");
                                          if (i > thrower) work_without_end(aside);
                                        }),
                        "piece");
      CHECK(begun <= threads + 1);
    }
}

TEST_CASE("The callback is asked on the calling thread, also while only others go on, and stops all") {
#ifdef _OPENMP
  const std::vector<int> numbers{1, 2, 5};
#else
  const std::vector<int> numbers{1};
#endif
  for (const int threads : numbers) {
    Execution execution = with_threads(threads);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<bool> elsewhere_begun{false};
    int asked = 0, wrong = 0;
    execution.progress = [&](const char* stage, double share) {
      if (std::this_thread::get_id() != caller || std::string(stage) != "far" || share != 0.5) ++wrong;
      return ++asked < 3;
    };
    const auto piece = [&](Index, const Execution& aside) {
      if (threads > 1 && std::this_thread::get_id() == caller) {
        while (!elsewhere_begun) std::this_thread::yield();
        return;
      }
      elsewhere_begun = true;
      work_without_end(aside);
    };
    CHECK_THROWS_AS(run_each_beside(2, execution, piece), Cancelled);
    CHECK(asked == 3);
    CHECK(wrong == 0);
  }
}
