// Catch2 2.13 has no SKIP: a test that cannot run here calls skip(why), and the process ends with 77 unless
// something failed.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <iostream>

#include "support/skip.h"

#ifndef MSPSKEL_COMPILED
#error "the target mspskel must tell its users that it is compiled: else each of them compiles it again"
#endif

namespace mspskel::test {
namespace {
bool skipped = false;
}
void skip(const std::string& why) {
  std::cout << "skipped: " << why << "\n";
  skipped = true;
}
}  // namespace mspskel::test

int main(int argc, char** argv) {
  const int failures = Catch::Session().run(argc, argv);
  if (failures != 0) return 1;
  return mspskel::test::skipped ? 77 : 0;
}
