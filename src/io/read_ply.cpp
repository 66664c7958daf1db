// Stanford PLY: a header that declares elements and their properties, then the values as text or binary of
// either byte order.
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "byte_reader.h"
#include "mesh_parsers.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::optional<Scalar> scalar_of(std::string_view name) {
  struct Name {
    std::string_view text;
    Scalar scalar;
  };
  static constexpr Name kNames[] = {
      {"char", Scalar::kInt8},      {"int8", Scalar::kInt8},       {"uchar", Scalar::kUint8},
      {"uint8", Scalar::kUint8},    {"short", Scalar::kInt16},     {"int16", Scalar::kInt16},
      {"ushort", Scalar::kUint16},  {"uint16", Scalar::kUint16},   {"int", Scalar::kInt32},
      {"int32", Scalar::kInt32},    {"uint", Scalar::kUint32},     {"uint32", Scalar::kUint32},
      {"float", Scalar::kFloat32},  {"float32", Scalar::kFloat32}, {"double", Scalar::kFloat64},
      {"float64", Scalar::kFloat64}};
  for (const Name& name_of : kNames)
    if (name_of.text == name) return name_of.scalar;
  return std::nullopt;
}
std::size_t size_of(Scalar scalar) {
  static constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<int>(scalar)];
}
bool is_integer(Scalar scalar) { return scalar < Scalar::kFloat32; }

// What a property is for: kX, kY, kZ and kCorners are kept, the rest is skipped.
enum class Role { kX, kY, kZ, kCorners, kSkipped };

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

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes) : bytes_(bytes), scan_(bytes, Syntax::kPlain) {}

  PlyHeader read() {
    if (scan_.word() != "ply") scan_.fail(bytes_.data(), "the first line is not 'ply'");
    find_line_break();
    bool has_format = false;
    for (;;) {
      end_line();
      if (!scan_.skip_blank()) scan_.fail_expected("end_header");
      const std::string_view tag = scan_.word();
      if (tag == "end_header") break;
      if (tag == "format")
        read_format(), has_format = true;
      else if (tag == "element")
        read_element();
      else if (tag == "property")
        read_property();
      else if (tag == "comment" || tag == "obj_info")
        scan_.skip_line();
      else
        scan_.fail(tag.data(), "unknown header line " + scan_.quoted(tag.data()));
    }
    if (!has_format) scan_.fail(scan_.position(), "the header has no format line");
    finish();
    return std::move(header_);
  }

 private:
  // The header's line break tells how many bytes end its last line; the data may start with any byte.
  void find_line_break() {
    const std::size_t at = static_cast<std::size_t>(scan_.position() - bytes_.data());
    line_break_ = bytes_.substr(at, 2) == "\r\n" ? 2 : 1;
  }
  void end_line() {
    if (scan_.skip_spaces()) scan_.fail(scan_.position(), "unexpected " + scan_.quoted(scan_.position()));
  }
  std::string_view word(const char* what) {
    if (!scan_.skip_spaces()) scan_.fail_expected(what);
    return scan_.word();
  }

  void read_format() {
    const std::string_view name = word("a format");
    if (name == "ascii")
      header_.encoding = Encoding::kAscii;
    else if (name == "binary_little_endian")
      header_.encoding = Encoding::kLittle;
    else if (name == "binary_big_endian")
      header_.encoding = Encoding::kBig;
    else
      scan_.fail(name.data(), "unknown format " + scan_.quoted(name.data()));
    word("the format's version");
  }
  void read_element() {
    Element element;
    element.name = std::string(word("an element's name"));
    for (const Element& other : header_.elements)
      if (other.name == element.name)
        scan_.fail(scan_.position(), "element " + element.name + " is declared twice");
    if (!scan_.skip_spaces()) scan_.fail_expected("an element's count");
    const char* start = scan_.position();
    const std::int64_t count = scan_.integer_here("an element's count");
    if (count < 0 || static_cast<std::uint64_t>(count) > kMostElements)
      scan_.fail(start, "an element's count cannot be " + std::to_string(count));
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
  }
  Scalar read_scalar() {
    const std::string_view name = word("a type");
    const auto scalar = scalar_of(name);
    if (!scalar) scan_.fail(name.data(), "unknown type " + scan_.quoted(name.data()));
    return *scalar;
  }
  void read_property() {
    if (header_.elements.empty()) scan_.fail(scan_.position(), "a property before the first element");
    Property property;
    const std::string_view first = word("a type");
    if (first == "list") {
      property.list_size = read_scalar();
      if (!is_integer(*property.list_size)) scan_.fail(scan_.position(), "a list's size is not an integer");
    } else {
      scan_.seek(first.data());
    }
    property.value = read_scalar();
    property.name = std::string(word("a property's name"));
    set_role(header_.elements.back(), property);
    header_.elements.back().properties.push_back(std::move(property));
  }
  void set_role(const Element& element, Property& property) const {
    static constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
    if (element.name == "vertex" && !property.list_size)
      for (int k = 0; k < 3; ++k)
        if (property.name == kAxes[k]) property.role = static_cast<Role>(k);
    if (element.name == "face" && property.list_size &&
        (property.name == "vertex_indices" || property.name == "vertex_index")) {
      property.role = Role::kCorners;
      if (!is_integer(property.value)) scan_.fail(scan_.position(), "vertex indices are not integers");
    }
    for (const Property& other : element.properties)
      if (property.role != Role::kSkipped && other.role == property.role)
        scan_.fail(scan_.position(), "property " + property.name + " is declared twice");
  }

  void finish() {
    const char* at = scan_.position();
    header_.size = std::min(bytes_.size(), static_cast<std::size_t>(at - bytes_.data()) + line_break_);
    for (const Element& element : header_.elements) {
      int axes = 0, corners = 0;
      for (const Property& property : element.properties) {
        axes += property.role < Role::kCorners;
        corners += property.role == Role::kCorners;
      }
      if (element.name == "vertex" && axes != 3) scan_.fail(at, "the vertices have no x, y and z");
      if (element.name == "face" && corners != 1) scan_.fail(at, "the faces have no vertex_indices");
    }
  }

  std::string_view bytes_;
  TextScanner scan_;
  PlyHeader header_;
  std::size_t line_break_ = 1;
};

