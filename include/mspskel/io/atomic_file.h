// Files that nobody ever sees half written.
#pragma once

#include <string>
#include <string_view>

namespace mspskel {

// Writes bytes to a temporary file in the folder of `path`, then renames it; whatever was at `path` is
// replaced. A symbolic link keeps pointing to the file it names. "-" is standard output, and devices and
// pipes are written to directly. Throws WriteError with the path and the reason, and leaves neither the
// temporary file nor a changed `path` behind.
void write_file_atomically(const std::string& path, std::string_view bytes);

}  // namespace mspskel
