#include "page_data.h"

#include <cstring>

namespace mspskel::detail {

void PageData::begin(const char* name, const char* type, std::size_t count) {
  table_[name] = {{"type", type}, {"offset", bytes_.size()}, {"count", count}};
  bytes_.reserve(bytes_.size() + 4 * count);
}

void PageData::append(std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes_ += static_cast<char>(word >> shift & 255);
}

void PageData::add(const char* name, const std::vector<float>& values) {
  begin(name, "f32", values.size());
  for (const float value : values) {
    std::uint32_t word = 0;
    std::memcpy(&word, &value, sizeof word);
    append(word);
  }
}

void PageData::add(const char* name, const std::vector<Index>& values) {
  begin(name, "i32", values.size());
  for (const Index value : values) append(static_cast<std::uint32_t>(value));
}

}  // namespace mspskel::detail
