#include "split_long_edges.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "../mesh/edge_table.h"
#include "face_set.h"

namespace mspskel::detail {
namespace {

class Splitting {
 public:
  Splitting(PolygonSoup& soup, std::vector<double>&& limit)
      : soup_(soup), limit_(std::move(limit)), twin_(soup.corners.size(), kNone) {
    EdgeTable(static_cast<Index>(soup.points.size()), soup.corners)
        .each_edge([&](Index, Index, const HalfedgeEnd* first, const HalfedgeEnd*) {
          twin_[first[0].halfedge] = first[1].halfedge;
          twin_[first[1].halfedge] = first[0].halfedge;
        });
  }

  void run(Index most) {
    for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
      if (h < twin_[h]) wait(h);
    while (!waiting_.empty() && static_cast<Index>(limit_.size()) < most) {
      const auto [excess, a, b, h] = waiting_.top();
      waiting_.pop();
      if (soup_.corners[h] == a && soup_.corners[FaceSet::next(h)] == b) split(h);
    }
    soup_.begin = {0};
    for (std::size_t end = 3; end <= soup_.corners.size(); end += 3)
      soup_.begin.push_back(static_cast<Index>(end));
  }

 private:
  const Vector3& from(Index h) const { return soup_.points[soup_.corners[h]]; }

  void wait(Index h) {
    const double length = (from(FaceSet::next(h)) - from(h)).norm();
    const double excess = length / std::min(limit_[h / 3], limit_[twin_[h] / 3]);
    if (excess > 1) waiting_.emplace(excess, soup_.corners[h], soup_.corners[FaceSet::next(h)], h);
  }

  void split(Index h) {
    const auto middle = static_cast<Index>(soup_.points.size());
    const Vector3 place = (from(h) + from(FaceSet::next(h))) / 2;
    soup_.points.push_back(place);
    const Index g = twin_[h];
    const Index beyond_h = halve(h, middle), beyond_g = halve(g, middle);
    // h ends in the middle, and what lies beyond it there starts in it.
    join(h, beyond_g);
    join(g, beyond_h);
    for (const Index k : {h, g, FaceSet::next(h), FaceSet::next(g)}) wait(k);
  }
  // The triangle keeps the side's first half; returns the half-edge of the other one, in a triangle of its
  // own.
  Index halve(Index h, Index middle) {
    const auto added = static_cast<Index>(soup_.corners.size());
    soup_.corners.insert(soup_.corners.end(),
                         {middle, soup_.corners[FaceSet::next(h)], soup_.corners[FaceSet::prev(h)]});
    limit_.push_back(limit_[h / 3]);
    twin_.resize(twin_.size() + 3, kNone);
    join(added + 1, twin_[FaceSet::next(h)]);
    soup_.corners[FaceSet::next(h)] = middle;
    join(FaceSet::next(h), added + 2);
    wait(added + 1);  // it may wait under the name that it had
    return added;
  }
  void join(Index h, Index g) {
    twin_[h] = g;
    twin_[g] = h;
  }

  PolygonSoup& soup_;
  std::vector<double> limit_;  // per triangle
  std::vector<Index> twin_;
  std::priority_queue<std::tuple<double, Index, Index, Index>> waiting_;
};

}  // namespace

void split_long_edges(PolygonSoup& soup, std::vector<double> limit_of_triangle, Index most) {
  Splitting(soup, std::move(limit_of_triangle)).run(most);
}

}  // namespace mspskel::detail
