#include "read_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "mesh_parsers.h"
#include "mspskel/base/error.h"

namespace mspskel::detail {
namespace {

std::string read_stream(std::FILE* file, const std::string& name, std::size_t expected) {
  std::string bytes(expected + 1, '\0');  // the extra byte finds the end of the file without another round
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) bytes.resize(2 * bytes.size() + 65536);
    const std::size_t got = std::fread(bytes.data() + used, 1, bytes.size() - used, file);
    used += got;
    if (got > 0) continue;
    if (std::ferror(file)) throw ReadError("cannot read " + name + ": " + std::strerror(errno));
    break;
  }
  if (used == 0) throw ReadError("cannot read " + name + ": it is empty");
  bytes.resize(used);
  return bytes;
}

}  // namespace

std::string read_bytes(const std::string& path) {
  if (path == "-") return read_stream(stdin, "standard input", 0);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw ReadError("cannot read " + path + ": it is a directory");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file) throw ReadError("cannot read " + path + ": " + std::strerror(errno));
  const bool regular = std::filesystem::is_regular_file(path, ignored);
  const std::uintmax_t size = regular ? std::filesystem::file_size(path, ignored) : 0;
  return read_stream(file.get(), path,
                     size == static_cast<std::uintmax_t>(-1) ? 0 : static_cast<std::size_t>(size));
}

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) c = lower(c);
  return extension;
}

}  // namespace mspskel::detail
