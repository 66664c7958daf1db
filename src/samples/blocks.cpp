#include "mspskel/samples/blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <unordered_map>

#include "mspskel/base/error.h"
#include "mspskel/samples/shapes.h"
#include "noise.h"
#include "surface_area.h"

namespace mspskel {

namespace {
using BoxCell = std::array<Index, 3>;

// The planes across one axis, each once, with pieces of at most about `step` between them.
struct Planes {
  std::vector<double> place;

  Planes(const std::vector<Block>& boxes, Eigen::Index axis, double step) {
    std::vector<double> sides;
    for (const Block& box : boxes) sides.insert(sides.end(), {box.low[axis], box.high[axis]});
    std::sort(sides.begin(), sides.end());
    const double near = 1e-9 * (sides.back() - sides.front());
    for (const double side : sides) {
      if (!place.empty() && side - place.back() <= near) continue;
      const double from = place.empty() ? side : place.back();
      const auto pieces = std::max<Index>(1, static_cast<Index>(std::lround((side - from) / step)));
      for (Index i = place.empty() ? pieces : 1; i <= pieces; ++i)
        place.push_back(from + (side - from) * i / pieces);
    }
  }
  Index cells() const { return static_cast<Index>(place.size()) - 1; }
  Index nearest(double x) const {
    const auto above = std::lower_bound(place.begin(), place.end(), x);
    if (above == place.begin()) return 0;
    if (above == place.end() || x - *(above - 1) < *above - x)
      return static_cast<Index>(above - place.begin()) - 1;
    return static_cast<Index>(above - place.begin());
  }
};

// Space cut into boxes by planes, each inside or outside; the surface between.
class BoxGrid {
 public:
  BoxGrid(const std::vector<Block>& boxes, double step)
      : planes_{Planes(boxes, 0, step), Planes(boxes, 1, step), Planes(boxes, 2, step)},
        inside_(static_cast<std::size_t>(planes_[0].cells()) * static_cast<std::size_t>(planes_[1].cells()) *
                static_cast<std::size_t>(planes_[2].cells())) {
    for (const Block& box : boxes) {
      BoxCell low, high;
      for (Eigen::Index k = 0; k < 3; ++k) {
        low[k] = planes_[k].nearest(box.low[k]);
        high[k] = planes_[k].nearest(box.high[k]);
      }
      for (Index z = low[2]; z < high[2]; ++z)
        for (Index y = low[1]; y < high[1]; ++y)
          for (Index x = low[0]; x < high[0]; ++x) inside_[number({x, y, z})] = true;
    }
  }

  // Every vertex knows across which axes it may stray: not across the faces that it lies on.
  struct Surface {
    PolygonSoup soup;
    std::vector<std::array<bool, 3>> held;
  };

  Surface surface(std::uint64_t seed) {
    for (Index z = 0; z < planes_[2].cells(); ++z)
      for (Index y = 0; y < planes_[1].cells(); ++y)
        for (Index x = 0; x < planes_[0].cells(); ++x)
          if (inside_[number({x, y, z})])
            for (int axis = 0; axis < 3; ++axis)
              for (const int side : {0, 1}) add_side({x, y, z}, axis, side, seed);
    return std::move(surface_);
  }

 private:
  std::size_t number(const BoxCell& c) const {
    return (static_cast<std::size_t>(c[2]) * static_cast<std::size_t>(planes_[1].cells()) +
            static_cast<std::size_t>(c[1])) *
               static_cast<std::size_t>(planes_[0].cells()) +
           static_cast<std::size_t>(c[0]);
  }

  // One side of an inner box, unless the box behind it is inner too. Corners 0 to 3 run round the axis:
  //   3 -- 2
  //   |    |       the diagonal is either, by chance
  //   0 -- 1
  void add_side(const BoxCell& cell, int axis, int side, std::uint64_t seed) {
    BoxCell behind = cell;
    behind[axis] += side == 1 ? 1 : -1;
    const bool ends = behind[axis] < 0 || behind[axis] >= planes_[axis].cells();
    if (!ends && inside_[number(behind)]) return;
    std::array<Index, 4> v;
    for (int k = 0; k < 4; ++k) {
      BoxCell corner = cell;
      corner[axis] += side;
      corner[(axis + 1) % 3] += k == 1 || k == 2;
      corner[(axis + 2) % 3] += k >= 2;
      v[k] = vertex(corner);
      surface_.held[v[k]][axis] = true;
    }
    if (side == 0) std::swap(v[1], v[3]);
    if (detail::noise(seed + 3, number(cell), static_cast<std::uint64_t>(2 * axis + side)) < 0)
      std::rotate(v.begin(), v.begin() + 1, v.end());
    surface_.soup.add_triangle(v[0], v[1], v[2]);
    surface_.soup.add_triangle(v[0], v[2], v[3]);
  }

  Index vertex(const BoxCell& c) {
    const auto wide = [&](int k) { return static_cast<std::uint64_t>(planes_[k].place.size()); };
    const std::uint64_t key =
        (static_cast<std::uint64_t>(c[2]) * wide(1) + static_cast<std::uint64_t>(c[1])) * wide(0) +
        static_cast<std::uint64_t>(c[0]);
    const auto [place, is_new] = vertex_.try_emplace(key, static_cast<Index>(surface_.soup.points.size()));
    if (is_new) {
      surface_.soup.points.push_back(
          {planes_[0].place[c[0]], planes_[1].place[c[1]], planes_[2].place[c[2]]});
      surface_.held.push_back({false, false, false});
    }
    return place->second;
  }

