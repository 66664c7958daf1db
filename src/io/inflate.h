#pragma once

#include <string>
#include <string_view>

namespace mspskel::detail {

// What zlib's stream in `compressed` holds, which has to be `size` bytes; throws ReadError if it is not.
std::string inflate(std::string_view compressed, std::size_t size);

}  // namespace mspskel::detail
