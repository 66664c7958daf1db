#include "ply_header.h"

#include <algorithm>

#include "mesh_parsers.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

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

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, PlyContent content)
      : bytes_(bytes), content_(content), scan_(bytes, Syntax::kPlain) {}

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
  // Data may start with any byte, a line feed too: after a carriage return that ends the header's last line,
  // it belongs to the data only where carriage returns alone end its first line.
  void find_line_break() { only_returns_ = next_two() != "\r\n" && next_two().substr(0, 1) == "\r"; }
  std::string_view next_two() const {
    return bytes_.substr(static_cast<std::size_t>(scan_.position() - bytes_.data()), 2);
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
  Role role_of(const Element& element, const Property& property) const {
    const bool mesh = content_ == PlyContent::kMesh;
    struct Known {
      std::string_view element, property;
      bool list, wanted;
      Role role;
    };
    const Known known[] = {{"vertex", "x", false, true, Role::kX},
                           {"vertex", "y", false, true, Role::kY},
                           {"vertex", "z", false, true, Role::kZ},
                           {"vertex", "radius", false, !mesh, Role::kRadius},
                           {"edge", "vertex1", false, !mesh, Role::kStart},
                           {"edge", "vertex2", false, !mesh, Role::kEnd},
                           {"face", "vertex_indices", true, mesh, Role::kCorners},
                           {"face", "vertex_index", true, mesh, Role::kCorners},
                           {"tristrips", "vertex_indices", true, mesh, Role::kStrips},
                           {"tristrips", "vertex_index", true, mesh, Role::kStrips}};
    for (const Known& k : known)
      if (k.wanted && k.element == element.name && k.property == property.name &&
          k.list == property.list_size.has_value())
        return k.role;
    return Role::kSkipped;
  }
  void set_role(const Element& element, Property& property) const {
    property.role = role_of(element, property);
    if (property.role == Role::kSkipped) return;
    if (property.role > Role::kRadius && !is_integer(property.value))
      scan_.fail(scan_.position(), element.name == "edge" ? "node indices are not integers"
                                                          : "vertex indices are not integers");
    for (const Property& other : element.properties)
      if (other.role == property.role)
        scan_.fail(scan_.position(), "property " + property.name + " is declared twice");
  }

  static int count_roles(const Element& element, Role first, Role last) {
    int count = 0;
    for (const Property& property : element.properties)
      count += property.role >= first && property.role <= last;
    return count;
  }
  void finish() {
    const char* at = scan_.position();
    const std::size_t line_break = !only_returns_ && next_two() == "\r\n" ? 2 : 1;
    header_.size = std::min(bytes_.size(), static_cast<std::size_t>(at - bytes_.data()) + line_break);
    const bool mesh = content_ == PlyContent::kMesh;
    for (const Element& element : header_.elements) {
      if (element.name == "vertex" && count_roles(element, Role::kX, Role::kZ) != 3)
        scan_.fail(at, "the vertices have no x, y and z");
      if (mesh && element.name == "face" && count_roles(element, Role::kCorners, Role::kCorners) != 1)
        scan_.fail(at, "the faces have no vertex_indices");
      if (mesh && element.name == "tristrips" && count_roles(element, Role::kStrips, Role::kStrips) != 1)
        scan_.fail(at, "the triangle strips have no vertex_indices");
      if (!mesh && element.name == "edge" && count_roles(element, Role::kStart, Role::kEnd) != 2)
        scan_.fail(at, "the edges have no vertex1 and vertex2");
    }
  }

  std::string_view bytes_;
  PlyContent content_;
  TextScanner scan_;
  PlyHeader header_;
  bool only_returns_ = false;  // end the lines
};

}  // namespace

PlyHeader read_ply_header(std::string_view bytes, PlyContent content) {
  return HeaderReader(bytes, content).read();
}

}  // namespace mspskel::detail
