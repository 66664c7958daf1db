#include "base64_stream.h"

#include "mspskel/base/error.h"

namespace mspskel::detail {
namespace {

constexpr int kPadding = 64;

int digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  if (c == '=') return kPadding;
  throw ReadError("base64 data has a character that is no digit of it");
}

}  // namespace

// Four digits make three bytes; padding stands for those that are absent. False at the end.
bool Base64Stream::decode_group() {
  unsigned bits = 0;
  int digits = 0, padding = 0;
  for (; digits < 4 && at_ < text_.size(); ++at_) {
    if (static_cast<unsigned char>(text_[at_]) <= ' ') continue;
    const int value = digit(text_[at_]);
    if (value == kPadding ? ++padding > 2 || digits < 2 : padding > 0)
      throw ReadError("base64 data has padding in the wrong place");
    bits = bits << 6 | static_cast<unsigned>(value & 63);
    ++digits;
  }
  if (digits == 0) return false;
  if (digits == 1) throw ReadError("base64 data ends inside a byte");
  bits <<= 6 * (4 - digits);
  for (int k = 0; k < digits - padding - 1; ++k)
    decoded_ += static_cast<char>(static_cast<unsigned char>(bits >> (16 - 8 * k)));
  return true;
}

std::string Base64Stream::read(std::size_t count) {
  if (count > bytes_left()) throw ReadError("base64 data is shorter than it says");
  while (decoded_.size() < count)
    if (!decode_group()) throw ReadError("base64 data is shorter than it says");
  std::string bytes = decoded_.substr(0, count);
  decoded_.erase(0, count);
  return bytes;
}

std::string Base64Stream::rest() {
  while (decode_group()) {
  }
  return std::move(decoded_);
}

}  // namespace mspskel::detail
