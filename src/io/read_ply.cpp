// Stanford PLY: a header that declares elements and their properties, then the values as text or binary of
// either byte order.
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "byte_reader.h"
#include "mesh_parsers.h"
#include "ply_header.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

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
  // An element ends with its line: writers put values there that no property declares.
  void end_item() { scan_.skip_line(); }
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
  void end_item() {}
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

struct PlyData {
  PolygonSoup soup;
  std::vector<double> radius;                      // one a point, or empty
  std::vector<std::array<std::int64_t, 2>> edges;  // as read
};

template <class Source>
class BodyReader {
 public:
  BodyReader(Source source, const PlyHeader& header) : source_(source), header_(header) {
    for (const Element& element : header.elements) {
      if (element.name == "vertex") point_count_ = element.count;
      for (const Property& property : element.properties) {
        with_radii_ = with_radii_ || property.role == Role::kRadius;
        with_edges_ = with_edges_ || property.role == Role::kStart;
      }
    }
  }

  PlyData read() {
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) continue;  // takes no bytes, so its count bounds nothing
      check_count(element);
      reserve(element);
      for (std::uint64_t i = 0; i < element.count; ++i) read_item(element);
    }
    return std::move(data_);
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
    if (element.name == "vertex") data_.soup.points.reserve(element.count);
    if (element.name == "face") {
      data_.soup.begin.reserve(element.count + 1);
      data_.soup.corners.reserve(3 * element.count);
    }
  }

  void read_item(const Element& element) {
    double number[4] = {0, 0, 0, 0};
    std::array<std::int64_t, 2> edge{};
    for (const Property& property : element.properties) {
      if (property.role <= Role::kRadius)
        number[static_cast<int>(property.role)] = source_.number(property.value);
      else if (property.role <= Role::kEnd)
        edge[property.role == Role::kEnd] = source_.integer(property.value);
      else if (property.role == Role::kCorners)
        read_polygon(property);
      else if (property.role == Role::kStrips)
        read_strips(property);
      else
        source_.skip(property.value, property.list_size ? read_list_size(property) : 1);
    }
    if (element.name == "vertex") {
      data_.soup.points.emplace_back(number[0], number[1], number[2]);
      if (with_radii_) data_.radius.push_back(number[3]);
    }
    if (element.name == "edge" && with_edges_) data_.edges.push_back(edge);
    source_.end_item();
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
    if (data_.soup.corners.size() + size > kMostElements) source_.fail("there are too many corners");
    for (std::uint64_t i = 0; i < size; ++i)
      data_.soup.corners.push_back(checked_vertex(source_.integer(property.value)));
    data_.soup.begin.push_back(static_cast<Index>(data_.soup.corners.size()));
  }
  // Strips one after another, -1 between them. Each further vertex makes a triangle with the two before it,
  // every second one turned round; a vertex given twice in a row only turns the strip.
  void read_strips(const Property& property) {
    const std::uint64_t size = read_list_size(property);
    if (data_.soup.corners.size() + 3 * size > kMostElements) source_.fail("there are too many corners");
    std::array<Index, 2> last{kNone, kNone};
    bool turned = false;
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::int64_t value = source_.integer(property.value);
      if (value == -1) {
        last = {kNone, kNone};
        turned = false;
        continue;
      }
      const Index v = checked_vertex(value);
      if (last[0] != kNone) {
        if (last[0] != last[1] && v != last[0] && v != last[1])
          data_.soup.add_triangle(last[turned], last[!turned], v);
        turned = !turned;
      }
      last = {last[1], v};
    }
  }
  Index checked_vertex(std::int64_t v) {
    if (v < 0 || static_cast<std::uint64_t>(v) >= point_count_)
      source_.fail("vertex index " + std::to_string(v) + " is out of range, there are " +
                   std::to_string(point_count_) + " vertices");
    return static_cast<Index>(v);
  }

  Source source_;
  const PlyHeader& header_;
  std::uint64_t point_count_ = 0;
  bool with_radii_ = false, with_edges_ = false;
  PlyData data_;
};

PlyData parse(std::string_view bytes, PlyContent content) {
  const PlyHeader header = read_ply_header(bytes, content);
  if (header.encoding == Encoding::kAscii)
    return BodyReader<TextSource>(TextSource(bytes, header.size), header).read();
  const ByteOrder order = header.encoding == Encoding::kBig ? ByteOrder::kBig : ByteOrder::kLittle;
  return BodyReader<BinarySource>(BinarySource(bytes, header.size, order), header).read();
}

}  // namespace

PolygonSoup parse_ply(std::string_view bytes) { return parse(bytes, PlyContent::kMesh).soup; }

PlyGraph parse_ply_graph(std::string_view bytes) {
  PlyData data = parse(bytes, PlyContent::kSkeleton);
  return {std::move(data.soup.points), std::move(data.radius), std::move(data.edges)};
}

}  // namespace mspskel::detail
