// Work that asks now and then whether to stop.
#pragma once

#include <catch2/catch.hpp>

#include "mspskel/base/error.h"
#include "mspskel/base/progress.h"

namespace mspskel::test {

// How often work(callback) asks. Checks that it stops where the callback first says no, at the last question.
template <class Work>
int questions_of(Work work) {
  int asked = 0, again = 0;
  work(ProgressCallback([&](const char*, double) { return ++asked > 0; }));
  if (asked == 0) return 0;
  CHECK_THROWS_AS(work(ProgressCallback([&](const char*, double) { return ++again < asked; })), Cancelled);
  CHECK(again == asked);
  return asked;
}

}  // namespace mspskel::test
