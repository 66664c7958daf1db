// Files that nobody ever sees half written.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mspskel {

// Writes bytes to a temporary file in the folder of `path`, then renames it; whatever was at `path` is
// replaced, and its mode bits stay. A symbolic link keeps pointing to the file it names, which need not exist
// before. "-" is standard output, and devices and
// pipes are written to directly. Throws WriteError with the path and the reason, and leaves neither the
// temporary file nor a changed `path` behind.
void write_file_atomically(const std::string& path, std::string_view bytes);

// What a chain of symbolic links leads to, whether it exists or not; `path` itself if it is no link. Throws
// WriteError if the chain goes round.
std::filesystem::path file_behind_links(const std::string& path);

}  // namespace mspskel
