#include "draw_apart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mspskel/repair/separate_points.h"
#include "weld_points.h"

namespace mspskel {
namespace detail {
namespace {

struct Surroundings {
  Vector3 normal = Vector3::Zero();                           // sum over the faces, by area
  Vector3 outward = Vector3::Zero();                          // sum of the ways to the neighbours
  double shortest = std::numeric_limits<double>::infinity();  // edge that has a length
};

std::vector<Surroundings> surroundings_of(const FaceSet& faces, const std::vector<Index>& vertices,
                                          const std::vector<Vector3>& positions) {
  std::vector<Index> place(positions.size(), kNone);
  for (std::size_t i = 0; i < vertices.size(); ++i) place[vertices[i]] = static_cast<Index>(i);
  std::vector<Surroundings> all(vertices.size());
  for (Index h = 0; h < static_cast<Index>(faces.corners.size()); ++h) {
    const Index i = place[faces.corners[h]];
    if (i == kNone) continue;
    all[i].normal += area_vector(positions, faces, h / 3);
    for (const Index end : {faces.target(h), faces.origin(FaceSet::prev(h))}) {
      const Vector3 way = positions[end] - positions[vertices[i]];
      all[i].outward += way;
      if (way.norm() > 0) all[i].shortest = std::min(all[i].shortest, way.norm());
    }
  }
  return all;
}

// Well spread over the sphere, and another for each number: the points of a spiral by the golden angle.
Vector3 spread_direction(Index number) {
  const double turn = 2.399963229728653 * number,
               height = 2 * std::fmod(0.6180339887498949 * number, 1.0) - 1;
  const double across = std::sqrt(1 - height * height);
  return {across * std::cos(turn), across * std::sin(turn), height};
}

std::vector<Index> coincident_vertices(const std::vector<Vector3>& positions) {
  const std::vector<Index> first = weld_equal_points(positions);
  std::vector<Index> coincident;
  for (Index v = 0; v < static_cast<Index>(first.size()); ++v)
    if (first[v] != v) coincident.push_back(v);
  return coincident;
}

double longest_side(const std::vector<Vector3>& positions) {
  Eigen::AlignedBox3d box;
  for (const Vector3& p : positions) box.extend(p);
  return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

// As nudge, and in steps of `least` where the neighbours give no way.
void move(const FaceSet& faces, const std::vector<Index>& vertices, double share, double least, Way where,
          std::vector<Vector3>& positions) {
  const std::vector<Surroundings> all = surroundings_of(faces, vertices, positions);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Vector3 way = where == Way::kIntoVoid ? all[i].normal : Vector3(-all[i].normal);
    if (where == Way::kToNeighbours || way.norm() == 0) way = all[i].outward;
    if (way.norm() > 0)
      positions[vertices[i]] += share * all[i].shortest * way.normalized();
    else
      positions[vertices[i]] += least * spread_direction(vertices[i]);
  }
}

}  // namespace

void nudge(const FaceSet& faces, const std::vector<Index>& vertices, double share, Way where,
           std::vector<Vector3>& positions) {
  move(faces, vertices, share, 0, where, positions);
}

void draw_apart(const FaceSet& faces, const std::vector<Index>& vertices, std::vector<Vector3>& positions) {
  constexpr double kShare = 1e-3, kLeast = 1e-9;  // of the shortest edge, and of the extent
  constexpr int kRounds = 16;
  const double least = kLeast * longest_side(positions);
  move(faces, vertices, kShare, least, Way::kIntoMaterial, positions);
  for (int round = 1; round <= kRounds; ++round) {
    const std::vector<Index> coincident = coincident_vertices(positions);
    if (coincident.empty()) return;
    move(faces, coincident, round * kShare, least, Way::kToNeighbours, positions);
  }
}

}  // namespace detail

PolygonSoup separate_points(PolygonSoup soup) {
  detail::FaceSet faces;
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    const Index first = soup.begin[f], last = soup.begin[f + 1];
    for (Index i = first + 1; i + 1 < last; ++i)
      faces.add(soup.corners[first], soup.corners[i], soup.corners[i + 1], static_cast<Index>(f));
  }
  detail::draw_apart(faces, {}, soup.points);
  return soup;
}

}  // namespace mspskel
