#include "zip_archive.h"

#include <zip.h>

#include "mspskel/base/error.h"

namespace mspskel::detail {
namespace {

std::string take_message(zip_error_t& error) {
  std::string message = zip_error_strerror(&error);
  zip_error_fini(&error);
  return message;
}

}  // namespace

void ZipArchive::Discard::operator()(zip* archive) const { zip_discard(archive); }

ZipArchive::ZipArchive(std::string_view bytes, GrowthLimit& limit) : limit_(limit) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source == nullptr) throw ReadError("the zip archive: " + take_message(error));
  archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
  if (!archive_) {
    zip_source_free(source);
    throw ReadError("the zip archive: " + take_message(error));
  }
  zip_error_fini(&error);
}

std::optional<std::string> ZipArchive::read(const std::string& name) const {
  const std::string plain =
      name.substr(name.find_first_not_of('/') == std::string::npos ? 0 : name.find_first_not_of('/'));
  const zip_int64_t index = zip_name_locate(archive_.get(), plain.c_str(), ZIP_FL_NOCASE);
  if (index < 0) return std::nullopt;
  const auto fail = [&](const std::string& why) { return ReadError(plain + " in the archive: " + why); };
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
      zip_fopen_index(archive_.get(), static_cast<zip_uint64_t>(index), 0), zip_fclose);
  if (!file) throw fail(zip_strerror(archive_.get()));
  std::string text;
  std::string part(std::size_t{1} << 16, '\0');
  for (;;) {
    const zip_int64_t got = zip_fread(file.get(), part.data(), part.size());
    if (got < 0) throw fail(zip_file_strerror(file.get()));
    if (got == 0) return text;
    limit_.spend(static_cast<std::uint64_t>(got));
    text.append(part, 0, static_cast<std::size_t>(got));
  }
}

}  // namespace mspskel::detail
