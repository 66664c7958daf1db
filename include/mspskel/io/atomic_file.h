// Files that nobody ever sees half written, one alone or several together.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "mspskel/base/progress.h"

namespace mspskel {

// Writes bytes to a temporary file in the folder of `path`, then renames it; whatever was at `path` is
// replaced, and its mode bits stay. A symbolic link keeps pointing to the file it names, which need not exist
// before. "-" is standard output, and devices and pipes are written to directly. Throws WriteError with the
// path and the reason, and leaves neither the temporary file nor a changed `path` behind. A file that is
// write-protected is not replaced, though its folder would allow that.
void write_file_atomically(const std::string& path, std::string_view bytes);

// Files that appear together, when they are committed, or not at all. The callback is asked a few times a
// megabyte; where it says no nothing has changed.
class OutputFiles {
 public:
  explicit OutputFiles(ProgressCallback progress = {});
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  // Without a commit, temporary files and folders that were made go again.
  ~OutputFiles();

  // And those above it. Throws WriteError.
  void make_folder(const std::string& path);
  // Writes the temporary file, unless the file that it is to replace is write-protected; what goes to
  // standard output, a device or a pipe waits for the commit. Throws WriteError, Cancelled.
  void add(const std::string& path, std::string bytes);
  // Writes to standard output, devices and pipes, then renames the temporary files. Throws WriteError, and
  // Cancelled as long as no file has its name. Where a file cannot be renamed, those before it are there.
  void commit();

 private:
  struct Stream {
    std::string path, bytes;
  };
  struct Temporary {
    std::string path;
    std::filesystem::path target, file;
  };

  ProgressCallback progress_;
  std::vector<Stream> streams_;
  std::vector<Temporary> files_;
  std::vector<std::filesystem::path> folders_;  // made, the innermost of each path first
};

// Throws WriteError if `path` is a file that nobody may write to, or not this process.
void refuse_write_protected(const std::string& path);

// What a chain of symbolic links leads to, whether it exists or not; `path` itself if it is no link. Throws
// WriteError if the chain goes round.
std::filesystem::path file_behind_links(const std::string& path);

}  // namespace mspskel
