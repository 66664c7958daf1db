#include "cell_array.h"

#include <string>

#include "mesh_parsers.h"
#include "mspskel/base/error.h"

namespace mspskel::detail {
namespace {

class CellReader {
 public:
  CellReader(const CellArray& cells, Index first, Index count, PolygonSoup& soup)
      : cells_(cells), first_(first), count_(count), soup_(soup) {}

  void add_polygon(std::int64_t begin, std::int64_t end) {
    if (begin == end) return;
    check_room(end - begin);
    for (std::int64_t i = begin; i < end; ++i) soup_.corners.push_back(corner(i));
    soup_.begin.push_back(static_cast<Index>(soup_.corners.size()));
  }
  void add_strip(std::int64_t begin, std::int64_t end) {
    check_room(3 * (end - begin));
    for (std::int64_t i = begin; i + 2 < end; ++i) {
      const std::int64_t odd = (i - begin) & 1;
      soup_.add_triangle(corner(i + odd), corner(i + 1 - odd), corner(i + 2));
    }
  }

 private:
  void check_room(std::int64_t corners) const {
    if (static_cast<std::uint64_t>(corners) > kMostElements - soup_.corners.size())
      throw ReadError("there are too many corners");
  }
  Index corner(std::int64_t i) const {
    const std::int64_t v = cells_.points[static_cast<std::size_t>(i)];
    if (v < 0 || v >= count_)
      throw ReadError("vertex index " + std::to_string(v) + " is out of range, there are " +
                      std::to_string(count_) + " vertices");
    return first_ + static_cast<Index>(v);
  }

  const CellArray& cells_;
  Index first_, count_;
  PolygonSoup& soup_;
};

}  // namespace

void add_cells(const CellArray& cells, CellKind kind, Index first, Index count, PolygonSoup& soup) {
  CellReader reader(cells, first, count, soup);
  std::int64_t begin = 0;
  for (const std::int64_t end : cells.end) {
    if (end < begin || end > static_cast<std::int64_t>(cells.points.size()))
      throw ReadError("a cell ends at " + std::to_string(end) + ", outside of the list of " +
                      std::to_string(cells.points.size()) + " points");
    if (kind == CellKind::kPolygons)
      reader.add_polygon(begin, end);
    else
      reader.add_strip(begin, end);
    begin = end;
  }
}

}  // namespace mspskel::detail
