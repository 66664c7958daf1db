// Legacy VTK polydata: lines of text that name what follows, and values as text or as big-endian binary.
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "byte_reader.h"
#include "cell_array.h"
#include "mesh_parsers.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

enum class Number { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat, kDouble };

struct NumberType {
  std::string_view name;
  Number number;
  std::size_t size;
};

constexpr NumberType kTypes[] = {{"char", Number::kInt8, 1},
                                 {"signed_char", Number::kInt8, 1},
                                 {"unsigned_char", Number::kUint8, 1},
                                 {"short", Number::kInt16, 2},
                                 {"unsigned_short", Number::kUint16, 2},
                                 {"int", Number::kInt32, 4},
                                 {"unsigned_int", Number::kUint32, 4},
                                 {"long", Number::kInt64, 8},
                                 {"unsigned_long", Number::kUint64, 8},
                                 {"vtkidtype", Number::kInt32, 4},
                                 {"vtktypeint64", Number::kInt64, 8},
                                 {"vtktypeuint64", Number::kUint64, 8},
                                 {"vtktypeint32", Number::kInt32, 4},
                                 {"float", Number::kFloat, 4},
                                 {"double", Number::kDouble, 8}};

constexpr NumberType kInt{"int", Number::kInt32, 4};

class LegacyFile {
 public:
  explicit LegacyFile(std::string_view bytes) : bytes_(bytes), scan_(bytes, Syntax::kPlain) {}

  PolygonSoup read() {
    read_head();
    while (read_section()) {
    }
    const auto count = static_cast<Index>(soup_.points.size());
    add_cells(polygons_, CellKind::kPolygons, 0, count, soup_);
    add_cells(strips_, CellKind::kStrips, 0, count, soup_);
    return std::move(soup_);
  }

 private:
  std::string_view word() {
    if (!scan_.skip_blank()) scan_.fail(scan_.position(), "the file ends too soon");
    return scan_.word();
  }
  [[noreturn]] void fail_word(std::string_view found, const std::string& expected) const {
    scan_.fail(found.data(), "expected " + expected + ", found " + scan_.quoted(found.data()));
  }
  void expect(std::string_view keyword) {
    const std::string_view found = word();
    if (!equals_ignoring_case(found, keyword)) fail_word(found, std::string(keyword));
  }

  void read_head() {
    expect("#");
    expect("vtk");
    expect("datafile");
    scan_.skip_line();
    next_line();
    scan_.skip_line();  // the title
    const std::string_view encoding = word();
    binary_ = equals_ignoring_case(encoding, "binary");
    if (!binary_ && !equals_ignoring_case(encoding, "ascii")) fail_word(encoding, "ASCII or BINARY");
    expect("dataset");
    const std::string_view kind = word();
    if (!equals_ignoring_case(kind, "polydata"))
      scan_.fail(kind.data(), "the dataset is " + scan_.quoted(kind.data()) +
                                  ", not POLYDATA: save its surface (in ParaView, Extract Surface)");
  }
  void next_line() {
    const char* p = scan_.position();
    const char* const end = bytes_.data() + bytes_.size();
    if (p != end && *p == '\r') ++p;
    if (p != end && *p == '\n') ++p;
    scan_.seek(p);
  }

  // False where the cells are over: what follows belongs to points and cells that were read.
  bool read_section() {
    if (!scan_.skip_blank()) return false;
    const std::string_view name = scan_.word();
    CellArray unused;
    if (equals_ignoring_case(name, "points"))
      read_points();
    else if (equals_ignoring_case(name, "polygons"))
      read_cells(polygons_);
    else if (equals_ignoring_case(name, "triangle_strips"))
      read_cells(strips_);
    else if (equals_ignoring_case(name, "vertices") || equals_ignoring_case(name, "lines"))
      read_cells(unused);
    else if (equals_ignoring_case(name, "field"))
      skip_field();
    else if (equals_ignoring_case(name, "metadata"))
      skip_metadata();
    else if (equals_ignoring_case(name, "point_data") || equals_ignoring_case(name, "cell_data"))
      return false;
    else
      fail_word(name, "POINTS, POLYGONS or TRIANGLE_STRIPS");
    return true;
  }

  std::uint64_t read_count(const char* what) {
    scan_.skip_blank();
    const char* at = scan_.position();
    const std::int64_t count = scan_.integer(what);
    if (count < 0 || static_cast<std::uint64_t>(count) > kMostElements)
      scan_.fail(at, std::string(what) + " cannot be " + std::to_string(count));
    return static_cast<std::uint64_t>(count);
  }
  NumberType read_type() {
    const std::string_view name = word();
    for (const NumberType& type : kTypes)
      if (equals_ignoring_case(name, type.name)) return type;
    scan_.fail(name.data(), "unknown type " + scan_.quoted(name.data()));
  }