// The body's values in turn. Text: at least two bytes a value, and one byte may be missing at the end.
class TextSource {
 public:
  TextSource(std::string_view bytes, std::size_t offset) : scan_(bytes, Syntax::kPlain) {
    scan_.seek(bytes.data() + offset);
  }
  static std::uint64_t smallest(Scalar) { return 2; }
  std::uint64_t room_for(std::uint64_t bytes_each) const { return scan_.room_for(bytes_each); }
  double number(Scalar) { return scan_.coordinate("a coordinate"); }
  std::int64_t integer(Scalar) { return scan_.integer("an integer"); }
  void skip(Scalar, std::uint64_t count) {
    for (; count > 0; --count) {
      scan_.skip_blank();
      if (scan_.word().empty()) scan_.fail_expected("a value");
    }
  }
  [[noreturn]] void fail(const std::string& message) { scan_.fail(scan_.position(), message); }

 private:
  TextScanner scan_;
};

class BinarySource {
 public:
  BinarySource(std::string_view bytes, std::size_t offset, ByteOrder order) : reader_(bytes, offset, order) {}
  static std::uint64_t smallest(Scalar scalar) { return size_of(scalar); }
  std::uint64_t room_for(std::uint64_t bytes_each) const { return reader_.bytes_left() / bytes_each; }
  double number(Scalar scalar) {
    const double value = read<double>(scalar);
    if (!std::isfinite(value)) reader_.fail("the coordinate before is not finite");
    return value;
  }
  std::int64_t integer(Scalar scalar) { return read<std::int64_t>(scalar); }
  void skip(Scalar scalar, std::uint64_t count) {
    if (count > room_for(size_of(scalar))) reader_.fail("the file ends inside an element");
    reader_.skip(count * size_of(scalar), "an element");
  }
  [[noreturn]] void fail(const std::string& message) { reader_.fail(message); }

