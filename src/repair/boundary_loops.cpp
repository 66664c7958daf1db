#include "boundary_loops.h"

namespace mspskel::detail {
namespace {

// The boundary half-edge that follows: round the faces at the target.
Index next_on_boundary(const std::vector<Index>& twin, Index h) {
  for (h = FaceSet::next(h); twin[h] != kNone;) h = FaceSet::next(twin[h]);
  return h;
}

}  // namespace

std::vector<std::vector<Index>> boundary_loops(const FaceSet& faces, std::vector<Index>& twin,
                                               Index point_count, Index& stitched) {
  std::vector<std::vector<Index>> loops;
  std::vector<char> visited(twin.size(), 0);
  std::vector<Index> place(point_count, kNone);  // on the walk
  std::vector<Index> walk;
  const auto cut_off = [&](Index begin) {
    for (auto h = walk.begin() + begin; h != walk.end(); ++h) place[faces.origin(*h)] = kNone;
    loops.emplace_back(walk.begin() + begin, walk.end());
    walk.resize(begin);
  };
  for (Index start = 0; start < static_cast<Index>(twin.size()); ++start) {
    if (twin[start] != kNone || visited[start]) continue;
    for (Index h = start; !visited[h]; h = next_on_boundary(twin, h)) {
      visited[h] = 1;
      const Index p = faces.origin(h);
      if (place[p] != kNone) cut_off(place[p]);
      place[p] = static_cast<Index>(walk.size());
      walk.push_back(h);
    }
    cut_off(0);
  }
  std::vector<std::vector<Index>> holes;
  for (std::vector<Index>& loop : loops) {
    if (loop.size() > 2) {
      holes.push_back(std::move(loop));
      continue;
    }
    twin[loop[0]] = loop[1];
    twin[loop[1]] = loop[0];
    ++stitched;
  }
  return holes;
}

}  // namespace mspskel::detail
