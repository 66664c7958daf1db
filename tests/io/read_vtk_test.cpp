// Legacy VTK and XML VTP polydata: text, base64, raw and compressed, either byte order; defects are refused.
#include <zlib.h>

#include "io/tetrahedron_text.h"

using namespace mspskel;
using mspskel::test::Bytes;
using mspskel::test::check_tetrahedron;
using mspskel::test::replace_all;

namespace {

const double kPoints[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
const int kCorners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};

PolygonSoup vtk(const std::string& text) {
  return read_polygon_soup(std::string_view(text), MeshFormat::kVtk);
}
PolygonSoup vtp(const std::string& text) {
  return read_polygon_soup(std::string_view(text), MeshFormat::kVtp);
}

const std::string kHead = "# vtk DataFile Version 3.0\na tetrahedron\n";
const std::string kPointsText = "POINTS 4 float\n0 0 0 1 0 0 0 1 0\n0 0 1\n";
const std::string kCellsText = "POLYGONS 4 16\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kOffsetsText =
    "POLYGONS 5 12\nOFFSETS vtktypeint64\n0 3 6 9 12\nCONNECTIVITY vtktypeint64\n0 2 1 0 1 3 1 2 3 2 0 3\n";
const std::string kLegacy = kHead + "ASCII\nDATASET POLYDATA\n" + kPointsText + kCellsText;

std::string binary_legacy(bool offsets) {
  Bytes points(true), cells(true), ends(true);
  for (const double x : kPoints) points.add(x);
  for (int i = 0; i < 12; ++i) {
    if (i % 3 == 0 && !offsets) cells.add(std::int32_t{3});
    if (offsets)
      cells.add(std::int64_t{kCorners[i]});
    else
      cells.add(std::int32_t{kCorners[i]});
  }
  for (std::int64_t end = 0; end <= 12; end += 3) ends.add(end);
  const std::string metadata = "\nMETADATA\nINFORMATION 1\nNAME a LOCATION b\nDATA 2 0 1\n\n";
  const std::string field =
      "FIELD FieldData 1\nTimeValue 1 1 double\n" + Bytes(true).add(0.5).text + metadata;
  const std::string faces = offsets ? "POLYGONS 5 12\nOFFSETS vtktypeint64\n" + ends.text +
                                          "\nCONNECTIVITY vtktypeint64\n" + cells.text
                                    : "POLYGONS 4 16\n" + cells.text;
  return kHead + "BINARY\nDATASET POLYDATA\n" + field + "POINTS 4 double\n" + points.text + metadata + faces +
         "\nPOINT_DATA 4\nSCALARS s unsigned_char 1\nLOOKUP_TABLE default\n\xFF\x01\x02\x03";
}

std::string encode(const std::string& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

enum class Storage { kText, kBase64, kRaw, kAppendedBase64 };

// A VTP file of the tetrahedron, as VTK would lay it out.
struct VtpForm {
  Storage storage = Storage::kText;
  bool compressed = false, big = false, wide = false;
  std::string data = {};  // appended

  template <class T>
  std::string sizes(const std::vector<std::size_t>& values) const {
    Bytes bytes(big);
    for (const std::size_t v : values) bytes.add(static_cast<T>(v));
    return bytes.text;
  }
  std::string header(const std::vector<std::size_t>& values) const {
    return wide ? sizes<std::uint64_t>(values) : sizes<std::uint32_t>(values);
  }
  // Header and data, the one encoded apart from the other where it is compressed.
  std::string stored(const std::string& bytes) const {
    const bool base64 = storage != Storage::kRaw;
    if (!compressed) {
      const std::string whole = header({bytes.size()}) + bytes;
      return base64 ? encode(whole) : whole;
    }
    const std::size_t block = 64;
    std::vector<std::size_t> values{(bytes.size() + block - 1) / block, block, bytes.size() % block};
    std::string blocks;
    for (std::size_t at = 0; at < bytes.size(); at += block) {
      const std::string part = bytes.substr(at, block);
      uLongf size = compressBound(part.size());
      std::string packed(size, '\0');
      compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(part.data()),
               part.size());
      values.push_back(size);
      blocks += packed.substr(0, size);
    }
    return base64 ? encode(header(values)) + encode(blocks) : header(values) + blocks;
  }
  std::string array(const std::string& attributes, const std::string& text, const std::string& bytes) {
    const std::string begin = "<DataArray " + attributes + " format=\"";
    if (storage == Storage::kText) return begin + "ascii\">\n" + text + "\n</DataArray>\n";
    if (storage == Storage::kBase64) return begin + "binary\">\n  " + stored(bytes) + "\n</DataArray>\n";
    const std::string place = std::to_string(data.size());
    data += stored(bytes);
    return begin + "appended\" offset=\"" + place + "\"/>\n";
  }
  std::string file() {
    Bytes points(big), corners(big), ends(big);
    for (const double x : kPoints) points.add(static_cast<float>(x));
    for (const int v : kCorners) corners.add(std::int64_t{v});
    for (std::int32_t end = 3; end <= 12; end += 3) ends.add(end);
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"" +
                       std::string(big ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
                       (wide ? "UInt64" : "UInt32") + "\"" +
                       (compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
                       ">\n<PolyData>\n<Piece NumberOfPoints=\"4\" NumberOfPolys=\"4\">\n<Points>\n";
    text += array("type=\"Float32\" Name=\"Points\" NumberOfComponents=\"3\"", "0 0 0 1 0 0 0 1 0 0 0 1",
                  points.text);
    text += "</Points>\n<Polys>\n";
    text += array("type=\"Int64\" Name=\"connectivity\"", "0 2 1 0 1 3 1 2 3 2 0 3", corners.text);
    text += array("type=\"Int32\" Name=\"offsets\"", "3 6 9 12", ends.text);
    text += "</Polys>\n</Piece>\n</PolyData>\n";
    if (!data.empty())
      text += "<AppendedData encoding=\"" + std::string(storage == Storage::kRaw ? "raw" : "base64") +
              "\">\n _" + data + "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
  }
};

void check_refused(MeshFormat format, const std::string& text, const std::string& what) {
  test::check_refused(format, text, "", what);
}

}  // namespace

TEST_CASE("Legacy VTK: text and binary, counted cells and offsets, fields and metadata between") {
  check_tetrahedron(vtk(kLegacy));
  check_tetrahedron(vtk(kHead + "ASCII\nDATASET POLYDATA\n" + kPointsText + kOffsetsText));
  check_tetrahedron(vtk(replace_all(kLegacy, "\n", "\r\n")));
  check_tetrahedron(vtk(replace_all(kLegacy, "POINTS", "VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOINTS")));
  check_tetrahedron(vtk(kLegacy + "CELL_DATA 4\nanything"));
  check_tetrahedron(vtk(binary_legacy(false)));
  check_tetrahedron(vtk(binary_legacy(true)));
}

TEST_CASE("Triangle strips turn every second triangle round") {
  const std::string strip =
      kHead + "ASCII\nDATASET POLYDATA\n" + kPointsText + "TRIANGLE_STRIPS 1 7\n6 0 1 3 2 0 1\n";
  CHECK(vtk(strip).corners == std::vector<Index>{0, 1, 3, 3, 1, 2, 3, 2, 0, 0, 2, 1});
}

TEST_CASE("Legacy VTK: defects are refused") {
  const MeshFormat k = MeshFormat::kVtk;
  check_refused(k, replace_all(kLegacy, "POLYDATA", "UNSTRUCTURED_GRID"), "not POLYDATA");
  check_refused(k, replace_all(kLegacy, "3 2 0 3", "3 2 0 4"), "vertex index 4 is out of range");
  check_refused(k, replace_all(kLegacy, "3 2 0 3", "4 2 0 3"), "does not fit");
  check_refused(k, replace_all(kLegacy, "POINTS 4", "POINTS 2000000000"), "too many points");
  check_refused(k, replace_all(kLegacy, "POINTS 4", "POINTS 200000000"), "more than the file holds");
  check_refused(k, replace_all(kLegacy, "float", "string"), "unknown type");
  check_refused(k, replace_all(kLegacy, "0 0 1\n", "0 0 x\n"), "line 7");
  check_refused(k, replace_all(kLegacy, "ASCII", "EBCDIC"), "ASCII or BINARY");
  const std::string binary = binary_legacy(true);
  for (std::size_t size = 1; size < binary.find("POINT_DATA") - 1; ++size) try {
      const PolygonSoup cut = vtk(binary.substr(0, size));
      CHECK(cut.polygon_count() == 0);  // before the cells
    } catch (const ReadError&) {
    }
}

TEST_CASE("VTP: every way to store arrays gives the same mesh") {
  for (const Storage storage : {Storage::kText, Storage::kBase64, Storage::kRaw, Storage::kAppendedBase64})
    for (const bool compressed : {false, true})
      for (const bool big : {false, true})
        for (const bool wide : {false, true}) {
          VtpForm form{storage, compressed, big, wide};
          check_tetrahedron(vtp(form.file()));
        }
}

TEST_CASE("VTP: defects are refused, cut files do not crash") {
  const MeshFormat k = MeshFormat::kVtp;
  const std::string text = VtpForm{}.file();
  check_refused(k, replace_all(text, "2 0 3", "2 0 4"), "vertex index 4 is out of range");
  check_refused(k, replace_all(text, "3 6 9 12", "3 6 9 13"), "outside of the list");
  check_refused(k, replace_all(text, "3 6 9 12", "3 6 5 12"), "outside of the list");
  check_refused(k, replace_all(text, "0 2 1", "0 2 x"), "'connectivity' of Polys");
  check_refused(k, replace_all(text, "type=\"PolyData\"", "type=\"ImageData\""), "not PolyData");
  check_refused(k, replace_all(text, "</Points>", ""), "not well-formed");
  VtpForm raw{Storage::kRaw, true};
  const std::string packed = raw.file();
  check_refused(k, replace_all(packed, "ZLib", "LZ4"), "write it with ZLib");
  check_refused(k, replace_all(packed, "offset=\"0\"", "offset=\"99999\""), "beyond the appended data");
  for (std::size_t size = 0; size < packed.size(); size += 3) try {
      vtp(packed.substr(0, size));
    } catch (const ReadError&) {
    }
}

TEST_CASE("VTP: a block that claims to be large is refused before memory is taken") {
  VtpForm form{Storage::kRaw, true};
  std::string file = form.file();
  const std::size_t at = file.find("_") == std::string::npos ? 0 : file.find(" _") + 2;
  file.replace(at + 4, 4, Bytes(false).add(std::uint32_t{0xFFFFFFF0u}).text);  // the blocks' size
  file.replace(at + 8, 4, Bytes(false).add(std::uint32_t{0}).text);
  check_refused(MeshFormat::kVtp, file, "grow to more than");
}

TEST_CASE("VTK and VTP files with random edits are read or refused") {
  test::check_edits(MeshFormat::kVtk, kLegacy);
  test::check_edits(MeshFormat::kVtk, binary_legacy(false));
  test::check_edits(MeshFormat::kVtk, binary_legacy(true));
  for (const Storage storage : {Storage::kText, Storage::kBase64, Storage::kRaw, Storage::kAppendedBase64}) {
    VtpForm form{storage, storage != Storage::kText};
    test::check_edits(MeshFormat::kVtp, form.file());
  }
}
