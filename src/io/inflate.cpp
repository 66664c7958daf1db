#include "inflate.h"

#include <zlib.h>

#include "mspskel/base/error.h"

namespace mspskel::detail {

std::string inflate(std::string_view compressed, std::size_t size) {
  std::string bytes(size, '\0');
  uLongf written = size;
  const int status =
      uncompress(reinterpret_cast<Bytef*>(bytes.data()), &written,
                 reinterpret_cast<const Bytef*>(compressed.data()), static_cast<uLong>(compressed.size()));
  if (status != Z_OK || written != size) throw ReadError("a compressed block is damaged");
  return bytes;
}

}  // namespace mspskel::detail
