#include "fuzz/trial_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return mspskel::fuzz::try_bytes(true, data, size);
}
