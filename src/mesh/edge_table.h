#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include "mspskel/base/types.h"

namespace mspskel::detail {

struct HalfedgeEnd {
  Index other;  // the larger end of its edge
  Index halfedge;
};

// All half-edges by the smaller end of their edge, and within by the larger end: a counting sort, then short
// sorts. Half-edges 3f, 3f+1, 3f+2 run round triangle f, half-edge h from corners[h].
class EdgeTable {
 public:
  EdgeTable(Index vertex_count, const std::vector<Index>& corners)
      : begin_(vertex_count + 1, 0), ends_(corners.size()) {
    const auto target = [&](Index h) { return corners[h % 3 == 2 ? h - 2 : h + 1]; };
    const Index count = static_cast<Index>(corners.size());
    for (Index h = 0; h < count; ++h) ++begin_[std::min(corners[h], target(h)) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<Index> slot(begin_.begin(), begin_.end() - 1);
    for (Index h = 0; h < count; ++h)
      ends_[slot[std::min(corners[h], target(h))]++] = {std::max(corners[h], target(h)), h};
    for (Index v = 0; v < vertex_count; ++v)
      std::sort(ends_.begin() + begin_[v], ends_.begin() + begin_[v + 1],
                [](const HalfedgeEnd& a, const HalfedgeEnd& b) {
                  return a.other != b.other ? a.other < b.other : a.halfedge < b.halfedge;
                });
  }
  // Calls visit(smaller end, larger end, first, last) for each edge with its range of half-edges.
  template <class Visit>
  void each_edge(Visit visit) const {
    for (Index v = 0; v + 1 < static_cast<Index>(begin_.size()); ++v) {
      for (Index i = begin_[v], j; i < begin_[v + 1]; i = j) {
        for (j = i + 1; j < begin_[v + 1] && ends_[j].other == ends_[i].other;) ++j;
        visit(v, ends_[i].other, ends_.data() + i, ends_.data() + j);
      }
    }
  }

 private:
  std::vector<Index> begin_;
  std::vector<HalfedgeEnd> ends_;
};

}  // namespace mspskel::detail
