// The header of a PLY file: what its elements are called, how many there are, and how their values are
// stored.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mspskel::detail {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

inline std::size_t size_of(Scalar scalar) {
  static constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<int>(scalar)];
}
inline bool is_integer(Scalar scalar) { return scalar < Scalar::kFloat32; }

// What a file is read for.
enum class PlyContent { kMesh, kSkeleton };

// What a property is for. The first six are single numbers, the next two lists; the rest is skipped.
enum class Role { kX, kY, kZ, kRadius, kStart, kEnd, kCorners, kStrips, kSkipped };

struct Property {
  std::string name;
  Scalar value = Scalar::kFloat32;
  std::optional<Scalar> list_size;  // a list if set
  Role role = Role::kSkipped;
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};
enum class Encoding { kAscii, kLittle, kBig };
struct PlyHeader {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
  std::size_t size = 0;  // bytes, the line break after end_header included
};

// Properties that the content has no use for are to be skipped. Throws ReadError that names the line.
PlyHeader read_ply_header(std::string_view bytes, PlyContent content);

}  // namespace mspskel::detail
