#include "mspskel/samples/polygonise.h"

#include <array>
#include <cmath>
#include <unordered_map>

#include "mspskel/base/error.h"
#include "mspskel/samples/shapes.h"
#include "surface_area.h"
#include "tetrahedron_cut.h"

namespace mspskel {

namespace {

using Cell = std::array<std::int64_t, 3>;
constexpr int kBlock = 4;  // cells along the side of the smallest cube that is skipped or visited as a whole
constexpr int kSide = kBlock + 1;

// The six tetrahedra of a cube: one for each order of the axes, from corner 000 to corner 111; corners as
// bits xyz. Neighbouring cubes cut their common face along the same diagonal. All have positive orientation.
constexpr std::array<std::array<int, 4>, 6> kKuhn{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}, {0, 5, 1, 7}}};

class March {
 public:
  March(const ImplicitSolid& solid, double cell) : solid_(solid), cell_(cell) {
    const Vector3 span = solid.high - solid.low;
    std::int64_t blocks = 1;
    while (static_cast<double>(blocks * kBlock) * cell < span.maxCoeff() + 2 * cell) blocks *= 2;
    if (blocks * kBlock > (1 << 20)) throw UsageError("the resolution is too high for the solid's size");
    side_ = blocks * kBlock + 1;
    // The shift keeps symmetric solids from meeting grid points exactly.
    origin_ = solid.low - cell * Vector3(0.8190, 0.7548, 0.6710);
    visit({0, 0, 0}, blocks * kBlock);
  }
  PolygonSoup result() { return std::move(soup_); }

 private:
  Vector3 at(const Cell& c) const {
    return origin_ +
           cell_ * Vector3(static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2]));
  }

  // An octree of cubes: where the function's value exceeds the way to the corner there is no surface.
  void visit(const Cell& low, std::int64_t size) {
    const double half = 0.5 * cell_ * static_cast<double>(size);
    const double center = solid_.value(at(low) + Vector3::Constant(half));
    if (std::abs(center) > 1.0001 * std::sqrt(3.0) * half) return;
    if (size == kBlock) return march_block(low);
    for (int k = 0; k < 8; ++k)
      visit({low[0] + (k & 1) * size / 2, low[1] + (k >> 1 & 1) * size / 2, low[2] + (k >> 2) * size / 2},
            size / 2);
  }

  void march_block(const Cell& low) {
    std::array<double, kSide * kSide * kSide> value;
    std::size_t i = 0;
    for (int z = 0; z < kSide; ++z)
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) value[i++] = solid_.value(at({low[0] + x, low[1] + y, low[2] + z}));
    for (int z = 0; z < kBlock; ++z)
      for (int y = 0; y < kBlock; ++y)
        for (int x = 0; x < kBlock; ++x) {
          std::array<double, 8> corner;
          for (int k = 0; k < 8; ++k)
            corner[k] = value[((z + (k >> 2)) * kSide + y + (k >> 1 & 1)) * kSide + x + (k & 1)];
          march_cube({low[0] + x, low[1] + y, low[2] + z}, corner);
        }
  }

  void march_cube(const Cell& low, const std::array<double, 8>& value) {
    int inside = 0;
    for (const double v : value) inside += v < 0;
    if (inside == 0 || inside == 8) return;
    for (const auto& tetrahedron : kKuhn) march_tetrahedron(low, value, tetrahedron);
  }

  void march_tetrahedron(const Cell& low, const std::array<double, 8>& value,
                         const std::array<int, 4>& corners) {
    std::array<double, 4> at_corners;
    for (std::size_t k = 0; k < 4; ++k) at_corners[k] = value[corners[k]];
    detail::cut_tetrahedron(soup_, at_corners,
                            [&](int i, int j) { return vertex(low, value, corners[i], corners[j]); });
  }

  // The vertex on the edge between two corners of a cube, made once. An edge is its lower corner and its
  // direction.
  Index vertex(const Cell& low, const std::array<double, 8>& value, int a, int b) {
    if (a > b) std::swap(a, b);  // along each edge of the pattern bits are only added
    const Cell from{low[0] + (a & 1), low[1] + (a >> 1 & 1), low[2] + (a >> 2)};
    const std::int64_t key = ((from[2] * side_ + from[1]) * side_ + from[0]) * 8 + (a ^ b);
    const auto [place, is_new] = vertex_.try_emplace(key, static_cast<Index>(soup_.points.size()));
    if (is_new) {
      const Cell to{low[0] + (b & 1), low[1] + (b >> 1 & 1), low[2] + (b >> 2)};
      soup_.points.push_back(detail::cut_point(at(from), value[a], at(to), value[b]));
    }
    return place->second;
  }

  const ImplicitSolid& solid_;
  double cell_;
  std::int64_t side_ = 0;
  Vector3 origin_;
  std::unordered_map<std::int64_t, Index> vertex_;
  PolygonSoup soup_;
};

