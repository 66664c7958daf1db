#include "whole_pieces.h"

#include <algorithm>

#include "disjoint_sets.h"

namespace mspskel::detail {

WholePieces without_crumbs(const PolygonSoup& soup, double pocket) {
  constexpr double kCrumb = 0.025;  // of the largest extent
  const auto points = static_cast<Index>(soup.points.size());
  DisjointSets sets(points);
  for (std::size_t i = 0; i < soup.corners.size(); i += 3)
    for (const std::size_t k : {i + 1, i + 2}) sets.unite(soup.corners[i], soup.corners[k]);
  std::vector<Vector3> low(soup.points), high(soup.points);
  std::vector<Index> euler(soup.points.size(), 0);  // twice
  std::vector<double> volume(soup.points.size(), 0.0);
  for (Index v = 0; v < points; ++v) {
    const Index piece = sets.root(v);
    low[piece] = low[piece].cwiseMin(soup.points[v]);
    high[piece] = high[piece].cwiseMax(soup.points[v]);
    euler[piece] += 2;
  }
  double largest = 0;
  for (Index v = 0; v < points; ++v) largest = std::max(largest, (high[v] - low[v]).norm());
  for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
    const Index piece = sets.root(soup.corners[i]);
    --euler[piece];
    const auto at = [&](std::size_t k) { return Vector3(soup.points[soup.corners[k]] - soup.points[piece]); };
    volume[piece] += at(i).dot(at(i + 1).cross(at(i + 2)));
  }
  double solid = 0;
  for (const double v : volume) solid += std::max(0.0, v);
  const auto is_crumb = [&](Index piece) {
    return (high[piece] - low[piece]).norm() < kCrumb * largest ||
           (volume[piece] < 0 && -volume[piece] < pocket * solid);
  };
  WholePieces kept;
  std::vector<Index> vertex(soup.points.size(), kNone);
  for (std::size_t i = 0; i < soup.corners.size(); i += 3) {
    if (is_crumb(sets.root(soup.corners[i]))) continue;
    for (std::size_t k = i; k < i + 3; ++k) {
      Index& v = vertex[soup.corners[k]];
      if (v == kNone) {
        v = static_cast<Index>(kept.soup.points.size());
        kept.soup.points.push_back(soup.points[soup.corners[k]]);
      }
      kept.soup.corners.push_back(v);
    }
    kept.soup.begin.push_back(static_cast<Index>(kept.soup.corners.size()));
  }
  for (Index v = 0; v < points; ++v) {
    if (sets.root(v) != v) continue;
    if (vertex[v] == kNone) {
      ++kept.crumbs;
      continue;
    }
    kept.genus += (4 - euler[v]) / 4;
    ++(volume[v] > 0 ? kept.solids : kept.cavities);
  }
  return kept;
}

}  // namespace mspskel::detail
