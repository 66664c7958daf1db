// libFuzzer's entry: the bytes choose shape, edits and options (choices.h).
#pragma once

#include <cstdio>
#include <cstdlib>

#include "fuzz/trial.h"

namespace mspskel::fuzz {

inline int try_bytes(bool soups, const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const Trial trial = make_trial(soups, choices);
  try {
    (void)trial.check(choices);
  } catch (const std::exception& broken) {
    std::fprintf(stderr, "broken: %s\nby %s\n", broken.what(), trial.mesh.made.c_str());
    std::abort();
  }
  return 0;
}

}  // namespace mspskel::fuzz
