// The numbers of a glTF file: buffers, views of them, accessors into those.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "growth_limit.h"
#include "mspskel/base/types.h"

namespace mspskel::detail {

// The member, or an empty value of its kind.
const nlohmann::json& member(const nlohmann::json& object, const char* name);
// A number that no list has: what size_member gives for a reference that is not there.
constexpr std::size_t kAbsent = std::numeric_limits<std::size_t>::max();

// A count or an index; `otherwise` where there is none. Throws ReadError for anything else.
std::size_t size_member(const nlohmann::json& object, const char* name, std::size_t otherwise);
// The element of that number of one of the document's lists. Throws ReadError.
const nlohmann::json& element(const nlohmann::json& document, const char* list, std::size_t number);

class GltfAccessors {
 public:
  // `binary`: the chunk of a .glb file. `folder`: where files that the document names are; without one they
  // are refused. All must outlive it.
  GltfAccessors(const nlohmann::json& document, std::string_view binary, const std::string* folder,
                GrowthLimit& limit);

  // Throw ReadError that names the accessor.
  std::vector<Vector3> vectors(std::size_t accessor);
  std::vector<std::int64_t> indices(std::size_t accessor);

 private:
  template <class Take>
  void read(std::size_t accessor, std::string_view type, std::size_t components, Take take);
  template <class Take>
  void read_view(const nlohmann::json& where, int component_type, std::size_t count, std::size_t components,
                 bool normalized, Take take);
  std::string_view buffer(std::size_t number);
  std::string load(const nlohmann::json& buffer) const;

  const nlohmann::json& document_;
  std::string_view binary_;
  const std::string* folder_;
  GrowthLimit& limit_;
  std::vector<std::string> loaded_;  // per buffer
  std::vector<char> is_loaded_;
};

}  // namespace mspskel::detail
