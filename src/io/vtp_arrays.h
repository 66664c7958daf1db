// The arrays of VTK's XML files, however they are stored.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "byte_reader.h"
#include "growth_limit.h"
#include "xml_document.h"

namespace mspskel::detail {

// A <DataArray>'s values are text in it, or base64 in it, or lie in one block behind the elements as bytes or
// as base64; both of the latter begin with their size and may be compressed in blocks.
class VtpArrays {
 public:
  // `file`: the root element. `appended`: what follows the underscore, if there is such a block.
  VtpArrays(const pugi::xml_node& file, std::string_view appended, bool appended_is_base64,
            GrowthLimit& limit);

  // Throw ReadError that names the array. Numbers are finite, integers whole.
  std::vector<double> numbers(const pugi::xml_node& array) const;
  std::vector<std::int64_t> integers(const pugi::xml_node& array) const;

 private:
  template <class T>
  std::vector<T> values(const pugi::xml_node& array) const;
  std::string bytes_of(const pugi::xml_node& array) const;
  template <class Source>
  std::string stored_bytes(Source& source) const;
  template <class Source>
  std::string compressed_bytes(Source& source, std::uint64_t blocks) const;
  template <class Source>
  std::uint64_t read_size(Source& source) const;

  ByteOrder order_ = ByteOrder::kLittle;
  std::size_t size_bytes_ = 4;
  bool compressed_ = false;
  std::string_view appended_;
  bool appended_is_base64_;
  GrowthLimit& limit_;
};

}  // namespace mspskel::detail
