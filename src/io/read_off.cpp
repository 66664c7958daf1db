// Geomview's Object File Format: [ST][C][N][4][n]OFF [BINARY], counts, points, polygons.
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "byte_reader.h"
#include "mesh_parsers.h"
#include "mspskel/base/counted.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

struct OffHeader {
  bool texture = false, colour = false, normal = false, homogeneous = false, any_dimension = false,
       binary = false;

  int position_size() const { return homogeneous ? 4 : 3; }
  int extra_size() const { return 3 * normal + 4 * colour + 2 * texture; }
};

// The keyword at the start of `word`, which may go on with a number; nothing if there is none. `length`
// becomes the keyword's.
std::optional<OffHeader> match_keyword(std::string_view word, std::size_t& length) {
  OffHeader header;
  std::size_t i = 0;
  const auto take = [&](std::string_view letters) {
    const bool there = starts_ignoring_case(word.substr(i), letters);
    if (there) i += letters.size();
    return there;
  };
  // Only the case tells nOFF (any dimension) from NOFF (normals); in "noff" the n is a normal.
  const auto take_dimension = [&] {
    const bool there = word.substr(i, 4) == "nOFF";
    if (there) ++i;
    return there;
  };
  const auto take_prefix = [&] {
    const std::pair<std::string_view, bool*> prefixes[] = {
        {"st", &header.texture}, {"c", &header.colour}, {"n", &header.normal}, {"4", &header.homogeneous}};
    for (const auto& [letters, flag] : prefixes)
      if (!*flag && take(letters)) return *flag = true;
    return false;
  };
  // Geomview wants the prefixes in one order, and not all writers keep to it. A point has the same numbers in
  // all.
  while (!take("off")) {
    if (!header.any_dimension && take_dimension())
      header.any_dimension = true;
    else if (!take_prefix())
      return std::nullopt;
  }
  length = i;
  return header;
}

OffHeader read_header(TextScanner& scan) {
  scan.skip_blank();
  const char* start = scan.position();
  const std::string_view word = scan.word();
  std::size_t length = 0;
  const auto header = match_keyword(word, length);
  scan.seek(start + (header ? length : 0));
  if (!header) {  // the keyword is optional
    if (word.empty() || word[0] < '0' || word[0] > '9') scan.fail_expected("the keyword OFF");
    return {};
  }
  OffHeader result = *header;
  if (result.homogeneous && result.any_dimension) scan.fail(start, "4nOFF is not supported");
  const char* after = scan.position();
  if (scan.skip_spaces() && equals_ignoring_case(scan.word(), "binary"))
    result.binary = true;
  else
    scan.seek(after);
  return result;
}

void check_dimension(std::int64_t dimension) {
  if (dimension != 3)
    throw ReadError("the points have dimension " + std::to_string(dimension) + ", only 3 is supported");
}

// How the numbers are laid out, which the header does not tell.
struct Layout {
  bool vertex_lines;  // each point on a line of its own, what follows its coordinates there is ignored
  bool face_colours;  // what follows a polygon's corners on the line is its colour
};

class OffText {
 public:
  OffText(TextScanner scan, OffHeader header, std::uint64_t points, std::uint64_t polygons)
      : scan_(scan), header_(header), points_(points), polygons_(polygons) {}

  PolygonSoup read(Layout layout) {
    soup_.points.reserve(points_);
    soup_.begin.reserve(polygons_ + 1);
    soup_.corners.reserve(3 * polygons_);
    for (std::uint64_t v = 0; v < points_; ++v) read_point(layout.vertex_lines);
    for (std::uint64_t f = 0; f < polygons_; ++f) read_polygon(layout.face_colours);
    if (scan_.skip_blank())
      soup_.warnings.push_back(scan_.located(
          scan_.position(),
          "what follows the last of " + counted(static_cast<long long>(polygons_), "face") + " is left out"));
    return std::move(soup_);
  }

 private:
  double next_coordinate(bool same_line) {
    if (same_line && !scan_.skip_spaces()) scan_.fail_expected("a coordinate");
    return scan_.coordinate("a coordinate");
  }

  void read_point(bool line) {
    const double x = scan_.coordinate("a coordinate");
    const double y = next_coordinate(line), z = next_coordinate(line);
    double w = 1;
    if (header_.homogeneous) {
      scan_.skip_blank();
      const char* start = scan_.position();
      w = next_coordinate(line);
      if (w == 0 || !std::isfinite(x / w) || !std::isfinite(y / w) || !std::isfinite(z / w))
        scan_.fail(start, "a coordinate divided by w is not finite");
    }
    soup_.points.emplace_back(x / w, y / w, z / w);
    if (line) return scan_.skip_line();
    for (int i = header_.extra_size(); i > 0; --i) {
      scan_.skip_blank();
      if (scan_.word().empty()) scan_.fail_expected("a normal, colour or texture coordinate");
    }
  }

  void read_polygon(bool colours) {
    const std::int64_t size = scan_.integer("the number of a face's corners");
    if (size < 1 || static_cast<std::uint64_t>(size) > scan_.room_for(2) ||
        soup_.corners.size() + size > kMostElements)
      scan_.fail(scan_.position(), "a face cannot have " + std::to_string(size) + " corners here");
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t v = scan_.integer("a vertex index");
      if (static_cast<std::uint64_t>(v) >= points_)
        scan_.fail(scan_.position(), "vertex index " + std::to_string(v) + " is out of range, there are " +
                                         std::to_string(points_) + " vertices");
      soup_.corners.push_back(static_cast<Index>(v));
    }
    soup_.begin.push_back(static_cast<Index>(soup_.corners.size()));
    if (colours) scan_.skip_line();
  }

  TextScanner scan_;
  OffHeader header_;
  std::uint64_t points_, polygons_;
  PolygonSoup soup_;
};

