#include "reader_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return mspskel::fuzz::check_reader(data, size, mspskel::MeshFormat::kPly);
}
