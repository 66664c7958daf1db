#include "weld_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "disjoint_sets.h"
#include "point_tree.h"

namespace mspskel::detail {

std::vector<Index> weld_equal_points(const std::vector<Vector3>& points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  // Coordinates that are no numbers come last: they compare with nothing, and an order needs that.
  const auto less = [](double x, double y) { return x < y || (std::isnan(y) && !std::isnan(x)); };
  const auto before = [&](Index a, Index b) {
    for (int k = 0; k < 3; ++k) {
      if (less(points[a][k], points[b][k])) return true;
      if (less(points[b][k], points[a][k])) return false;
    }
    return false;
  };
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return before(a, b) || (!before(b, a) && a < b); });
  std::vector<Index> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

Index weld_near_points(const std::vector<Vector3>& points, const std::vector<Index>& members,
                       const std::vector<double>& reach, std::vector<Index>& representative) {
  const PointTree tree(points, members);
  DisjointSets groups(static_cast<Index>(points.size()));
  Index joined = 0;
  for (const Index a : members)
    tree.each_within(points[a], reach[a], [&](Index b) {
      if (a != b && (points[a] - points[b]).norm() <= reach[b]) joined += groups.unite(a, b);
    });
  for (Index& r : representative) r = groups.root(r);
  return joined;
}

}  // namespace mspskel::detail
