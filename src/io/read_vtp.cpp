// VTK's XML polydata: pieces of points, polygons and triangle strips.
#include <string>

#include "cell_array.h"
#include "mesh_parsers.h"
#include "mspskel/base/error.h"
#include "vtp_arrays.h"

namespace mspskel::detail {
namespace {

// The elements, and the block of data behind them, which is no XML where it is raw.
struct Parts {
  std::string elements;
  std::string_view appended;
};

Parts split_at_appended(std::string_view bytes) {
  const std::size_t tag = bytes.find("<AppendedData");
  const std::size_t tag_end = tag == std::string_view::npos ? tag : bytes.find('>', tag);
  if (tag_end == std::string_view::npos || bytes[tag_end - 1] == '/') return {std::string(bytes), {}};
  Parts parts{std::string(bytes.substr(0, tag_end + 1)) + "</AppendedData></VTKFile>", {}};
  const std::size_t mark = bytes.find_first_not_of(" \t\r\n", tag_end + 1);
  if (mark == std::string_view::npos || bytes[mark] != '_')
    throw ReadError("the appended data has no underscore in front");
  parts.appended = bytes.substr(mark + 1);
  return parts;
}

class VtpFile {
 public:
  explicit VtpFile(std::string_view bytes) {
    GrowthLimit limit(bytes.size());
    const Parts parts = split_at_appended(bytes);
    load_xml(parts.elements, document_);
    const pugi::xml_node root = first_element(document_, "VTKFile");
    const std::string type = root.attribute("type").value();
    if (type != "PolyData")
      throw ReadError(root ? "the file holds " + (type.empty() ? "nothing" : type.substr(0, 24)) +
                                 ", not PolyData: save its surface (in ParaView, Extract Surface)"
                           : "there is no element VTKFile");
    const std::string_view encoding = first_element(root, "AppendedData").attribute("encoding").value();
    // Raw bytes end where they end; base64 is followed by the closing tags.
    const bool base64 = encoding == "base64";
    const VtpArrays arrays(root, base64 ? parts.appended.substr(0, parts.appended.find('<')) : parts.appended,
                           base64, limit);
    const pugi::xml_node data = first_element(root, "PolyData");
    for (pugi::xml_node piece = first_element(data, "Piece"); piece; piece = next_element(piece, "Piece"))
      read_piece(piece, arrays);
  }

  PolygonSoup take() { return std::move(soup_); }

 private:
  void read_piece(const pugi::xml_node& piece, const VtpArrays& arrays) {
    const pugi::xml_node points = first_element(first_element(piece, "Points"), "DataArray");
    if (!points) return;
    const std::vector<double> values = arrays.numbers(points);
    if (values.size() % 3 != 0) throw ReadError("the points have no three coordinates each");
    if (soup_.points.size() + values.size() / 3 > kMostElements) throw ReadError("there are too many points");
    const auto first = static_cast<Index>(soup_.points.size());
    for (std::size_t i = 0; i < values.size(); i += 3)
      soup_.points.emplace_back(values[i], values[i + 1], values[i + 2]);
    const auto count = static_cast<Index>(values.size() / 3);
    add_cells(cells(first_element(piece, "Polys"), arrays), CellKind::kPolygons, first, count, soup_);
    add_cells(cells(first_element(piece, "Strips"), arrays), CellKind::kStrips, first, count, soup_);
  }

  static CellArray cells(const pugi::xml_node& element, const VtpArrays& arrays) {
    CellArray cells;
    for (pugi::xml_node array = first_element(element, "DataArray"); array;
         array = next_element(array, "DataArray")) {
      const std::string_view name = array.attribute("Name").value();
      if (name == "connectivity") cells.points = arrays.integers(array);
      if (name == "offsets") cells.end = arrays.integers(array);
    }
    return cells;
  }

  pugi::xml_document document_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup parse_vtp(std::string_view bytes) { return VtpFile(bytes).take(); }

}  // namespace mspskel::detail