std::uint64_t read_count(TextScanner& scan, const char* name, std::uint64_t bytes_each) {
  scan.skip_blank();
  const char* start = scan.position();
  const std::int64_t count = scan.integer(name);
  if (count < 0 || static_cast<std::uint64_t>(count) > scan.room_for(bytes_each) ||
      static_cast<std::uint64_t>(count) > kMostElements)
    scan.fail(start, std::string(name) + " is " + std::to_string(count) + ", but only " +
                         std::to_string(scan.bytes_left()) + " bytes follow");
  return static_cast<std::uint64_t>(count);
}

// The third number of the counts, which some writers leave out: their line ends after two, and the next one
// holds a point, which is more than one number.
void skip_edge_count(TextScanner& scan) {
  const char* here = scan.position();
  if (!scan.skip_spaces() && scan.skip_blank()) {
    scan.word();
    if (scan.skip_spaces()) return scan.seek(here);
  }
  scan.seek(here);
  scan.integer("the number of edges");
}

PolygonSoup parse_text(TextScanner scan, const OffHeader& header) {
  if (header.any_dimension) check_dimension(scan.integer("the dimension"));
  const std::uint64_t points = read_count(scan, "the number of vertices", 6);
  const std::uint64_t polygons = read_count(scan, "the number of faces", 4);
  skip_edge_count(scan);
  const bool lines = header.extra_size() > 0;
  const auto read = [&](Layout layout) { return OffText(scan, header, points, polygons).read(layout); };
  std::optional<PolygonSoup> first;
  std::exception_ptr error;
  try {
    first = read({lines, true});
    if (first->warnings.empty()) return std::move(*first);
  } catch (const ReadError&) {
    error = std::current_exception();
  }
  // Writers disagree on line breaks: points with undeclared extras, wrapped extras, several faces a line.
  // Every other layout has to use up the file exactly, so a wrong one hardly passes.
  for (const Layout layout : {Layout{!lines, true}, Layout{lines, false}, Layout{!lines, false}}) {
    try {
      PolygonSoup soup = read(layout);
      if (soup.warnings.empty()) return soup;
    } catch (const ReadError&) {
    }
  }
  if (error) std::rethrow_exception(error);
  return std::move(*first);
}

std::uint64_t read_binary_count(ByteReader& reader, const char* name, std::uint64_t bytes_each) {
  const std::int32_t count = reader.read<std::int32_t>(name);
  if (count < 0 || static_cast<std::uint64_t>(count) > reader.bytes_left() / bytes_each)
    reader.fail(std::string(name) + " is " + std::to_string(count) + ", but only " +
                std::to_string(reader.bytes_left()) + " bytes follow");
  return static_cast<std::uint64_t>(count);
}

Vector3 read_binary_point(ByteReader& reader, const OffHeader& header) {
  Vector3 p;
  for (int k = 0; k < 3; ++k) p[k] = static_cast<double>(reader.read<float>("a vertex"));
  if (header.homogeneous) p /= static_cast<double>(reader.read<float>("a vertex"));
  if (!p.allFinite()) reader.fail("a coordinate of the vertex before is not finite");
  reader.skip(4 * static_cast<std::uint64_t>(header.extra_size()), "a vertex");
  return p;
}

// 32-bit big-endian integers and floats; every polygon ends with the number of its colour's components and
// these.
PolygonSoup parse_binary(std::string_view bytes, std::size_t offset, const OffHeader& header) {
  ByteReader reader(bytes, offset, ByteOrder::kBig);
  if (header.any_dimension) check_dimension(reader.read<std::int32_t>("the dimension"));
  const auto points =
      read_binary_count(reader, "the number of vertices",
                        4 * static_cast<std::uint64_t>(header.position_size() + header.extra_size()));
  const auto polygons = read_binary_count(reader, "the number of faces", 12);
  reader.read<std::int32_t>("the number of edges");
  PolygonSoup soup;
  soup.points.reserve(points);
  soup.begin.reserve(polygons + 1);
  for (std::uint64_t v = 0; v < points; ++v) soup.points.push_back(read_binary_point(reader, header));
  for (std::uint64_t f = 0; f < polygons; ++f) {
    const auto size = read_binary_count(reader, "the number of a face's corners", 4);
    if (size == 0) reader.fail("the face before has no corners");
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::int32_t v = reader.read<std::int32_t>("a face");
      if (v < 0 || static_cast<std::uint64_t>(v) >= points)
        reader.fail("the vertex index before, " + std::to_string(v) + ", is out of range, there are " +
                    std::to_string(points) + " vertices");
      soup.corners.push_back(v);
    }
    if (soup.corners.size() > kMostElements) reader.fail("there are too many corners");
    soup.begin.push_back(static_cast<Index>(soup.corners.size()));
    reader.skip(4 * read_binary_count(reader, "the number of a colour's components", 4), "a face's colour");
  }
  return soup;
}

}  // namespace

PolygonSoup parse_off(std::string_view bytes) {
  TextScanner scan(bytes, Syntax::kHashComments);
  const OffHeader header = read_header(scan);
  if (!header.binary) return parse_text(scan, header);
  scan.skip_line();
  std::size_t offset = static_cast<std::size_t>(scan.position() - bytes.data());
  if (bytes.substr(offset, 2) == "\r\n") ++offset;
  return parse_binary(bytes, std::min(offset + 1, bytes.size()), header);
}

}  // namespace mspskel::detail