  // Calls take(value) for each of them; a binary block begins on the next line.
  template <class T, class Take>
  void read_values(std::uint64_t count, const NumberType& type, Take take) {
    const std::uint64_t room = binary_ ? scan_.bytes_left() / type.size : scan_.room_for(2);
    if (count > room)
      scan_.fail(scan_.position(), std::to_string(count) + " values are announced, more than the file holds");
    if (!binary_) {
      for (std::uint64_t i = 0; i < count; ++i)
        if constexpr (std::is_same_v<T, double>)
          take(scan_.coordinate("a number"));
        else
          take(scan_.integer("an integer"));
      return;
    }
    scan_.skip_line();
    next_line();
    ByteReader reader(bytes_, static_cast<std::size_t>(scan_.position() - bytes_.data()), ByteOrder::kBig);
    for (std::uint64_t i = 0; i < count; ++i) take(read_binary<T>(reader, type.number));
    scan_.seek(bytes_.data() + reader.offset());
  }
  template <class T>
  static T read_binary(ByteReader& reader, Number number) {
    constexpr const char* kWhat = "an array";
    switch (number) {
      case Number::kInt8:
        return static_cast<T>(reader.read<std::int8_t>(kWhat));
      case Number::kUint8:
        return static_cast<T>(reader.read<std::uint8_t>(kWhat));
      case Number::kInt16:
        return static_cast<T>(reader.read<std::int16_t>(kWhat));
      case Number::kUint16:
        return static_cast<T>(reader.read<std::uint16_t>(kWhat));
      case Number::kInt32:
        return static_cast<T>(reader.read<std::int32_t>(kWhat));
      case Number::kUint32:
        return static_cast<T>(reader.read<std::uint32_t>(kWhat));
      case Number::kInt64:
        return static_cast<T>(reader.read<std::int64_t>(kWhat));
      case Number::kUint64:
        return static_cast<T>(reader.read<std::uint64_t>(kWhat));
      case Number::kFloat:
        return whole<T>(static_cast<double>(reader.read<float>(kWhat)), reader);
      default:
        return whole<T>(reader.read<double>(kWhat), reader);
    }
  }
  template <class T>
  static T whole(double value, const ByteReader& reader) {
    if (!std::is_same_v<T, double> || !std::isfinite(value))
      reader.fail("the number before is not finite, or no integer");
    return static_cast<T>(value);
  }

  void read_points() {
    const std::uint64_t count = read_count("the number of points");
    const NumberType type = read_type();
    std::vector<double> values;
    if (soup_.points.size() + count > kMostElements / 3)
      scan_.fail(scan_.position(), "there are too many points");
    read_values<double>(3 * count, type, [&](double x) { values.push_back(x); });
    for (std::size_t i = 0; i < values.size(); i += 3)
      soup_.points.emplace_back(values[i], values[i + 1], values[i + 2]);
  }

  // Up to version 4 "n point.." a cell; from 5 on two arrays, where each cell begins and the points.
  void read_cells(CellArray& cells) {
    const std::uint64_t first = read_count("the number of cells"), second = read_count("the size of a list");
    const char* before = scan_.position();
    const bool offsets = scan_.skip_blank() && equals_ignoring_case(scan_.word(), "offsets");
    if (!offsets) {
      scan_.seek(before);
      read_counted_cells(first, second, cells);
      return;
    }
    const NumberType type = read_type();
    const auto base = static_cast<std::int64_t>(cells.points.size());
    bool begin = true;
    read_values<std::int64_t>(first, type, [&](std::int64_t end) {
      if (!begin) cells.end.push_back(base + end);
      begin = false;
    });
    expect("connectivity");
    const NumberType of_points = read_type();
    read_values<std::int64_t>(second, of_points, [&](std::int64_t v) { cells.points.push_back(v); });
  }
  void read_counted_cells(std::uint64_t count, std::uint64_t size, CellArray& cells) {
    std::vector<std::int64_t> list;
    const char* at = scan_.position();
    read_values<std::int64_t>(size, kInt, [&](std::int64_t v) { list.push_back(v); });
    std::size_t i = 0;
    for (std::uint64_t c = 0; c < count; ++c) {
      const std::int64_t points = i < list.size() ? list[i++] : -1;
      if (points < 0 || static_cast<std::uint64_t>(points) > list.size() - i)
        scan_.fail(at, "cell " + std::to_string(c) + " does not fit into its list");
      const auto end = i + static_cast<std::size_t>(points);
      for (; i < end; ++i) cells.points.push_back(list[i]);
      cells.end.push_back(static_cast<std::int64_t>(cells.points.size()));
    }
  }

  void skip_field() {
    word();  // its name
    const std::uint64_t arrays = read_count("the number of arrays");
    for (std::uint64_t a = 0; a < arrays; ++a) {
      if (equals_ignoring_case(word(), "metadata")) {
        skip_metadata();
        word();
      }
      const std::uint64_t components = read_count("a number of components"),
                          tuples = read_count("a number of tuples");
      const NumberType type = read_type();
      skip_values(components * tuples, type);
    }
  }
  void skip_values(std::uint64_t count, const NumberType& type) {
    if (!binary_) {
      for (; count > 0; --count) word();
      return;
    }
    scan_.skip_line();
    next_line();
    if (count > scan_.bytes_left() / type.size) scan_.fail(scan_.position(), "the file ends inside an array");
    scan_.seek(scan_.position() + count * type.size);
  }
  // Ends with an empty line.
  void skip_metadata() {
    for (bool empty = false; !empty && scan_.bytes_left() > 0;) {
      scan_.skip_line();
      next_line();
      empty = !scan_.skip_spaces();
    }
  }

  std::string_view bytes_;
  TextScanner scan_;
  bool binary_ = false;
  PolygonSoup soup_;
  CellArray polygons_, strips_;
};

}  // namespace

PolygonSoup parse_vtk(std::string_view bytes) { return LegacyFile(bytes).read(); }

}  // namespace mspskel::detail
