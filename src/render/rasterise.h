// What a band of sample rows of one view sees: the nearest face, everything behind it, and the nearest tube
// or ball.
#pragma once

#include <array>
#include <vector>

#include "camera.h"

namespace mspskel::render_detail {

// Seen from a camera, a straight tube with round ends; a ball if both ends are one point.
struct Tube {
  Vector3 begin, end;  // in samples, see Camera
  double radius;       // samples
  Color color;
};

// One view of the scene: projected points, and what to look at in each band.
struct View {
  Camera camera;
  std::vector<Vector3> points;  // of the surface, projected
  std::vector<Tube> tubes;
  int band_rows = 1, margin = 0;  // in samples; a band looks `margin` rows beyond its own
  std::vector<Index> band_begin,
      band_triangle;  // triangles band_triangle[band_begin[b]] .. in ascending order
};

View make_view(const DrawSurface& surface, const Camera& camera, int band_rows, int margin, int band_count);

struct Band {
  int width = 0, row_begin = 0, row_end = 0;  // in samples, margins included
  std::vector<float> depth;                   // of the nearest face; infinite: none
  std::vector<Index> triangle;                // the nearest face; kNone
  std::vector<Eigen::Vector3f> normal;        // there, camera axes, towards the viewer
  std::vector<float> rim;                     // sum over all faces of how edge-on they are, 0 to 1 each
  std::vector<float> tube_depth;              // infinite: none
  std::vector<Index> tube;                    // kNone
  std::vector<Eigen::Vector3f> tube_normal;

  void clear(int band_width, int begin, int end);
  std::size_t index(int x, int row) const {
    return static_cast<std::size_t>(row - row_begin) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

// How edge-on a face is at a point, from its unit normal there.
inline float rim_of(float normal_z) {
  const float f = 1.0f - std::min(1.0f, std::abs(normal_z));
  return f * f * f;
}

// Barycentric coordinates of the sample (x, y) in the projected triangle; area: twice its signed area.
std::array<double, 3> barycentric(const std::array<const Vector3*, 3>& p, double area, double x, double y);
double twice_area(const std::array<const Vector3*, 3>& p);

void draw_triangles(const DrawSurface& surface, const View& view, int band_number, Band& band);
void draw_tubes(const View& view, Band& band);

}  // namespace mspskel::render_detail
