#include "vtp_arrays.h"

#include <cmath>
#include <type_traits>

#include "base64_stream.h"
#include "inflate.h"
#include "mspskel/base/error.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

// Bytes as they are, with the reading of Base64Stream.
class RawStream {
 public:
  explicit RawStream(std::string_view bytes) : bytes_(bytes) {}
  std::string read(std::size_t count) {
    if (count > bytes_left()) throw ReadError("the data is shorter than it says");
    at_ += count;
    return std::string(bytes_.substr(at_ - count, count));
  }
  std::size_t bytes_left() const { return bytes_.size() - at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

// Calls read(T{}) with the type of that name.
template <class Read>
void with_type(std::string_view name, Read read) {
  if (name == "Float32") return read(float{});
  if (name == "Float64") return read(double{});
  if (name == "Int8") return read(std::int8_t{});
  if (name == "UInt8") return read(std::uint8_t{});
  if (name == "Int16") return read(std::int16_t{});
  if (name == "UInt16") return read(std::uint16_t{});
  if (name == "Int32") return read(std::int32_t{});
  if (name == "UInt32") return read(std::uint32_t{});
  if (name == "Int64") return read(std::int64_t{});
  if (name == "UInt64") return read(std::uint64_t{});
  throw ReadError("its type '" + std::string(name.substr(0, 24)) + "' is none of numbers");
}

template <class T>
std::vector<T> from_text(std::string_view text) {
  std::vector<T> values;
  TextScanner scan(text, Syntax::kPlain);
  while (scan.skip_blank())
    if constexpr (std::is_same_v<T, double>)
      values.push_back(scan.coordinate_here("a number"));
    else
      values.push_back(scan.integer_here("an integer"));
  return values;
}

template <class T>
std::vector<T> from_bytes(std::string_view bytes, std::string_view type, ByteOrder order) {
  std::vector<T> values;
  with_type(type, [&](auto sample) {
    using Stored = decltype(sample);
    if constexpr (std::is_floating_point_v<Stored> && !std::is_same_v<T, double>)
      throw ReadError("its values are not integers");
    ByteReader reader(bytes, 0, order);
    values.reserve(bytes.size() / sizeof(Stored));
    while (reader.bytes_left() >= sizeof(Stored)) {
      const auto value = static_cast<T>(reader.read<Stored>("an array"));
      if constexpr (std::is_same_v<T, double>)
        if (!std::isfinite(value)) throw ReadError("a number is not finite");
      values.push_back(value);
    }
  });
  return values;
}

}  // namespace

VtpArrays::VtpArrays(const pugi::xml_node& file, std::string_view appended, bool appended_is_base64,
                     GrowthLimit& limit)
    : appended_(appended), appended_is_base64_(appended_is_base64), limit_(limit) {
  if (std::string_view(file.attribute("byte_order").value()) == "BigEndian") order_ = ByteOrder::kBig;
  if (std::string_view(file.attribute("header_type").value()) == "UInt64") size_bytes_ = 8;
  const std::string_view compressor = file.attribute("compressor").value();
  compressed_ = !compressor.empty();
  if (compressed_ && compressor != "vtkZLibDataCompressor")
    throw ReadError("its data is compressed by " + std::string(compressor.substr(0, 40)) +
                    ": write it with ZLib, or uncompressed");
}

std::vector<double> VtpArrays::numbers(const pugi::xml_node& array) const { return values<double>(array); }
std::vector<std::int64_t> VtpArrays::integers(const pugi::xml_node& array) const {
  return values<std::int64_t>(array);
}

template <class T>
std::vector<T> VtpArrays::values(const pugi::xml_node& array) const {
  try {
    if (std::string_view(array.attribute("format").value()) == "ascii")
      return from_text<T>(array.child_value());
    return from_bytes<T>(bytes_of(array), array.attribute("type").value(), order_);
  } catch (const ReadError& error) {
    throw ReadError("the array '" + std::string(array.attribute("Name").value()).substr(0, 24) + "' of " +
                    std::string(local_name(array.parent())) + ": " + error.what());
  }
}

std::string VtpArrays::bytes_of(const pugi::xml_node& array) const {
  const std::string_view format = array.attribute("format").value();
  if (format == "binary") {
    Base64Stream source(array.child_value());
    return stored_bytes(source);
  }
  if (format != "appended") throw ReadError("its format is none of ascii, binary and appended");
  const std::uint64_t offset = array.attribute("offset").as_ullong();
  if (offset >= appended_.size()) throw ReadError("its offset is beyond the appended data");
  if (appended_is_base64_) {
    Base64Stream source(appended_.substr(offset));
    return stored_bytes(source);
  }
  RawStream source(appended_.substr(offset));
  return stored_bytes(source);
}

template <class Source>
std::uint64_t VtpArrays::read_size(Source& source) const {
  const std::string bytes = source.read(size_bytes_);
  ByteReader reader(bytes, 0, order_);
  return size_bytes_ == 8 ? reader.read<std::uint64_t>("a size") : reader.read<std::uint32_t>("a size");
}

template <class Source>
std::string VtpArrays::stored_bytes(Source& source) const {
  const std::uint64_t size = read_size(source);
  if (size > source.bytes_left()) throw ReadError("the data is shorter than it says");
  if (compressed_) return compressed_bytes(source, size);
  limit_.spend(size);
  return source.read(size);
}

// The number of blocks, their size, that of a smaller last one or 0, the compressed size of each, the blocks.
template <class Source>
std::string VtpArrays::compressed_bytes(Source& source, std::uint64_t blocks) const {
  const std::uint64_t size = read_size(source), last = read_size(source);
  std::vector<std::uint64_t> compressed;
  for (std::uint64_t b = 0; b < blocks; ++b) compressed.push_back(read_size(source));
  std::string bytes;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    if (compressed[b] > source.bytes_left()) throw ReadError("the data is shorter than it says");
    const std::uint64_t inflated = b + 1 == blocks && last > 0 ? last : size;
    limit_.spend(inflated);
    bytes += inflate(source.read(compressed[b]), inflated);
  }
  return bytes;
}

}  // namespace mspskel::detail
