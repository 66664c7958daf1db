#include "clean_faces.h"

#include <algorithm>

#include "../mesh/triangulate.h"

namespace mspskel::detail {
namespace {

// Collects the simple parts of closed walks over points.
class SimpleParts {
 public:
  SimpleParts(const PolygonSoup& soup, const std::vector<Index>& point_of)
      : soup_(soup), point_of_(point_of), place_(point_of.size(), kNone) {}

  // Appends the parts of polygon f to `parts`; the number of them.
  Index split(Index f, PolygonSoup& parts) {
    walk_.clear();
    Index count = 0;
    if (!usable(f)) return count;
    for (Index i = soup_.begin[f]; i < soup_.begin[f + 1]; ++i) {
      const Index p = point_of_[soup_.corners[i]];
      if (place_[p] != kNone) count += cut_off(place_[p], parts);
      place_[p] = static_cast<Index>(walk_.size());
      walk_.push_back(p);
    }
    return count + cut_off(0, parts);
  }

 private:
  bool usable(Index f) const {
    const auto points = static_cast<Index>(soup_.points.size());
    return std::all_of(soup_.corners.begin() + soup_.begin[f], soup_.corners.begin() + soup_.begin[f + 1],
                       [&](Index v) { return v >= 0 && v < points && soup_.points[v].allFinite(); });
  }
  // Takes the walk from `begin` on away, as a part of its own if it is a polygon.
  Index cut_off(Index begin, PolygonSoup& parts) {
    const bool polygon = static_cast<Index>(walk_.size()) - begin >= 3;
    if (polygon) {
      parts.corners.insert(parts.corners.end(), walk_.begin() + begin, walk_.end());
      parts.begin.push_back(static_cast<Index>(parts.corners.size()));
    }
    for (auto p = walk_.begin() + begin; p != walk_.end(); ++p) place_[*p] = kNone;
    walk_.resize(begin);
    return polygon ? 1 : 0;
  }

  const PolygonSoup& soup_;
  const std::vector<Index>& point_of_;
  std::vector<Index> place_;  // of a point in the walk
  std::vector<Index> walk_;
};

}  // namespace

FaceSet clean_faces(const PolygonSoup& soup, const std::vector<Index>& point_of, Index& degenerate) {
  PolygonSoup simple;
  simple.points = soup.points;
  std::vector<Index> source;
  SimpleParts parts(soup, point_of);
  degenerate = 0;
  for (Index f = 0; f < static_cast<Index>(soup.polygon_count()); ++f) {
    const Index count = parts.split(f, simple);
    source.insert(source.end(), count, f);
    degenerate += count == 0;
  }
  const Triangulation triangulation = triangulate(simple);
  FaceSet faces;
  faces.corners = triangulation.corners;
  faces.polygon.resize(faces.corners.size() / 3);
  for (Index t = 0; t < faces.count(); ++t) faces.polygon[t] = source[triangulation.polygon(t)];
  return faces;
}

}  // namespace mspskel::detail
