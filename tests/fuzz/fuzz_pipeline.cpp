// libFuzzer's entry: the bytes choose shape, edits and options (choices.h).
#include <cstdio>
#include <cstdlib>

#include "fuzz/pipeline_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mspskel::fuzz;
  Choices choices(data, size);
  const FuzzedInput input = make_input(choices);
  try {
    (void)check_pipeline(input, choices);
  } catch (const std::exception& broken) {
    std::fprintf(stderr, "broken: %s\nby %s\n", broken.what(), input.mesh.made.c_str());
    std::abort();
  }
  return 0;
}
