// The numbers of a page: typed arrays one after the other, and a JSON table that says where each begins.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

// Little-endian, each array at a multiple of four bytes.
class PageData {
 public:
  void add(const char* name, const std::vector<float>& values);
  void add(const char* name, const std::vector<Index>& values);

  // Name -> {"type": "f32" or "i32", "offset": bytes, "count": numbers}.
  const nlohmann::ordered_json& table() const { return table_; }
  const std::string& bytes() const { return bytes_; }

 private:
  void begin(const char* name, const char* type, std::size_t count);
  void append(std::uint32_t word);

  nlohmann::ordered_json table_ = nlohmann::ordered_json::object();
  std::string bytes_;
};

}  // namespace mspskel::detail
