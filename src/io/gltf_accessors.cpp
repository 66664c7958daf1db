#include "gltf_accessors.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "base64_stream.h"
#include "byte_reader.h"
#include "mesh_parsers.h"
#include "mspskel/base/error.h"
#include "read_bytes.h"

namespace mspskel::detail {
namespace {

using nlohmann::json;

std::size_t bytes_of_component(int type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      throw ReadError("its component type " + std::to_string(type) + " is unknown");
  }
}

// Normalised integers span -1 to 1, or 0 to 1.
template <class T>
double component(const ByteReader& reader, std::size_t at, bool normalized) {
  const auto value = static_cast<double>(reader.peek<T>(at));
  if (std::is_floating_point_v<T> || !normalized) return value;
  return std::max(-1.0, value / static_cast<double>(std::numeric_limits<T>::max()));
}

double component(const ByteReader& reader, std::size_t at, int type, bool normalized) {
  switch (type) {
    case 5120:
      return component<std::int8_t>(reader, at, normalized);
    case 5121:
      return component<std::uint8_t>(reader, at, normalized);
    case 5122:
      return component<std::int16_t>(reader, at, normalized);
    case 5123:
      return component<std::uint16_t>(reader, at, normalized);
    case 5125:
      return component<std::uint32_t>(reader, at, normalized);
    default:
      return component<float>(reader, at, normalized);
  }
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  c = lower(c);
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

std::string without_escapes(std::string_view uri) {
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape =
        uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0;
    path += escape ? static_cast<char>(16 * hex_digit(uri[i + 1]) + hex_digit(uri[i + 2])) : uri[i];
    if (escape) i += 2;
  }
  return path;
}

}  // namespace

const json& member(const json& object, const char* name) {
  static const json kNothing;
  if (!object.is_object()) return kNothing;
  const auto found = object.find(name);
  return found == object.end() ? kNothing : *found;
}

std::size_t size_member(const json& object, const char* name, std::size_t otherwise) {
  const json& value = member(object, name);
  if (value.is_null()) return otherwise;
  if (!value.is_number_unsigned()) throw ReadError(std::string(name) + " is no count");
  return value.get<std::size_t>();
}

const json& element(const json& document, const char* list, std::size_t number) {
  const json& values = member(document, list);
  if (!values.is_array() || number >= values.size())
    throw ReadError("number " + std::to_string(number) + " of the " + list + " is missing");
  return values[number];
}

GltfAccessors::GltfAccessors(const json& document, std::string_view binary, const std::string* folder,
                             GrowthLimit& limit)
    : document_(document), binary_(binary), folder_(folder), limit_(limit) {
  const std::size_t buffers = member(document, "buffers").size();
  loaded_.resize(buffers);
  is_loaded_.resize(buffers, 0);
}

std::vector<Vector3> GltfAccessors::vectors(std::size_t accessor) {
  std::vector<Vector3> values;
  read(accessor, "VEC3", 3, [&](std::size_t i, std::size_t k, double x) {
    if (!std::isfinite(x)) throw ReadError("a coordinate is not finite");
    if (i >= values.size()) values.resize(i + 1, Vector3::Zero());
    values[i][static_cast<Index>(k)] = x;
  });
  return values;
}

std::vector<std::int64_t> GltfAccessors::indices(std::size_t accessor) {
  std::vector<std::int64_t> values;
  read(accessor, "SCALAR", 1, [&](std::size_t i, std::size_t, double x) {
    if (!(std::abs(x) < 1e15)) throw ReadError("an index is no number");
    if (i >= values.size()) values.resize(i + 1, 0);
    values[i] = static_cast<std::int64_t>(x);
  });
  return values;
}

