#include "distinct_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"

namespace mspskel::cli {
namespace {

namespace fs = std::filesystem;

std::string number_of(const struct stat& status) {
  return "file " + std::to_string(status.st_dev) + " " + std::to_string(status.st_ino);
}

// Equal for equal files; empty if there is nothing to lose.
std::string identity(const std::string& path, bool is_output) {
  if (path.empty()) return {};
  struct stat status {};
  if (path == "-") {
    // A stream that the shell leads to a file is that file.
    const bool known = fstat(is_output ? STDOUT_FILENO : STDIN_FILENO, &status) == 0;
    if (known && S_ISREG(status.st_mode)) return number_of(status);
    return is_output ? "standard output" : "standard input";
  }
  if (stat(path.c_str(), &status) == 0) {
    const bool keeps = S_ISREG(status.st_mode) || S_ISDIR(status.st_mode);
    return keeps ? number_of(status) : std::string();
  }
  std::error_code failure;
  const fs::path absolute = fs::absolute(file_behind_links(path), failure);
  const fs::path resolved = fs::weakly_canonical(absolute, failure);
  return "path " + (failure ? absolute : resolved).string();
}

}  // namespace

void refuse_shared_files(const std::vector<FileRole>& inputs, const std::vector<FileRole>& outputs) {
  std::map<std::string, FileRole> taken;
  for (const FileRole& input : inputs) {
    const std::string id = identity(input.path, false);
    if (id == "standard input" && taken.count(id) > 0)
      throw UsageError("standard input cannot be both " + taken.at(id).what + " and " + input.what);
    if (!id.empty()) taken.emplace(id, input);
  }
  std::map<std::string, FileRole> written;
  for (const FileRole& output : outputs) {
    const std::string id = identity(output.path, true);
    if (id.empty()) continue;
    const std::string name = output.path == "-" ? "standard output" : output.path;
    if (taken.count(id) > 0)
      throw UsageError(name + " is " + taken.at(id).what + ", which would be lost: " + output.what +
                       " needs another place");
    const auto [there, first] = written.emplace(id, output);
    if (first) continue;
    const bool alike = there->second.what == output.what;
    throw UsageError(name + (alike ? " is given twice as " + output.what
                                   : " cannot be both " + there->second.what + " and " + output.what));
  }
}

}  // namespace mspskel::cli
