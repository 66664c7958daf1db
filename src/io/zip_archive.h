#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "growth_limit.h"

struct zip;

namespace mspskel::detail {

// A zip archive in memory, by libzip. The bytes must outlive it.
class ZipArchive {
 public:
  // Throws ReadError for what is no archive.
  ZipArchive(std::string_view bytes, GrowthLimit& limit);

  // The file of that name in any case, with or without a slash in front; nothing if there is none. Throws
  // ReadError for one that is damaged, encrypted or larger than the limit.
  std::optional<std::string> read(const std::string& name) const;

 private:
  struct Discard {
    void operator()(zip* archive) const;
  };
  std::unique_ptr<zip, Discard> archive_;
  GrowthLimit& limit_;
};

}  // namespace mspskel::detail
