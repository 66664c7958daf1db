// Before anything is read: no output may take the place of an input or of another output.
#pragma once

#include <string>
#include <vector>

namespace mspskel::cli {

// "-" is standard input or output. An empty path is none.
struct FileRole {
  std::string path;
  std::string what;  // "the mesh", "an output", "the report"
};

// Throws UsageError that names the two. Files are the same if they have the same device and number on it, so
// by whatever links and paths they are reached; files that do not exist yet, if their folders are the same
// and so are their names there. Devices and pipes may be named twice, standard streams may not.
void refuse_shared_files(const std::vector<FileRole>& inputs, const std::vector<FileRole>& outputs);

}  // namespace mspskel::cli
