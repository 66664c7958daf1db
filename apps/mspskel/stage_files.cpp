#include "stage_files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/write_mesh.h"

namespace mspskel::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNames[] = {"msp.csv",           "msp_initial.ply", "msp.ply",
                                  "error_initial.ply", "error.ply",       "skeleton_mesh.ply"};

// A folder that goes again, with the files that were noted, unless it is kept.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& folder) {
    std::error_code failure;
    fs::path part = fs::absolute(folder, failure).lexically_normal();
    for (; !part.empty() && !fs::exists(part, failure); part = part.parent_path()) made_.push_back(part);
    fs::create_directories(folder, failure);
    if (failure) throw WriteError("cannot make the folder " + folder.string() + ": " + failure.message());
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder() {
    if (kept_) return;
    std::error_code ignored;
    for (const fs::path& file : files_) fs::remove(file, ignored);
    for (const fs::path& part : made_) fs::remove(part, ignored);  // not if there is more in it
  }
  // A file that is about to be made; one that is replaced stays.
  void note(const fs::path& file) {
    std::error_code ignored;
    if (!fs::exists(file, ignored)) files_.push_back(file);
  }
  void keep() { kept_ = true; }

 private:
  std::vector<fs::path> made_;  // the innermost first
  std::vector<fs::path> files_;
  bool kept_ = false;
};

// Lines of comma-separated numbers, the shortest that read back the same.
class CsvText {
 public:
  explicit CsvText(const std::string& header) : text_(header + "\n") {}
  template <class Number>
  CsvText& operator<<(Number x) {
    if (!std::isfinite(static_cast<double>(x)))
      throw NoSkeletonError("a slice or skeletal point has a number that is not finite");
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
    if (!text_.empty() && text_.back() != '\n') text_ += ',';
    text_.append(digits, end);
    return *this;
  }
  CsvText& operator<<(const Vector3& x) { return *this << x.x() << x.y() << x.z(); }
  void end_line() { text_ += '\n'; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string msp_csv(const ExtractResult& result) {
  const VertexSlices &first = result.initial_slices, &last = result.slices;
  const NormalisedFrame& frame = result.surface.frame;
  CsvText csv(
      "vertex,msp_initial,msp,error_initial,error,normal_x,normal_y,normal_z,contour_points,refined,"
      "center_x,center_y,center_z");
  for (Index v = 0; v < result.surface.vertex_count(); ++v) {
    const Vector3 centre = last.valid[v] ? frame.to_model(last.centre[v]) : Vector3::Zero();
    csv << v << frame.scale * first.perimeter[v] << frame.scale * last.perimeter[v] << first.error[v]
        << last.error[v] << last.normal[v] << last.contour_points[v] << static_cast<int>(last.refined[v])
        << centre;
    csv.end_line();
  }
  return csv.text();
}

PolygonSoup moved_mesh(const SurfaceSnapshot& surface, const std::vector<Vector3>& positions) {
  PolygonSoup soup;
  for (const Vector3& x : positions) soup.points.push_back(surface.frame.to_model(x));
  for (Index h = 0; h < surface.halfedge_count(); h += 3)
    soup.add_triangle(surface.origin[h], surface.origin[h + 1], surface.origin[h + 2]);
  return soup;
}

}  // namespace

std::vector<std::string> stage_file_paths(const std::string& folder) {
  std::vector<std::string> paths;
  for (const char* name : kNames) paths.push_back((fs::path(folder) / name).string());
  return paths;
}

void write_stage_files(const std::string& folder, const ExtractResult& result) {
  NewFolder made(folder);
  const auto path = [&](const char* name) {
    const fs::path file = fs::path(folder) / name;
    made.note(file);
    return file.string();
  };
  write_file_atomically(path("msp.csv"), msp_csv(result));

  const PolygonSoup mesh = moved_mesh(result.surface, result.surface.position);
  const auto write_coloured = [&](const char* name, const std::vector<double>& values, double low,
                                  double high) {
    WriteMeshOptions options;
    options.vertex_colors = color_by_value(values, low, high);
    write_mesh(path(name), mesh, options);
  };
  // One scale for both, so that the two pictures compare.
  const auto& msp = result.initial_slices.perimeter;
  const auto [low, high] = std::minmax_element(msp.begin(), msp.end());
  write_coloured("msp_initial.ply", msp, *low, *high);
  write_coloured("msp.ply", result.slices.perimeter, *low, *high);
  write_coloured("error_initial.ply", result.initial_slices.error, 0, 1);
  write_coloured("error.ply", result.slices.error, 0, 1);
  write_mesh(path("skeleton_mesh.ply"), moved_mesh(result.surface, result.skeleton_mesh.position));
  made.keep();
}

}  // namespace mspskel::cli