  std::array<Planes, 3> planes_;
  std::vector<bool> inside_;
  std::unordered_map<std::uint64_t, Index> vertex_;
  Surface surface_;
};

// Half of the shortest edge at each vertex bounds how far it may stray without turning a face over.
void stray(BoxGrid::Surface& surface, double irregularity, std::uint64_t seed) {
  std::vector<double> reach(surface.soup.points.size(), 1e300);
  const PolygonSoup& soup = surface.soup;
  for (std::size_t c = 0; c < soup.corners.size(); ++c) {
    const Index a = soup.corners[c], b = soup.corners[c % 3 == 2 ? c - 2 : c + 1];
    const double length = (soup.points[a] - soup.points[b]).norm();
    reach[a] = std::min(reach[a], length);
    reach[b] = std::min(reach[b], length);
  }
  for (std::size_t v = 0; v < reach.size(); ++v)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (!surface.held[v][static_cast<std::size_t>(k)])
        surface.soup.points[v][k] +=
            irregularity * reach[v] * detail::noise(seed + 1, v, static_cast<std::uint64_t>(k));
}

// The cut whose number of vertices is nearest to the wanted one. The number falls in jumps with the step's
// length, which the squares of a regular cut give, one vertex each, as a first guess.
BoxGrid::Surface surface_of_about(const std::vector<Block>& blocks, Index vertices, std::uint64_t seed) {
  BoxGrid::Surface best = BoxGrid(blocks, 1e300).surface(seed);
  const auto miss = [&](const BoxGrid::Surface& s) {
    return std::abs(std::log(static_cast<double>(s.soup.points.size()) / vertices));
  };
  double step = std::sqrt(detail::surface_area(best.soup) / vertices), too_short = 0, too_long = 1e300;
  for (int attempt = 0; attempt < 10 && miss(best) > 0.08; ++attempt) {
    BoxGrid::Surface next = BoxGrid(blocks, step).surface(seed);
    const double excess = static_cast<double>(next.soup.points.size()) / vertices;
    (excess > 1 ? too_short : too_long) = step;
    if (miss(next) < miss(best)) best = std::move(next);
    step = too_short > 0 && too_long < 1e300 ? std::sqrt(too_short * too_long) : step * std::sqrt(excess);
  }
  return best;
}

void check(const Block& block) {
  if (!((block.high - block.low).minCoeff() > 0)) throw UsageError("a block needs three extents");
}
}  // namespace

Block bar(const Vector3& from, const Vector3& to, double half_width, bool round) {
  Eigen::Index axis = 0;
  const Vector3 along = (to - from).cwiseAbs();
  const double length = along.maxCoeff(&axis);
  if (!(length > 0) || !(half_width > 0)) throw UsageError("a bar needs a length and a width");
  if (along.sum() - length > 1e-9 * length) throw UsageError("a bar must lie along a coordinate axis");
  Vector3 wide = Vector3::Constant(half_width);
  wide[axis] = 0;
  constexpr std::array<Block::Shape, 3> kRound{Block::Shape::kRoundX, Block::Shape::kRoundY,
                                               Block::Shape::kRoundZ};
  return {from.cwiseMin(to) - wide, from.cwiseMax(to) + wide,
          round ? kRound[static_cast<std::size_t>(axis)] : Block::Shape::kBox};
}

PolygonSoup make_boxes(const std::vector<Block>& blocks, Index vertices, double irregularity,
                       std::uint64_t seed) {
  if (!(irregularity >= 0 && irregularity <= 0.3)) throw UsageError("irregularity must lie in [0, 0.3]");
  if (blocks.empty()) throw UsageError("a solid of blocks needs a block");
  for (const Block& block : blocks) {
    check(block);
    if (block.shape != Block::Shape::kBox) throw UsageError("a round block has no flat sides");
  }
  BoxGrid::Surface surface = surface_of_about(blocks, vertices, seed);
  stray(surface, irregularity, seed);
  return std::move(surface.soup);
}

double rounded_box_distance(const Vector3& p, const Vector3& half, double rounding) {
  const Vector3 q = p.cwiseAbs() - (half - Vector3::Constant(rounding));
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - rounding;
}

ImplicitSolid blocks_solid(const std::vector<Block>& blocks, double rounding) {
  if (blocks.empty()) throw UsageError("a solid of blocks needs a block");
  ImplicitSolid solid;
  solid.low = Vector3::Constant(1e300);
  solid.high = -solid.low;
  for (const Block& block : blocks) {
    check(block);
    solid.low = solid.low.cwiseMin(block.low);
    solid.high = solid.high.cwiseMax(block.high);
  }
  solid.value = [blocks, rounding](const Vector3& p) {
    double result = 1e300;
    for (const Block& block : blocks) {
      Vector3 q = p - 0.5 * (block.low + block.high), half = 0.5 * (block.high - block.low);
      if (block.shape != Block::Shape::kBox) {  // a rectangle turned round the axis
        const Eigen::Index axis = static_cast<Eigen::Index>(block.shape) - 1;
        const double along = q[axis];
        q = {std::sqrt(std::max(0.0, q.squaredNorm() - along * along)), along, 0};
        half = {half[(axis + 1) % 3], half[axis], 2 * (half.sum() + rounding)};
      }
      result = std::min(result, rounded_box_distance(q, half, rounding));
    }
    return result;
  };
  return solid;
}

}  // namespace mspskel
