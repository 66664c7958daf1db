// Boundaries of solids made of unit cells: any topology, known by construction, embedded by construction.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mspskel/mesh/surface_snapshot.h"
#include "support/meshes.h"

namespace mspskel::test {

using Cell = std::array<int, 3>;

// A set of cells, each cut into `fine`³ voxels so that the surface has room; cells may share whole faces only
// (an edge or corner alone would pinch the surface).
struct VoxelSolid {
  std::set<Cell> cells;

  void box(const Cell& low, const Cell& high) {  // half open
    for (int x = low[0]; x < high[0]; ++x)
      for (int y = low[1]; y < high[1]; ++y)
        for (int z = low[2]; z < high[2]; ++z) cells.insert({x, y, z});
  }
  // The cells of an axis-parallel path through the given cells.
  static std::set<Cell> path(const std::vector<Cell>& corners) {
    std::set<Cell> result{corners.front()};
    for (std::size_t i = 1; i < corners.size(); ++i) {
      Cell at = corners[i - 1];
      while (at != corners[i]) {
        for (std::size_t k = 0; k < 3; ++k)
          if (at[k] != corners[i][k]) {
            at[k] += at[k] < corners[i][k] ? 1 : -1;
            break;
          }
        result.insert(at);
      }
    }
    return result;
  }
  void add(const std::set<Cell>& more) { cells.insert(more.begin(), more.end()); }
  void remove(const std::set<Cell>& less) {
    for (const Cell& c : less) cells.erase(c);
  }
};

inline PolygonSoup boundary(const VoxelSolid& solid, int fine = 1) {
  PolygonSoup soup;
  std::map<Cell, Index> number;
  const auto vertex = [&](const Cell& c) {
    const auto [it, fresh] = number.insert({c, static_cast<Index>(soup.points.size())});
    if (fresh) soup.points.push_back(Vector3(c[0], c[1], c[2]) / fine);
    return it->second;
  };
  const auto filled = [&](int x, int y, int z) {
    const auto down = [&](int a) { return a >= 0 ? a / fine : -((-a + fine - 1) / fine); };
    return solid.cells.count({down(x), down(y), down(z)}) > 0;
  };
  for (const Cell& cell : solid.cells)
    for (int i = 0; i < fine * fine * fine; ++i) {
      const int x = cell[0] * fine + i % fine, y = cell[1] * fine + i / fine % fine,
                z = cell[2] * fine + i / fine / fine;
      for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
          std::array<int, 3> at{x, y, z};
          at[axis] += side ? 1 : -1;
          if (filled(at[0], at[1], at[2])) continue;
          std::array<Index, 4> q;
          for (int k = 0; k < 4; ++k) {
            Cell c{x, y, z};
            c[axis] += side;
            c[(axis + 1) % 3] += k == 1 || k == 2;
            c[(axis + 2) % 3] += k >= 2;
            q[k] = vertex(c);
          }
          if (!side) std::swap(q[1], q[3]);
          soup.add_triangle(q[0], q[1], q[2]);
          soup.add_triangle(q[0], q[2], q[3]);
        }
    }
  return soup;
}

// A boundary of unit cells, each cut into `fine`, with the planes between cells at other places: plane k of
// an axis goes from k to place[axis][k].
inline PolygonSoup with_planes_at(PolygonSoup soup, int fine,
                                  const std::array<std::map<double, double>, 3>& place) {
  for (Vector3& p : soup.points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto low = place[axis].find(std::floor(p[axis] + 0.01 / fine));
      const auto high = std::next(low);
      const double share = p[axis] - low->first;
      p[axis] = low->second + (high == place[axis].end() ? 0.0 : share * (high->second - low->second));
    }
  return soup;
}

// A drawing's cells, one layer high; rows run along y.
inline VoxelSolid drawn(const std::vector<std::string>& rows) {
  VoxelSolid solid;
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < rows[y].size(); ++x)
      if (rows[y][x] == 'x') solid.cells.insert({static_cast<int>(x), static_cast<int>(y), 0});
  return solid;
}

