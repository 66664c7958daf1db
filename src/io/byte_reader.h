// Walks over binary data in memory; every read is checked against the bytes that are left.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "mspskel/base/error.h"

namespace mspskel::detail {

enum class ByteOrder { kLittle, kBig };

class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::size_t offset, ByteOrder order)
      : bytes_(bytes), offset_(offset), order_(order) {}

  std::size_t offset() const { return offset_; }
  std::size_t bytes_left() const { return bytes_.size() - offset_; }

  // T: a number of 1, 2, 4 or 8 bytes.
  template <class T>
  T read(const char* what) {
    if (bytes_left() < sizeof(T)) fail(std::string("the file ends inside ") + what);
    const T value = peek<T>(0);
    offset_ += sizeof(T);
    return value;
  }
  // The same without checks and without moving, `ahead` bytes from here.
  template <class T>
  T peek(std::size_t ahead) const {
    unsigned char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + offset_ + ahead, sizeof(T));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bits |= std::uint64_t{raw[order_ == ByteOrder::kLittle ? i : sizeof(T) - 1 - i]} << (8 * i);
    return from_bits<T>(bits);
  }
  void skip(std::uint64_t count, const char* what) {
    if (bytes_left() < count) fail(std::string("the file ends inside ") + what);
    offset_ += static_cast<std::size_t>(count);
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw ReadError("byte " + std::to_string(offset_) + ": " + message);
  }

 private:
  template <class T>
  static T from_bits(std::uint64_t bits) {
    unsigned char native[sizeof(T)];
    if constexpr (sizeof(T) == 1) {
      const auto b = static_cast<std::uint8_t>(bits);
      std::memcpy(native, &b, sizeof(T));
    } else if constexpr (sizeof(T) == 2) {
      const auto b = static_cast<std::uint16_t>(bits);
      std::memcpy(native, &b, sizeof(T));
    } else if constexpr (sizeof(T) == 4) {
      const auto b = static_cast<std::uint32_t>(bits);
      std::memcpy(native, &b, sizeof(T));
    } else {
      std::memcpy(native, &bits, sizeof(T));
    }
    T value;
    std::memcpy(&value, native, sizeof(T));
    return value;
  }

  std::string_view bytes_;
  std::size_t offset_;
  ByteOrder order_;
};

}  // namespace mspskel::detail