// Calls take(element, component, value): every one once, then those that a sparse accessor puts in place.
template <class Take>
void GltfAccessors::read(std::size_t number, std::string_view type, std::size_t components, Take take) {
  try {
    const json& accessor = element(document_, "accessors", number);
    if (member(accessor, "type") != type) throw ReadError("its type is not " + std::string(type));
    const std::size_t count = size_member(accessor, "count", 0);
    if (count > kMostElements / 3) throw ReadError("there are too many elements");
    limit_.spend(sizeof(double) * components * count);
    const auto component_type = static_cast<int>(size_member(accessor, "componentType", 0));
    const bool normalized = member(accessor, "normalized") == true;
    if (accessor.contains("bufferView"))
      read_view(accessor, component_type, count, components, normalized, take);
    else
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < components; ++k) take(i, k, 0.0);
    const json& sparse = member(accessor, "sparse");
    if (!sparse.is_object()) return;
    const std::size_t changed = size_member(sparse, "count", 0);
    if (changed > count) throw ReadError("more elements are replaced than there are");
    std::vector<std::size_t> place;
    const json& places = member(sparse, "indices");
    read_view(places, static_cast<int>(size_member(places, "componentType", 0)), changed, 1, false,
              [&](std::size_t, std::size_t, double x) {
                if (!(x >= 0 && x < static_cast<double>(count)))
                  throw ReadError("a replaced element is missing");
                place.push_back(static_cast<std::size_t>(x));
              });
    read_view(member(sparse, "values"), component_type, changed, components, normalized,
              [&](std::size_t i, std::size_t k, double x) { take(place[i], k, x); });
  } catch (const ReadError& error) {
    throw ReadError("accessor " + std::to_string(number) + ": " + error.what());
  }
}

template <class Take>
void GltfAccessors::read_view(const json& where, int component_type, std::size_t count,
                              std::size_t components, bool normalized, Take take) {
  const json& view = element(document_, "bufferViews", size_member(where, "bufferView", kAbsent));
  if (!member(member(view, "extensions"), "EXT_meshopt_compression").is_null())
    throw ReadError("its buffer is compressed by meshopt: export without compression");
  std::string_view bytes = buffer(size_member(view, "buffer", kAbsent));
  const std::size_t view_begin = size_member(view, "byteOffset", 0),
                    view_size = size_member(view, "byteLength", 0);
  if (view_begin > bytes.size() || view_size > bytes.size() - view_begin)
    throw ReadError("its view reaches beyond the buffer");
  bytes = bytes.substr(view_begin, view_size);
  const std::size_t size = bytes_of_component(component_type), whole = size * components;
  const std::size_t stride = size_member(view, "byteStride", whole),
                    begin = size_member(where, "byteOffset", 0);
  if (count == 0) return;
  if (stride < whole || begin > bytes.size() || whole > bytes.size() - begin ||
      (count - 1) > (bytes.size() - begin - whole) / stride)
    throw ReadError("it reaches beyond its view");
  const ByteReader reader(bytes, begin, ByteOrder::kLittle);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < components; ++k)
      take(i, k, component(reader, i * stride + k * size, component_type, normalized));
}

std::string_view GltfAccessors::buffer(std::size_t number) {
  const json& buffer = element(document_, "buffers", number);
  const bool in_file = !buffer.contains("uri");
  if (!in_file && !is_loaded_[number]) {
    loaded_[number] = load(buffer);
    is_loaded_[number] = 1;
  }
  if (in_file && number > 0) throw ReadError("buffer " + std::to_string(number) + " has no data");
  const std::string_view bytes = in_file ? binary_ : std::string_view(loaded_[number]);
  const std::size_t size = size_member(buffer, "byteLength", 0);
  if (size > bytes.size())
    throw ReadError("buffer " + std::to_string(number) + " has " + std::to_string(bytes.size()) + " of " +
                    std::to_string(size) + " bytes");
  return bytes.substr(0, size);
}

std::string GltfAccessors::load(const json& buffer) const {
  if (!buffer["uri"].is_string()) throw ReadError("a buffer's uri is no text");
  const auto& uri = buffer["uri"].get_ref<const std::string&>();
  if (uri.compare(0, 5, "data:") == 0) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) throw ReadError("a buffer's data is not base64");
    return Base64Stream(std::string_view(uri).substr(comma + 8)).rest();
  }
  const std::filesystem::path path = without_escapes(uri);
  if (folder_ == nullptr)
    throw ReadError("its data is in another file: read it by its path, or save it as .glb");
  if (path.is_absolute() || uri.find("://") != std::string::npos)
    throw ReadError("its data is outside of its folder: save it as .glb");
  const std::filesystem::path place = std::filesystem::path(*folder_) / path;
  std::error_code ignored;
  if (std::filesystem::exists(place, ignored) && !std::filesystem::is_regular_file(place, ignored))
    throw ReadError(place.string() + " is no file");
  return read_bytes(place.string());
}

}  // namespace mspskel::detail