// The torus knot T(p, q) as a closed path of cells, from its grid diagram with p + q columns and rows: column
// i runs on the upper level (z = 2) between the rows i and i + p, each row on the lower level (z = 0).
inline std::set<Cell> torus_knot(int p, int q) {
  const int n = p + q;
  std::set<Cell> cells;
  for (int i = 0; i < n; ++i) {
    const int j = (i + p) % n;
    for (const Cell& c :
         VoxelSolid::path({{2 * i, 2 * i, 0}, {2 * i, 2 * i, 2}, {2 * i, 2 * j, 2}, {2 * i, 2 * j, 0}}))
      cells.insert(c);
    for (const Cell& c : VoxelSolid::path({{2 * i, 2 * j, 0}, {2 * j, 2 * j, 0}})) cells.insert(c);
  }
  return cells;
}

// A block around the knot; the knot, opened at one place on the upper level and led out through the top, is a
// tunnel through it.
inline VoxelSolid knotted_tunnel(int p, int q) {
  std::set<Cell> tunnel = torus_knot(p, q);
  tunnel.erase({0, p, 2});
  for (const int y : {p - 1, p + 1}) tunnel.insert({0, y, 3});
  VoxelSolid block;
  block.box({-1, -1, -1}, {2 * (p + q), 2 * (p + q), 4});
  block.remove(tunnel);
  return block;
}

// A plate of n × n square holes.
inline VoxelSolid pierced_plate(int n) {
  VoxelSolid solid;
  solid.box({0, 0, 0}, {2 * n + 1, 2 * n + 1, 1});
  for (int i = 0; i < n * n; ++i) solid.cells.erase({2 * (i % n) + 1, 2 * (i / n) + 1, 0});
  return solid;
}

// Nodes and links of a cubic lattice with so many nodes along each axis, each link kept at random.
inline std::set<Cell> random_lattice(const Cell& nodes, double share, Random& random) {
  std::set<Cell> cells;
  for (int i = 0; i < nodes[0] * nodes[1] * nodes[2]; ++i) {
    const Cell node{i % nodes[0] * 2, i / nodes[0] % nodes[1] * 2, i / nodes[0] / nodes[1] * 2};
    for (std::size_t k = 0; k < 3; ++k) {
      if (node[k] == 2 * (nodes[k] - 1) || random.uniform() > share) continue;
      Cell link = node, other = node;
      ++link[k], other[k] += 2;
      cells.insert({node, link, other});
    }
  }
  return cells;
}

inline std::set<Cell> random_lattice(int n, double share, Random& random) {
  return random_lattice({n, n, n}, share, random);
}

// A block with a lattice of tunnels, of which a share is kept; those at its top and bottom are open. A cube
// of n nodes a side has the fewer faces a handle the larger it is, a bar of a fixed section as many at any
// length.
inline VoxelSolid foam(const Cell& nodes, double share = 0.8) {
  Random random(1);
  VoxelSolid solid;
  solid.box({-1, -1, 0}, {2 * nodes[0], 2 * nodes[1], 2 * nodes[2] - 1});
  solid.remove(random_lattice(nodes, share, random));
  return solid;
}

// Császár's polyhedron: a torus where every two of its seven vertices are joined by an edge.
inline PolygonSoup csaszar_torus() {
  PolygonSoup soup;
  soup.points = {{3, -3, 0}, {3, 3, 1}, {1, 2, 3}, {-1, -2, 3}, {-3, -3, 1}, {-3, 3, 0}, {0, 0, 15}};
  for (Index i = 0; i < 7; ++i) {
    soup.add_triangle(i, (i + 1) % 7, (i + 3) % 7);
    soup.add_triangle(i, (i + 3) % 7, (i + 2) % 7);
  }
  return soup;
}

// The same surface with its faces turned the other way.
inline PolygonSoup inside_out(PolygonSoup soup) {
  for (std::size_t f = 0; f < soup.polygon_count(); ++f)
    std::reverse(soup.corners.begin() + soup.begin[f], soup.corners.begin() + soup.begin[f + 1]);
  return soup;
}

inline SurfaceSnapshot snapshot_of(const PolygonSoup& soup) { return make_snapshot(to_mesh(soup)); }
// Voxel surfaces with jitter: no exact ties between heights.
inline SurfaceSnapshot snapshot_of(const VoxelSolid& solid, int fine, double jitter = 0.1,
                                   std::uint64_t seed = 1) {
  return make_snapshot(jittered(to_mesh(boundary(solid, fine)), seed, jitter));
}

}  // namespace mspskel::test
