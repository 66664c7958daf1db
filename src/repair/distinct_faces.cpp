#include "distinct_faces.h"

#include <algorithm>
#include <array>

#include "../mesh/edge_table.h"
#include "disjoint_sets.h"

namespace mspskel::detail {
namespace {

struct Corners {
  std::array<Index, 3> sorted;
  Index face;
  bool even;  // the corners run as the sorted ones do
};

std::vector<Corners> sorted_corners(const FaceSet& faces) {
  std::vector<Corners> all(faces.count());
  for (Index f = 0; f < faces.count(); ++f) {
    std::array<Index, 3> c{faces.corners[3 * f], faces.corners[3 * f + 1], faces.corners[3 * f + 2]};
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    const bool even = c[1] < c[2];
    if (!even) std::swap(c[1], c[2]);
    all[f] = {c, f, even};
  }
  std::sort(all.begin(), all.end(), [](const Corners& a, const Corners& b) {
    return a.sorted != b.sorted ? a.sorted < b.sorted : a.face < b.face;
  });
  return all;
}

// Keeps one face of each group of copies; marks those of which as many are turned either way.
void keep_one_copy(const FaceSet& faces, std::vector<char>& keep, std::vector<char>& two_sided,
                   MendCounts& counts) {
  const std::vector<Corners> all = sorted_corners(faces);
  for (std::size_t i = 0, j; i < all.size(); i = j) {
    Index even = 0;
    for (j = i; j < all.size() && all[j].sorted == all[i].sorted; ++j) even += all[j].even;
    const auto copies = static_cast<Index>(j - i);
    const bool wanted = 2 * even == copies ? all[i].even : 2 * even > copies;
    for (std::size_t k = i; k < j; ++k) {
      if (all[k].even != wanted) continue;
      keep[all[k].face] = 1;
      two_sided[all[k].face] = 2 * even == copies;
      break;
    }
    counts.repeated_faces += copies - 1;
  }
}

}  // namespace

DistinctFaces distinct_faces(const FaceSet& faces, Index point_count, MendCounts& counts) {
  std::vector<char> keep(faces.count(), 0), marked(faces.count(), 0);
  keep_one_copy(faces, keep, marked, counts);
  if (counts.repeated_faces == 0) return {faces, {}};
  const FaceSet distinct = kept_faces(faces, keep);
  std::vector<char> two_sided;
  for (Index f = 0; f < faces.count(); ++f)
    if (keep[f]) two_sided.push_back(marked[f]);

  const EdgeTable edges(point_count, distinct.corners);
  DisjointSets groups(distinct.count());
  edges.each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd* last) {
    Index one = kNone;
    for (const HalfedgeEnd* e = first; e != last; ++e) {
      if (!two_sided[e->halfedge / 3]) continue;
      if (one != kNone) groups.unite(one, e->halfedge / 3);
      one = e->halfedge / 3;
    }
  });
  // Positive: more of the group's outer edges close without it.
  std::vector<Index> votes(distinct.count(), 0);
  edges.each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd* last) {
    const auto own =
        std::count_if(first, last, [&](const HalfedgeEnd& e) { return two_sided[e.halfedge / 3]; });
    const auto others = (last - first) - own;
    if (own % 2 == 0 || others == 0) return;
    for (const HalfedgeEnd* e = first; e != last; ++e)
      if (two_sided[e->halfedge / 3]) votes[groups.root(e->halfedge / 3)] += others % 2 == 0 ? 1 : -1;
  });
  std::vector<char> wanted(distinct.count(), 1), cancelled(distinct.count(), 0);
  for (Index f = 0; f < distinct.count(); ++f)
    if (two_sided[f] && votes[groups.root(f)] > 0) {
      wanted[f] = 0;
      cancelled[f] = 1;
    }
  DistinctFaces result{kept_faces(distinct, wanted), kept_faces(distinct, cancelled)};
  counts.two_sided_faces += result.cancelled.count();
  counts.repeated_faces -= result.cancelled.count();
  return result;
}

namespace {

class Flaps {
 public:
  Flaps(const std::vector<Vector3>& points, const FaceSet& faces)
      : faces_(faces),
        edges_(static_cast<Index>(points.size()), faces.corners),
        patches_(faces.count()),
        edge_of_(faces.corners.size(), kNone),
        area_(faces.count(), 0.0),
        keep_(faces.count(), 1) {
    edges_.each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd* last) {
      if (last - first == 2) {
        patches_.unite(first[0].halfedge / 3, first[1].halfedge / 3);
        return;
      }
      for (const HalfedgeEnd* e = first; e != last; ++e)
        edge_of_[e->halfedge] = static_cast<Index>(degree_.size());
      degree_.push_back(static_cast<Index>(last - first));
      crowded_ = crowded_ || last - first > 2;
    });
    for (Index f = 0; f < faces.count(); ++f)
      area_[patches_.root(f)] += area_vector(points, faces, f).norm() / 2;
  }

  bool none() const { return !crowded_; }

  // Which faces stay.
  const std::vector<char>& find() {
    rims_.resize(faces_.count());
    for (Index h = 0; h < static_cast<Index>(edge_of_.size()); ++h)
      if (edge_of_[h] != kNone) rims_[patches_.root(h / 3)].push_back(edge_of_[h]);
    for (std::vector<Index>& rim : rims_) std::sort(rim.begin(), rim.end());
    std::vector<Index> order;
    for (Index f = 0; f < faces_.count(); ++f)
      if (patches_.root(f) == f && !rims_[f].empty()) order.push_back(f);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return area_[a] < area_[b]; });
    std::vector<char> gone(faces_.count(), 0);
    for (const Index patch : order) {
      if (!hangs(patch)) continue;
      gone[patch] = 1;
      for (const Index e : rims_[patch]) --degree_[e];
    }
    for (Index f = 0; f < faces_.count(); ++f) keep_[f] = !gone[patches_.root(f)];
    return keep_;
  }

 private:
  // Whether more edges close without the patch than with it, and some close that have more than two faces.
  // An edge at which several faces of the patch meet comes up as often in its rim, one after the other.
  bool hangs(Index patch) const {
    const std::vector<Index>& rim = rims_[patch];
    Index closes = 0, free = 0, opens = 0;
    for (std::size_t i = 0, j; i < rim.size(); i = j) {
      for (j = i + 1; j < rim.size() && rim[j] == rim[i];) ++j;
      const Index degree = degree_[rim[i]], left = degree - static_cast<Index>(j - i);
      if (degree == 1) ++free;
      if (left == 0) continue;
      if (degree % 2 == 1 && left % 2 == 0) ++closes;
      if (degree % 2 == 0 && left % 2 == 1) ++opens;
    }
    return closes > 0 && closes + free > opens;
  }

  const FaceSet& faces_;
  EdgeTable edges_;
  DisjointSets patches_;
  std::vector<Index> edge_of_;  // per half-edge, if its edge has one face or more than two
  std::vector<Index> degree_;   // per such edge: faces that it has left
  std::vector<double> area_;    // per patch
  std::vector<std::vector<Index>> rims_;
  std::vector<char> keep_;
  bool crowded_ = false;
};

}  // namespace

FaceSet without_flaps(const std::vector<Vector3>& points, const FaceSet& faces, MendCounts& counts) {
  Flaps flaps(points, faces);
  if (flaps.none()) return faces;
  FaceSet kept = kept_faces(faces, flaps.find());
  counts.flap_faces += faces.count() - kept.count();
  return kept;
}

}  // namespace mspskel::detail
