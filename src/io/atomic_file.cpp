#include "mspskel/io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "mspskel/base/error.h"

namespace mspskel {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw WriteError("cannot write " + path + ": " + reason);
}

// Returns 0 or the error number. Closes the file either way, except standard output.
int write_all(std::FILE* file, std::string_view bytes) {
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  int error = written ? 0 : (errno != 0 ? errno : EIO);
  errno = 0;
  const bool closed = (file == stdout ? std::fflush(file) : std::fclose(file)) == 0;
  if (error == 0 && !closed) error = errno != 0 ? errno : EIO;
  return error;
}

// Creates a file that did not exist before, so that two processes never share one.
std::FILE* open_temporary(const fs::path& target, fs::path& temporary) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    temporary = target;
    temporary += ".part" + std::to_string(i);
    if (std::FILE* file = std::fopen(temporary.c_str(), "wbx")) return file;
    if (errno != EEXIST) return nullptr;
  }
  return nullptr;
}

void replace_file(const std::string& path, const fs::path& target, std::string_view bytes) {
  fs::path temporary;
  std::FILE* file = open_temporary(target, temporary);
  if (file == nullptr) fail(path, std::strerror(errno));
  std::error_code ignored;
  if (const int error = write_all(file, bytes)) {
    fs::remove(temporary, ignored);
    fail(path, std::strerror(error));
  }
  // A file that is replaced keeps its mode bits.
  const fs::file_status before = fs::status(target, ignored);
  if (fs::exists(before)) fs::permissions(temporary, before.permissions(), ignored);
  std::error_code renaming;
  fs::rename(temporary, target, renaming);
  if (!renaming) return;
  fs::remove(temporary, ignored);
  fail(path, renaming.message());
}

}  // namespace

std::filesystem::path file_behind_links(const std::string& path) {
  constexpr int kMostLinks = 40;
  fs::path target = path;
  std::error_code failure;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, failure); ++i) {
    const fs::path next = fs::read_symlink(target, failure);
    if (failure) fail(path, failure.message());
    target = target.parent_path() / next;
  }
  if (fs::is_symlink(target, failure))
    fail(path, std::make_error_code(std::errc::too_many_symbolic_link_levels).message());
  return target;
}

void write_file_atomically(const std::string& path, std::string_view bytes) {
  if (path.empty()) fail("''", "the file has no name");
  std::error_code ignored;
  if (path == "-") {
    if (const int error = write_all(stdout, bytes)) fail("standard output", std::strerror(error));
    return;
  }
  if (fs::is_directory(path, ignored)) fail(path, "it is a directory");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) fail(path, std::strerror(errno));
    if (const int error = write_all(file, bytes)) fail(path, std::strerror(error));
    return;
  }
  replace_file(path, file_behind_links(path), bytes);
}

}  // namespace mspskel
