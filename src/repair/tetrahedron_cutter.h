// Where a function on the nodes of a grid changes its sign: a closed manifold of triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::detail {

// Each cube of the grid is six tetrahedra about one diagonal (Kuhn 1960), and what separates inside from
// outside in them is a closed manifold (Doi and Koide 1991).
//   Field: value(node), negative inside, and place(node), for nodes below node_count.
template <class Field>
class TetrahedronCutter {
 public:
  TetrahedronCutter(const Field& field, std::uint64_t node_count) : field_(field), node_count_(node_count) {}

  // Bit k of a corner's number: the farther side along axis k. Six tetrahedra, one for each way along the
  // axes from the first corner to the last.
  void cut_cube(const std::array<Index, 8>& nodes) {
    for (int k = 0; k < 8; ++k) value_[k] = field_.value(nodes[k]);
    const auto inside = std::count_if(value_.begin(), value_.end(), [](double x) { return x < 0; });
    if (inside == 0 || inside == 8) return;
    node_ = nodes;
    for (int k = 0; k < 8; ++k) place_[k] = field_.place(nodes[k]);
    static constexpr int kWays[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
    for (const auto& [first, second] : kWays) cut_tetrahedron({0, first, second, 7});
  }

  PolygonSoup take() { return std::move(soup_); }

 private:
  using Edge = std::array<int, 2>;  // from a corner inside to one outside

  void cut_tetrahedron(const std::array<int, 4>& corners) {
    std::array<int, 4> in{}, out{};
    int ins = 0, outs = 0;
    for (const int k : corners) (value_[k] < 0 ? in[ins++] : out[outs++]) = k;
    if (ins == 1) {
      add(in, ins, out, outs, {{{in[0], out[0]}, {in[0], out[1]}, {in[0], out[2]}}});
    } else if (ins == 3) {
      add(in, ins, out, outs, {{{in[0], out[0]}, {in[1], out[0]}, {in[2], out[0]}}});
    } else if (ins == 2) {
      add(in, ins, out, outs, {{{in[0], out[0]}, {in[0], out[1]}, {in[1], out[1]}}});
      add(in, ins, out, outs, {{{in[0], out[0]}, {in[1], out[1]}, {in[1], out[0]}}});
    }
  }

  // Seen from outside counter-clockwise, which the middles of the edges decide.
  void add(const std::array<int, 4>& in, int ins, const std::array<int, 4>& out, int outs,
           const std::array<Edge, 3>& edges) {
    Vector3 outward = Vector3::Zero();
    for (int i = 0; i < outs; ++i) outward += place_[out[i]] / outs;
    for (int i = 0; i < ins; ++i) outward -= place_[in[i]] / ins;
    const auto middle = [&](const Edge& e) { return Vector3((place_[e[0]] + place_[e[1]]) / 2); };
    const Vector3 a = middle(edges[0]), b = middle(edges[1]), c = middle(edges[2]);
    const Index u = vertex(edges[0]), v = vertex(edges[1]), w = vertex(edges[2]);
    if ((b - a).cross(c - a).dot(outward) > 0)
      soup_.add_triangle(u, v, w);
    else
      soup_.add_triangle(u, w, v);
  }

  Index vertex(const Edge& e) {
    constexpr double kClear = 0.05;  // of the edge, from its ends: triangles keep an area
    const auto [entry, added] = vertices_.try_emplace(
        static_cast<std::uint64_t>(node_[e[0]]) * node_count_ + static_cast<std::uint64_t>(node_[e[1]]),
        soup_.points.size());
    if (!added) return static_cast<Index>(entry->second);
    const Vector3 &from = place_[e[0]], &to = place_[e[1]];
    const double inside = value_[e[0]], share = inside / (inside - value_[e[1]]);
    soup_.points.push_back(from + std::clamp(share, kClear, 1 - kClear) * (to - from));
    return static_cast<Index>(entry->second);
  }

  const Field& field_;
  std::uint64_t node_count_;
  // Of the cube's corners.
  std::array<Index, 8> node_{};
  std::array<double, 8> value_{};
  std::array<Vector3, 8> place_;
  std::unordered_map<std::uint64_t, std::size_t> vertices_;
  PolygonSoup soup_;
};

}  // namespace mspskel::detail
