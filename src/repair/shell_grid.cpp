#include "shell_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

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
  UnionBoundary(const ShellGroup& group, double cell, double margin)
      : group_(group),
        margin_(margin),
        // Not a whole number of cells from the box, so that plane walls do not fall on nodes.
        grid_(group.low() - Vector3(2.37, 2.53, 2.71) * cell - Vector3::Constant(margin),
              group.high() + Vector3::Constant(2.5 * cell + margin), cell) {}

  PolygonSoup run(const Execution& execution) {
    find_cells(execution);
    find_nodes();
    sample(execution);
    TetrahedronCutter cutter(*this, nodes_.size());
    std::array<std::int64_t, 8> offset{};
    for (int k = 0; k < 8; ++k) offset[k] = offset_of(k);
    std::array<Index, 8> corner{};  // as the cells' numbers ascend, so do those of each corner
    for (const std::int64_t key : cells_) {
      for (int k = 0; k < 8; ++k)
        while (nodes_[corner[k]] < key + offset[k]) ++corner[k];
      cutter.cut_cube(corner);
    }
    return cutter.take();
  }

  // What TetrahedronCutter asks for.
  double value(Index node) const { return value_[node]; }
  Vector3 place(Index node) const { return grid_.place(grid_.cell(nodes_[node])); }

 private:
  // Those that a face or its margin can meet.
  void find_cells(const Execution& execution) {
    constexpr Index kBlocks = 16, kLeastBlock = 256;
    constexpr std::size_t kLeastKeys = 4096;
    const auto faces = static_cast<Index>(group_.faces().size());
    const Index block = std::max(kLeastBlock, faces / kBlocks);
    std::vector<std::vector<std::int64_t>> found(static_cast<std::size_t>((faces + block - 1) / block));
    parallel_for(
        static_cast<Index>(found.size()), "union of shells", execution, [] { return 0; },
        [&](Index b, int&) {
          std::vector<std::int64_t>& keys = found[b];
          std::size_t kept = 0;
          for (Index i = b * block; i < std::min(faces, (b + 1) * block); ++i) {
            add_cells(group_.faces()[i], keys);
            if (keys.size() <= 2 * kept + kLeastKeys) continue;
            sort_unique(keys);  // faces share most of their cells
            kept = keys.size();
          }
          sort_unique(keys);
        },
        1);
    for (const std::vector<std::int64_t>& keys : found) cells_.insert(cells_.end(), keys.begin(), keys.end());
    sort_unique(cells_);
  }

  void add_cells(Index f, std::vector<std::int64_t>& cells) const {
    const SurfaceSnapshot& surface = group_.surface();
    const auto corner = [&](Index h) { return surface.position[surface.origin[h]]; };
    const Triangle t{corner(3 * f), corner(3 * f + 1), corner(3 * f + 2)};
    const Vector3 room = Vector3::Constant(margin_);
    add_cells(t, grid_.cell_at(t.a.cwiseMin(t.b).cwiseMin(t.c) - room),
              grid_.cell_at(t.a.cwiseMax(t.b).cwiseMax(t.c) + room), cells);
  }
  // The cells from the one to the other, by halves as long as the triangle is near.
  void add_cells(const Triangle& t, const Cell& from, const Cell& to,
                 std::vector<std::int64_t>& cells) const {
    const Vector3 low = grid_.place(from), high = grid_.place(to) + Vector3::Constant(grid_.side());
    const Vector3 middle = (low + high) / 2;
    if ((closest_on_triangle(middle, t) - middle).norm() > (high - low).norm() / 2 + margin_) return;
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (to[k] - from[k] > to[longest] - from[longest]) longest = k;
    if (to[longest] == from[longest]) {
      cells.push_back(grid_.key(from));
      return;
    }
    Cell below = to, above = from;
    below[longest] = (from[longest] + to[longest]) / 2;
    above[longest] = below[longest] + 1;
    add_cells(t, from, below, cells);
    add_cells(t, above, to, cells);
  }

  // From a cell's number to that of its corner. Bit k of `corner`: the farther side along axis k.
  std::int64_t offset_of(int corner) const {
    return grid_.key({corner & 1, corner >> 1 & 1, corner >> 2 & 1});
  }

  // The corners of the cells: along one axis after the other each node and the next one.
  void find_nodes() {
    nodes_ = cells_;
    std::vector<std::int64_t> next, both;
    for (const int axis : {1, 2, 4}) {
      next = nodes_;
      const std::int64_t offset = offset_of(axis);
      for (std::int64_t& key : next) key += offset;
      both.clear();
      std::set_union(nodes_.begin(), nodes_.end(), next.begin(), next.end(), std::back_inserter(both));
      nodes_.swap(both);
    }
  }

  // Distances from the shells' walls, negative inside, less the margin.
  void sample(const Execution& execution) {
    // Every node is a corner of a cell that a face or its margin meets.
    const double farthest = 1.01 * (std::sqrt(3.0) * grid_.side() + margin_);
    value_.resize(nodes_.size());
    parallel_for(
        static_cast<Index>(nodes_.size()), "union of shells", execution, [] { return 0; },
        [&](Index i, int&) {
          const Vector3 p = place(i);
          const double distance = group_.distance(p, farthest);
          value_[i] = (group_.inside(p) ? -distance : distance) - margin_;
        },
        256);
  }

  const ShellGroup& group_;
  double margin_;
  Lattice grid_;
  std::vector<std::int64_t> cells_, nodes_;  // ascending
  std::vector<double> value_;                // per node
};

}  // namespace

ShellGroup::ShellGroup(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                       const std::vector<Index>& members, const Execution& execution)
    : surface_(surface), low_(shells[members[0]].low), high_(shells[members[0]].high) {
  for (const Index m : members) {
    members_.push_back(&shells[m]);
    faces_.insert(faces_.end(), shells[m].faces.begin(), shells[m].faces.end());
    low_ = low_.cwiseMin(shells[m].low);
    high_ = high_.cwiseMax(shells[m].high);
  }
  solids_.resize(members.size());
  // The walls of all take as long as the solids together, so they are begun first.
  parallel_for(
      static_cast<Index>(members.size()) + 1, "union of shells", execution, [] { return 0; },
      [&](Index i, int&) {
        if (i == 0)
          walls_.emplace(surface_, faces_);
        else
          solids_[i - 1].emplace(surface_, members_[i - 1]->faces);
      },
      1);
}

bool ShellGroup::is_in(std::size_t i, const Vector3& p) const {
  const Shell& shell = *members_[i];
  return (p.array() >= shell.low.array()).all() && (p.array() <= shell.high.array()).all() &&
         solids_[i]->inside(p);
}

bool ShellGroup::inside(const Vector3& p) const {
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (is_in(i, p)) return true;
  return false;
}

double ShellGroup::distance(const Vector3& p, double bound) const {
  return std::min(walls_->closest(p, bound).distance, bound);
}

PolygonSoup boundary_of_union(const ShellGroup& group, double cell, double margin,
                              const Execution& execution) {
  return UnionBoundary(group, cell, margin).run(execution);
}

}  // namespace mspskel::detail