// Whether a face looks against the function's growth at all three corners together: where triangles are too
// large for a thin part, remeshing can turn one over.
bool is_folded(const PolygonSoup& soup, const ImplicitSolid& solid, const RemeshOptions& options) {
  std::vector<Vector3> up;
  for (const Vector3& p : soup.points) {
    const double step = 0.02 * options.edge * (options.by_width ? solid.width(p) : 1.0);
    Vector3 gradient;
    for (Eigen::Index k = 0; k < 3; ++k)
      gradient[k] = solid.value(p + step * Vector3::Unit(k)) - solid.value(p - step * Vector3::Unit(k));
    up.push_back(gradient);
  }
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const Index p = soup.corners[c], q = soup.corners[c + 1], r = soup.corners[c + 2];
    const Vector3 normal = (soup.points[q] - soup.points[p]).cross(soup.points[r] - soup.points[p]);
    if (!(normal.dot(up[p] + up[q] + up[r]) > 0)) return true;
  }
  return false;
}

// Now and then a face gets stuck the wrong way round in a crease; from another grid it does not.
PolygonSoup remeshed(PolygonSoup soup, const ImplicitSolid& solid, const RemeshOptions& options, double cell,
                     PolygonSoup (*march)(const ImplicitSolid&, double)) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    PolygonSoup result = remesh(soup, solid, options);
    if (!is_folded(result, solid, options)) return result;
    cell *= 0.85;
    soup = march(solid, cell);
  }
  throw UsageError("the resolution is too low for the solid's thinnest parts");
}

constexpr double kThickestCell = 0.8;  // of the width: a limb's section has some ten triangles at least

double area_in_widths(const PolygonSoup& soup, const ImplicitSolid& solid) {
  double sum = 0;
  for (std::size_t c = 0; c < soup.corners.size(); c += 3) {
    const Vector3 &a = soup.points[soup.corners[c]], &b = soup.points[soup.corners[c + 1]],
                  &d = soup.points[soup.corners[c + 2]];
    const double width = solid.width((a + b + d) / 3);
    sum += (b - a).cross(d - a).norm() / 2 / (width * width);
  }
  return sum;
}

}  // namespace

PolygonSoup march_tetrahedra(const ImplicitSolid& solid, double cell) {
  if (!(cell > 0) || !std::isfinite(cell)) throw UsageError("cell must be a positive number");
  return March(solid, cell).result();
}

PolygonSoup polygonise(const ImplicitSolid& solid, Index vertices, double thinnest) {
  double cell = thinnest;
  PolygonSoup soup;
  RemeshOptions options;
  for (int attempt = 0; attempt < 4; ++attempt) {
    soup = march_tetrahedra(solid, cell);
    if (soup.points.empty()) throw UsageError("the resolution is too low to see the solid");
    // Remeshing ends with edges a little shorter than asked for.
    options.edge = 1.08 * edge_for_vertices(detail::surface_area(soup), vertices);
    const double wanted = std::min(thinnest, options.edge);
    if (wanted > 0.75 * cell) break;
    cell = wanted;
  }
  return remeshed(std::move(soup), solid, options, cell, &march_tetrahedra);
}

PolygonSoup polygonise_by_width(const ImplicitSolid& solid, Index vertices) {
  RemeshOptions options;
  options.by_width = true;
  PolygonSoup soup = march_by_width(solid, kThickestCell);
  if (soup.points.empty()) throw UsageError("the resolution is too low to see the solid");
  // Remeshing ends with edges a little shorter than asked for.
  options.edge = 1.08 * edge_for_vertices(area_in_widths(soup, solid), vertices);
  return remeshed(std::move(soup), solid, options, kThickestCell, &march_by_width);
}

}  // namespace mspskel
