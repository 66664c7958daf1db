#include "shell_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "mspskel/mesh/detail/triangle_queries.h"
#include "tetrahedron_cutter.h"

namespace mspskel::detail {
namespace {

using Cell = std::array<std::int64_t, 3>;

// Nodes of a grid by one number; a cell is named by its least node.
class Lattice {
 public:
  Lattice(const Vector3& low, const Vector3& high, double side) : low_(low), side_(side) {
    for (int k = 0; k < 3; ++k)
      size_[k] = static_cast<std::int64_t>(std::ceil((high[k] - low[k]) / side)) + 2;
  }
  std::int64_t key(const Cell& c) const { return (c[2] * size_[1] + c[1]) * size_[0] + c[0]; }
  Cell cell(std::int64_t key) const {
    return {key % size_[0], key / size_[0] % size_[1], key / size_[0] / size_[1]};
  }
  Vector3 place(const Cell& c) const {
    return low_ +
           side_ * Vector3(static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2]));
  }
  Cell cell_at(const Vector3& p) const {
    Cell c;
    for (int k = 0; k < 3; ++k)
      c[k] = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((p[k] - low_[k]) / side_)), 0,
                                      size_[k] - 2);
    return c;
  }
  double side() const { return side_; }

 private:
  Vector3 low_;
  double side_;
  Cell size_{};
};

void sort_unique(std::vector<std::int64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

class UnionBoundary {
 public:
  UnionBoundary(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                const std::vector<Index>& members, double cell, double margin)
      : surface_(surface),
        shells_(shells),
        members_(members),
        margin_(margin),
        grid_(low_corner(cell), high_corner(cell), cell) {}

  PolygonSoup run(const Execution& execution) {
    find_cells();
    sample(execution);
    TetrahedronCutter cutter(*this, nodes_.size());
    for (const std::int64_t key : cells_) {
      std::array<Index, 8> corner{};
      for (int k = 0; k < 8; ++k) corner[k] = node(corner_of(grid_.cell(key), k));
      cutter.cut_cube(corner);
    }
    return cutter.take();
  }

  // What TetrahedronCutter asks for.
  double value(Index node) const { return value_[node]; }
  Vector3 place(Index node) const { return grid_.place(grid_.cell(nodes_[node])); }

 private:
  // Not a whole number of cells from the box, so that plane walls do not fall on nodes.
  Vector3 low_corner(double cell) const {
    Vector3 low = shells_[members_[0]].low;
    for (const Index m : members_) low = low.cwiseMin(shells_[m].low);
    return low - Vector3(2.37, 2.53, 2.71) * cell - Vector3::Constant(margin_);
  }
  Vector3 high_corner(double cell) const {
    Vector3 high = shells_[members_[0]].high;
    for (const Index m : members_) high = high.cwiseMax(shells_[m].high);
    return high + Vector3::Constant(2.5 * cell + margin_);
  }

  // Those that a face or its margin can meet.
  void find_cells() {
    for (const Index m : members_)
      for (const Index f : shells_[m].faces) {
        const auto corner = [&](Index h) { return surface_.position[surface_.origin[h]]; };
        const Triangle t{corner(3 * f), corner(3 * f + 1), corner(3 * f + 2)};
        const Vector3 room = Vector3::Constant(margin_);
        add_cells(t, grid_.cell_at(t.a.cwiseMin(t.b).cwiseMin(t.c) - room),
                  grid_.cell_at(t.a.cwiseMax(t.b).cwiseMax(t.c) + room));
        // Faces share most of their cells.
        if (cells_.size() > 2 * kept_ + 4096) {
          sort_unique(cells_);
          kept_ = cells_.size();
        }
      }
    sort_unique(cells_);
    nodes_.reserve(8 * cells_.size());
    for (const std::int64_t key : cells_) {
      const Cell c = grid_.cell(key);
      for (int corner = 0; corner < 8; ++corner) nodes_.push_back(grid_.key(corner_of(c, corner)));
    }
    sort_unique(nodes_);
  }

  // The cells from the one to the other, by halves as long as the triangle is near.
  void add_cells(const Triangle& t, const Cell& from, const Cell& to) {
    const Vector3 low = grid_.place(from), high = grid_.place(to) + Vector3::Constant(grid_.side());
    const Vector3 middle = (low + high) / 2;
    if ((closest_on_triangle(middle, t) - middle).norm() > (high - low).norm() / 2 + margin_) return;
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (to[k] - from[k] > to[longest] - from[longest]) longest = k;
    if (to[longest] == from[longest]) {
      cells_.push_back(grid_.key(from));
      return;
    }
    Cell below = to, above = from;
    below[longest] = (from[longest] + to[longest]) / 2;
    above[longest] = below[longest] + 1;
    add_cells(t, from, below);
    add_cells(t, above, to);
  }

  // Bit k of `corner`: the farther side along axis k.
  static Cell corner_of(const Cell& c, int corner) {
    return {c[0] + (corner & 1), c[1] + (corner >> 1 & 1), c[2] + (corner >> 2 & 1)};
  }

  // Distances from the shells' walls, negative inside, less the margin.
  void sample(const Execution& execution) {
    std::vector<Index> faces;
    std::vector<BoundingVolumeHierarchy> solids;
    for (const Index m : members_) {
      solids.emplace_back(surface_, shells_[m].faces);
      faces.insert(faces.end(), shells_[m].faces.begin(), shells_[m].faces.end());
    }
    const BoundingVolumeHierarchy walls(surface_, faces);
    // Every node is a corner of a cell that a face or its margin meets.
    const double farthest = 1.01 * (std::sqrt(3.0) * grid_.side() + margin_);
    value_.resize(nodes_.size());
    parallel_for(
        static_cast<Index>(nodes_.size()), "union of shells", execution, [] { return 0; },
        [&](Index i, int&) {
          const Vector3 p = grid_.place(grid_.cell(nodes_[i]));
          bool inside = false;
          for (std::size_t m = 0; m < members_.size() && !inside; ++m) {
            const Shell& shell = shells_[members_[m]];
            inside = (p.array() >= shell.low.array()).all() && (p.array() <= shell.high.array()).all() &&
                     solids[m].inside(p);
          }
          const double distance = std::min(walls.closest(p, farthest).distance, farthest);
          value_[i] = (inside ? -distance : distance) - margin_;
        },
        256);
  }

  Index node(const Cell& c) const {
    return static_cast<Index>(std::lower_bound(nodes_.begin(), nodes_.end(), grid_.key(c)) - nodes_.begin());
  }

  const SurfaceSnapshot& surface_;
  const std::vector<Shell>& shells_;
  const std::vector<Index>& members_;
  double margin_;
  Lattice grid_;
  std::vector<std::int64_t> cells_, nodes_;
  std::size_t kept_ = 0;
  std::vector<double> value_;  // per node
};

}  // namespace

PolygonSoup boundary_of_union(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                              const std::vector<Index>& members, double cell, double margin,
                              const Execution& execution) {
  return UnionBoundary(surface, shells, members, cell, margin).run(execution);
}

}  // namespace mspskel::detail
