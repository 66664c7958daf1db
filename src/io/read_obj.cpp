// Wavefront OBJ: v and f records; every other record is skipped.
#include <string>

#include "mesh_parsers.h"
#include "text_scanner.h"

namespace mspskel::detail {
namespace {

class ObjText {
 public:
  explicit ObjText(std::string_view bytes)
      : scan_(bytes, Syntax::kObj), end_(bytes.data() + bytes.size()), largest_at_(bytes.data()) {}

  PolygonSoup read() {
    while (scan_.skip_blank()) {
      const std::string_view tag = scan_.word();
      if (tag == "v")
        read_point();
      else if (tag == "f" || tag == "fo")
        read_polygon();
      else
        skip_record();
    }
    if (largest_ >= static_cast<std::int64_t>(soup_.points.size())) fail_range(largest_at_, largest_ + 1);
    return std::move(soup_);
  }

 private:
  // To the next word of the record; a backslash before the line break carries it on. False at its end.
  bool next_word() {
    while (scan_.skip_spaces()) {
      const char* p = scan_.position();
      if (*p != '\\') return true;
      ++p;
      while (p != end_ && (*p == ' ' || *p == '\t')) ++p;
      if (p != end_ && *p != '\n' && *p != '\r') return true;
      if (p != end_) p += *p == '\r' && p + 1 != end_ && p[1] == '\n' ? 2 : 1;
      scan_.seek(p);
    }
    return false;
  }
  void skip_record() {
    while (next_word())
      if (scan_.word().empty()) scan_.seek(scan_.position() + 1);  // a backslash that is no continuation
  }

  void read_point() {
    if (soup_.points.size() == kMostElements) scan_.fail(scan_.position(), "there are too many vertices");
    Vector3 p;
    for (int k = 0; k < 3; ++k) {
      if (!next_word()) scan_.fail_expected("a coordinate");
      p[k] = scan_.coordinate_here("a coordinate");
    }
    soup_.points.push_back(p);
    skip_record();  // w or a colour
  }

  void read_polygon() {
    const std::size_t before = soup_.corners.size();
    while (next_word()) soup_.corners.push_back(read_corner());
    if (soup_.corners.size() == before) scan_.fail_expected("a vertex index");
    if (soup_.corners.size() > kMostElements) scan_.fail(scan_.position(), "there are too many corners");
    soup_.begin.push_back(static_cast<Index>(soup_.corners.size()));
  }

  // i, i/t, i//n or i/t/n, the parts after i also empty; a negative index counts from the last point read.
  // Later points may be named too: `largest_` is checked at the end.
  Index read_corner() {
    const char* start = scan_.position();
    const char* p = start;
    const std::int64_t index = integer(p);
    for (int part = 0; part < 2 && p != end_ && *p == '/'; ++part) {
      ++p;
      const bool empty = p == end_ || *p == '/' || static_cast<unsigned char>(*p) <= ' ';
      if (!empty) integer(p);
    }
    if (p != end_ && static_cast<unsigned char>(*p) > ' ' && *p != '#' && *p != '\\') fail_corner();
    scan_.seek(p);
    const auto count = static_cast<std::int64_t>(soup_.points.size());
    const std::int64_t v = index < 0 ? count + index : index - 1;
    if (v < 0 || v >= static_cast<std::int64_t>(kMostElements)) fail_range(start, index);
    if (v > largest_) {
      largest_ = v;
      largest_at_ = start;
    }
    return static_cast<Index>(v);
  }
  std::int64_t integer(const char*& p) {
    std::int64_t value = 0;
    const auto [next, error] = std::from_chars(p, end_, value);
    if (error != std::errc()) fail_corner();
    p = next;
    return value;
  }
  [[noreturn]] void fail_corner() { scan_.fail_expected("a corner like 1, 1/2, 1//3 or 1/2/3"); }
  [[noreturn]] void fail_range(const char* at, std::int64_t index) {
    scan_.fail(at, "vertex index " + std::to_string(index) + " is out of range, there are " +
                       std::to_string(soup_.points.size()) + " vertices");
  }

  TextScanner scan_;
  const char* end_;
  PolygonSoup soup_;
  std::int64_t largest_ = -1;
  const char* largest_at_;
};

}  // namespace

PolygonSoup parse_obj(std::string_view bytes) { return ObjText(bytes).read(); }

}  // namespace mspskel::detail
