// What becomes of clean meshes on their way to users: torn, turned, taken apart, doubled, pinched, spoilt.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "mspskel/mesh/polygon_soup.h"
#include "support/meshes.h"

namespace mspskel::test {

// ---- Faces that go

// Those faces f for which keep(f) holds.
template <class Keep>
PolygonSoup with_faces(const PolygonSoup& soup, Keep keep) {
  PolygonSoup result;
  result.points = soup.points;
  for (Index f = 0; f < static_cast<Index>(soup.polygon_count()); ++f) {
    if (!keep(f)) continue;
    result.corners.insert(result.corners.end(), soup.corners.begin() + soup.begin[f],
                          soup.corners.begin() + soup.begin[f + 1]);
    result.begin.push_back(static_cast<Index>(result.corners.size()));
  }
  return result;
}

// Of triangles those for whose middle drop() does not hold.
template <class Predicate>
PolygonSoup without_faces(const PolygonSoup& soup, Predicate drop) {
  return with_faces(soup, [&](Index f) {
    const Index* c = soup.corners.data() + soup.begin[f];
    return !drop(Vector3((soup.points[c[0]] + soup.points[c[1]] + soup.points[c[2]]) / 3));
  });
}

// Holes round points of the mesh, of about a share of its faces each.
inline PolygonSoup without_patches(const PolygonSoup& soup, Index patches, double share, Random random) {
  const auto faces = static_cast<Index>(soup.polygon_count());
  std::vector<char> gone(static_cast<std::size_t>(faces), 0);
  for (Index i = 0; i < patches && faces > 0; ++i) {
    const Vector3 centre = soup.points[soup.corners[soup.begin[random.below(faces)]]];
    std::vector<std::pair<double, Index>> order;
    for (Index f = 0; f < faces; ++f) {
      const double distance = (soup.points[soup.corners[soup.begin[f]]] - centre).squaredNorm();
      order.emplace_back(std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance, f);
    }
    std::sort(order.begin(), order.end());
    const auto size = std::min(faces, 1 + static_cast<Index>(share * faces));
    for (Index k = 0; k < size; ++k) gone[order[k].second] = 1;
  }
  return with_faces(soup, [&](Index f) { return !gone[f]; });
}

// ---- Faces that change

inline PolygonSoup with_turned_faces(PolygonSoup soup, double share, Random random) {
  for (std::size_t f = 0; f < soup.polygon_count(); ++f)
    if (random.uniform() < share)
      std::reverse(soup.corners.begin() + soup.begin[f], soup.corners.begin() + soup.begin[f + 1]);
  return soup;
}

// Every face gets points of its own.
inline PolygonSoup split(const PolygonSoup& soup) {
  PolygonSoup result;
  result.begin = soup.begin;
  for (const Index v : soup.corners) {
    result.corners.push_back(static_cast<Index>(result.points.size()));
    result.points.push_back(soup.points[v]);
  }
  return result;
}

// Of triangles: split, and each drawn in by a share of the way to its middle.
inline PolygonSoup drawn_in(const PolygonSoup& soup, double share) {
  PolygonSoup loose = split(soup);
  for (std::size_t i = 0; i < loose.points.size(); i += 3) {
    Vector3 middle = Vector3::Zero();
    for (std::size_t k = i; k < i + 3; ++k) middle += loose.points[k] / 3;
    for (std::size_t k = i; k < i + 3; ++k) loose.points[k] = (1 - share) * loose.points[k] + share * middle;
  }
  return loose;
}

// The triangles round some vertices become one polygon, which is not flat and may have many corners.
inline PolygonSoup with_polygons(const PolygonSoup& soup, double share, Random random) {
  std::vector<std::map<Index, Index>> next(soup.points.size());  // round each vertex
  for (std::size_t i = 0; i + 2 < soup.corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k)
      next[soup.corners[i + k]][soup.corners[i + (k + 1) % 3]] = soup.corners[i + (k + 2) % 3];
  std::vector<char> taken(soup.polygon_count(), 0), is_hub(soup.points.size(), 0);
  std::vector<Index> added, ends;
  for (std::size_t v = 0; v < next.size(); ++v) {
    if (next[v].size() < 3 || random.uniform() > share) continue;
    if (std::any_of(next[v].begin(), next[v].end(), [&](const auto& step) { return is_hub[step.first]; }))
      continue;
    std::vector<Index> ring;
    for (Index at = next[v].begin()->first; ring.size() < next[v].size(); at = next[v][at]) {
      if (next[v].count(at) == 0) break;
      ring.push_back(at);
    }
    if (ring.size() < next[v].size()) continue;
    is_hub[v] = 1;
    added.insert(added.end(), ring.begin(), ring.end());
    ends.push_back(static_cast<Index>(added.size()));
  }
  PolygonSoup result = with_faces(soup, [&](Index f) {
    return std::none_of(soup.corners.begin() + soup.begin[f], soup.corners.begin() + soup.begin[f + 1],
                        [&](Index v) { return is_hub[v]; });
  });
  const auto first = static_cast<Index>(result.corners.size());
  result.corners.insert(result.corners.end(), added.begin(), added.end());
  for (const Index end : ends) result.begin.push_back(first + end);
  return result;
}

// ---- Faces that are too many

// Some twice or more often, turned either way, in any order.
inline PolygonSoup with_repeated_faces(const PolygonSoup& soup, double share, Random random) {
  std::vector<Index> order;
  for (Index f = 0; f < static_cast<Index>(soup.polygon_count()); ++f)
    for (order.push_back(f); random.uniform() < share;) order.push_back(f);
  PolygonSoup result;
  result.points = soup.points;
  for (const Index i : permutation(static_cast<Index>(order.size()), random)) {
    const auto begin = soup.corners.begin() + soup.begin[order[i]],
               end = soup.corners.begin() + soup.begin[order[i] + 1];
    std::vector<Index> face(begin, end);
    if (random.below(3) == 0) std::reverse(face.begin(), face.end());
    result.corners.insert(result.corners.end(), face.begin(), face.end());
    result.begin.push_back(static_cast<Index>(result.corners.size()));
  }
  return result;
}

// Triangles between corners that the soup has, or on one of its edges with a point of their own.
inline PolygonSoup with_fins(PolygonSoup soup, Index count, double reach, Random random) {
  if (soup.corners.empty()) return soup;
  const auto faces = static_cast<Index>(soup.polygon_count());
  const auto corner = [&] { return soup.corners[soup.begin[random.below(faces)]]; };
  for (Index i = 0; i < count; ++i) {
    const Index f = random.below(faces), size = soup.begin[f + 1] - soup.begin[f], k = random.below(size);
    const Index a = soup.corners[soup.begin[f] + k], b = soup.corners[soup.begin[f] + (k + 1) % size];
    if (random.below(2)) {
      soup.add_triangle(a, b, corner());
      continue;
    }
    soup.points.push_back((soup.points[a] + soup.points[b]) / 2 + reach * random.in_ball());
    soup.add_triangle(a, b, static_cast<Index>(soup.points.size()) - 1);
  }
  return soup;
}

// ---- Points

// Some corners become others, by number: pinched vertices and edges, faces without area.
inline PolygonSoup with_merged_points(PolygonSoup soup, Index count, Random random) {
  if (soup.corners.empty()) return soup;
  std::vector<Index> stands_for(soup.points.size());
  for (std::size_t v = 0; v < stands_for.size(); ++v) stands_for[v] = static_cast<Index>(v);
  for (Index i = 0; i < count; ++i) {
    const Index from = random.below(static_cast<Index>(stands_for.size()));
    stands_for[from] = random.below(static_cast<Index>(stands_for.size()));
  }
  for (Index& v : soup.corners) v = stands_for[v];
  return soup;
}

// Coordinates that no measurement has.
inline PolygonSoup with_spoilt_points(PolygonSoup soup, Index count, Random random) {
  using Limits = std::numeric_limits<double>;
  const double values[] = {Limits::quiet_NaN(),
                           Limits::infinity(),
                           -Limits::infinity(),
                           Limits::max(),
                           -Limits::max(),
                           1e200,
                           1e-200,
                           Limits::denorm_min(),
                           Limits::min(),
                           -0.0,
                           1e30,
                           1e-30};
  for (Index i = 0; i < count && !soup.points.empty(); ++i) {
    const auto axis = static_cast<std::size_t>(random.below(3));
    Vector3& p = soup.points[random.below(static_cast<Index>(soup.points.size()))];
    p[axis] = values[random.below(12)];
  }
  return soup;
}

}  // namespace mspskel::test