 private:
  template <class T>
  T read(Scalar scalar) {
    constexpr const char* kWhat = "an element";
    switch (scalar) {
      case Scalar::kInt8:
        return static_cast<T>(reader_.read<std::int8_t>(kWhat));
      case Scalar::kUint8:
        return static_cast<T>(reader_.read<std::uint8_t>(kWhat));
      case Scalar::kInt16:
        return static_cast<T>(reader_.read<std::int16_t>(kWhat));
      case Scalar::kUint16:
        return static_cast<T>(reader_.read<std::uint16_t>(kWhat));
      case Scalar::kInt32:
        return static_cast<T>(reader_.read<std::int32_t>(kWhat));
      case Scalar::kUint32:
        return static_cast<T>(reader_.read<std::uint32_t>(kWhat));
      case Scalar::kFloat32:
        return static_cast<T>(reader_.read<float>(kWhat));
      default:
        return static_cast<T>(reader_.read<double>(kWhat));
    }
  }
  ByteReader reader_;
};

template <class Source>
class BodyReader {
 public:
  BodyReader(Source source, const PlyHeader& header) : source_(source), header_(header) {
    for (const Element& element : header.elements)
      if (element.name == "vertex") point_count_ = element.count;
  }

  PolygonSoup read() {
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) continue;  // takes no bytes, so its count bounds nothing
      check_count(element);
      reserve(element);
      for (std::uint64_t i = 0; i < element.count; ++i) read_item(element);
    }
    return std::move(soup_);
  }

 private:
  void check_count(const Element& element) {
    std::uint64_t bytes_each = 0;
    for (const Property& p : element.properties)
      bytes_each += Source::smallest(p.list_size ? *p.list_size : p.value);
    if (element.count > source_.room_for(bytes_each))
      source_.fail("the header announces " + std::to_string(element.count) + " elements '" +
                   printable(element.name) + "', more than the file holds");
  }
  static std::string printable(std::string text) {
    for (char& c : text)
      if (c < ' ' || c > '~') c = '?';
    return text.substr(0, 24);
  }
  void reserve(const Element& element) {
    if (element.name == "vertex") soup_.points.reserve(element.count);
    if (element.name == "face") {
      soup_.begin.reserve(element.count + 1);
      soup_.corners.reserve(3 * element.count);
    }
  }

  void read_item(const Element& element) {
    Vector3 point;
    for (const Property& property : element.properties) {
      if (property.role < Role::kCorners)
        point[static_cast<int>(property.role)] = source_.number(property.value);
      else if (property.role == Role::kCorners)
        read_polygon(property);
      else
        source_.skip(property.value, property.list_size ? read_list_size(property) : 1);
    }
    if (element.name == "vertex") soup_.points.push_back(point);
  }
  std::uint64_t read_list_size(const Property& property) {
    const std::int64_t size = source_.integer(*property.list_size);
    if (size < 0 || static_cast<std::uint64_t>(size) > source_.room_for(Source::smallest(property.value)))
      source_.fail("a list cannot have " + std::to_string(size) + " values here");
    return static_cast<std::uint64_t>(size);
  }
  void read_polygon(const Property& property) {
    const std::uint64_t size = read_list_size(property);
    if (size == 0) source_.fail("a face has no corners");
    if (soup_.corners.size() + size > kMostElements) source_.fail("there are too many corners");
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::int64_t v = source_.integer(property.value);
      if (v < 0 || static_cast<std::uint64_t>(v) >= point_count_)
        source_.fail("vertex index " + std::to_string(v) + " is out of range, there are " +
                     std::to_string(point_count_) + " vertices");
      soup_.corners.push_back(static_cast<Index>(v));
    }
    soup_.begin.push_back(static_cast<Index>(soup_.corners.size()));
  }

  Source source_;
  const PlyHeader& header_;
  std::uint64_t point_count_ = 0;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup parse_ply(std::string_view bytes) {
  const PlyHeader header = HeaderReader(bytes).read();
  if (header.encoding == Encoding::kAscii)
    return BodyReader<TextSource>(TextSource(bytes, header.size), header).read();
  const ByteOrder order = header.encoding == Encoding::kBig ? ByteOrder::kBig : ByteOrder::kLittle;
  return BodyReader<BinarySource>(BinarySource(bytes, header.size, order), header).read();
}

}  // namespace mspskel::detail
