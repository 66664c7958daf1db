#pragma once

#include <string>

namespace mspskel::detail {

// The whole file, or standard input for "-". Throws ReadError with the path and the reason; an empty file is
// an error.
std::string read_bytes(const std::string& path);

// The extension in lower case without its dot; empty if there is none.
std::string extension_of(const std::string& path);

}  // namespace mspskel::detail
