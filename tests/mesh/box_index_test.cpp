// What may lie in a box: never less than what does.
#include "mspskel/mesh/detail/box_index.h"

#include <catch2/catch.hpp>
#include <set>

#include "support/random_solid.h"

using namespace mspskel;
using namespace mspskel::detail;
using namespace mspskel::test;

TEST_CASE("a segment through a box may meet it, one past its edge does not though their boxes meet") {
  Random random(3);
  Index past = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 a = random.in_ball(), b = random.in_ball(), p = random.in_ball(), q = random.in_ball();
    const Vector3 low = 0.4 * p.cwiseMin(q), high = 0.4 * p.cwiseMax(q);
    if ((a.cwiseMin(b).array() > high.array()).any() || (a.cwiseMax(b).array() < low.array()).any()) continue;
    // Liang and Barsky: the stretch of the segment within all three pairs of planes.
    double from = 0, to = 1;
    for (int k = 0; k < 3; ++k) {
      const double s = (low[k] - a[k]) / (b[k] - a[k]), t = (high[k] - a[k]) / (b[k] - a[k]);
      from = std::max(from, std::min(s, t));
      to = std::min(to, std::max(s, t));
    }
    CHECK(segment_may_meet_box(a, b, low, high) == (from <= to));
    past += from > to;
  }
  CHECK(past > 100);
  const Vector3 low(0, 0, 0), high(1, 1, 1), corner(1, 1, 0.5);
  CHECK(segment_may_meet_box(corner, corner, low, high));
  CHECK(segment_may_meet_box({2, 0, 0.5}, {0, 2, 0.5}, low, high));
}

TEST_CASE("a box finds the boxes that it meets") {
  Random random(5);
  BoxIndex index;
  std::vector<std::pair<Vector3, Vector3>> boxes;
  for (Index i = 0; i < 500; ++i) {
    const Vector3 low = random.in_ball(), high = low + 0.1 * random.in_ball().cwiseAbs();
    index.add(i, low, high);
    boxes.push_back({low, high});
  }
  index.build();
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3 low = random.in_ball(), high = low + 0.3 * random.in_ball().cwiseAbs();
    std::set<Index> found;
    index.in_box(low, high, [&](Index i) { found.insert(i); });
    for (Index i = 0; i < 500; ++i)
      if ((boxes[i].first.array() <= high.array()).all() && (boxes[i].second.array() >= low.array()).all())
        CHECK(found.count(i) == 1);
  }
}
