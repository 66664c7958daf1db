// What a ball reaches from outside without passing through the walls of a soup.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "dense_grid.h"
#include "mspskel/base/watch.h"
#include "soup_walls.h"

namespace mspskel::detail {

struct Distances {
  std::vector<float> value;   // in cells; infinite beyond the limit
  std::vector<Index> source;  // what is nearest
};

// Every node gets the nearest of the sources that reach it over neighbours: exact beside a source, and within
// a small part of a cell elsewhere. distance(node, source), in cells.
template <class Distance>
void spread(const DenseGrid& grid, double limit, Distance distance, Distances& distances, Watch& watch) {
  using Entry = std::pair<float, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  for (Index n = 0; n < grid.count(); ++n)
    if (distances.source[n] != kNone) front.emplace(distances.value[n], n);
  while (!front.empty()) {
    watch.step();
    const auto [value, node] = front.top();
    front.pop();
    if (value > distances.value[node]) continue;
    const Index source = distances.source[node];
    grid.each_neighbour(node, [&](Index next) {
      if (distances.source[next] == source) return;
      const auto there = static_cast<float>(distance(next, source));
      if (!(there < distances.value[next]) || there > limit) return;
      distances.value[next] = there;
      distances.source[next] = source;
      front.emplace(there, next);
    });
  }
}

// Distances from the walls on a grid, and what balls of up to a given radius reach from outside.
class OutsideFlood {
 public:
  // Lengths in model units.
  OutsideFlood(const SoupWalls& walls, double cell, double wall, double largest_radius, Watch& watch)
      : shape_(walls), watch_(watch), wall_(wall / cell), largest_ball_(largest_radius / cell) {
    const Vector3 room = Vector3::Constant(cell * 3 + wall + largest_radius);
    // Not a whole number of cells from the box, so that plane walls do not fall on nodes.
    grid_ = DenseGrid(walls.low - room - Vector3(0.37, 0.53, 0.71) * cell, walls.high + room, cell);
    measure_faces();
  }

  // Where the ball's centre gets to from outside, and how far from there all else is.
  void run(double radius) {
    ball_ = radius / grid_.side();
    flood();
  }
  // Volumes in cells: of the walls, and of what the last ball does not reach.
  double wall_cells() const {
    return static_cast<double>(
        std::count_if(walls_.value.begin(), walls_.value.end(), [&](float d) { return d < wall_; }));
  }
  double unreached_cells() const {
    return static_cast<double>(
        std::count_if(reach_.value.begin(), reach_.value.end(), [&](float d) { return d > ball_; }));
  }
  // Of what the last ball does not reach: what a larger ball fills that has place there, walls left out.
  double room_cells(double radius) {
    const double ball = radius / grid_.side();
    const auto reach = static_cast<Index>(ball);
    std::vector<char> in_room(walls_.value.size(), 0);
    for (Index n = 0; n < grid_.count(); ++n) {
      watch_.step();
      if (reach_.value[n] <= ball_ || walls_.value[n] < wall_ + ball) continue;
      each_near(n, reach, [&](Index near, double squared) {
        if (squared <= ball * ball && reach_.value[near] > ball_) in_room[near] = 1;
      });
    }
    return static_cast<double>(std::count(in_room.begin(), in_room.end(), 1));
  }
  const DenseGrid& grid() const { return grid_; }

  // What TetrahedronCutter asks for.
  double value(Index node) const { return ball_ - std::min<double>(reach_.value[node], ball_ + 1); }
  Vector3 place(Index node) const { return grid_.place(node); }

 private:
  // The nodes of the cube about one that has as much room on each side, with their distances squared.
  template <class Visit>
  void each_near(Index node, Index reach, Visit visit) const {
    for (Index z = -reach; z <= reach; ++z)
      for (Index y = -reach; y <= reach; ++y)
        for (Index x = -reach; x <= reach; ++x)
          visit(node + x + y * grid_.stride(1) + z * grid_.stride(2),
                static_cast<double>(x * x + y * y + z * z));
  }

  void measure_faces() {
    const auto count = static_cast<std::size_t>(grid_.count());
    walls_.value.assign(count, std::numeric_limits<float>::infinity());
    walls_.source.assign(count, kNone);
    for (Index f = 0; f < shape_.faces.count(); ++f) {
      watch_.step();
      const Triangle t = shape_.triangle(f);
      const Vector3 low = t.a.cwiseMin(t.b).cwiseMin(t.c), high = t.a.cwiseMax(t.b).cwiseMax(t.c);
      std::array<Index, 3> from{}, to{};
      for (int k = 0; k < 3; ++k) {
        from[k] = grid_.below(low[k], k);
        to[k] = grid_.below(high[k], k) + 1;
      }
      mark_near(t, f, from, to);
    }
    spread(
        grid_, wall_ + largest_ball_ + 2, [&](Index n, Index f) { return distance_to_face(n, f); }, walls_,
        watch_);
  }
  double distance_to_face(Index node, Index f) const {
    const Vector3 p = grid_.place(node);
    return (closest_on_triangle(p, shape_.triangle(f)) - p).norm() / grid_.side();
  }
  // The nodes of a range within a cell's diagonal of the face, by halves as long as the face is near.
  void mark_near(const Triangle& t, Index f, const std::array<Index, 3>& from,
                 const std::array<Index, 3>& to) {
    const Vector3 low = grid_.place(grid_.node(from[0], from[1], from[2])),
                  high = grid_.place(grid_.node(to[0], to[1], to[2])), middle = (low + high) / 2;
    const double distance = (closest_on_triangle(middle, t) - middle).norm();
    if (distance > (high - low).norm() / 2 + 1.74 * grid_.side()) return;
    int longest = 0;
    for (int k = 1; k < 3; ++k)
      if (to[k] - from[k] > to[longest] - from[longest]) longest = k;
    if (to[longest] == from[longest]) {
      const Index node = grid_.node(from[0], from[1], from[2]);
      const auto there = static_cast<float>(distance / grid_.side());
      if (!(there < walls_.value[node])) return;
      walls_.value[node] = there;
      walls_.source[node] = f;
      return;
    }
    std::array<Index, 3> below = to, above = from;
    below[longest] = (from[longest] + to[longest]) / 2;
    above[longest] = below[longest] + 1;
    mark_near(t, f, from, below);
    mark_near(t, f, above, to);
  }

  void flood() {
    const auto fits = [&](Index n) { return walls_.value[n] >= wall_ + ball_; };
    std::vector<char> reached(walls_.value.size(), 0);
    std::vector<Index> waiting{0};
    reached[0] = 1;
    while (!waiting.empty()) {
      watch_.step();
      const Index node = waiting.back();
      waiting.pop_back();
      grid_.each_neighbour(node, [&](Index next) {
        if (reached[next] || !fits(next)) return;
        reached[next] = 1;
        waiting.push_back(next);
      });
    }
    reach_.value.assign(walls_.value.size(), std::numeric_limits<float>::infinity());
    reach_.source.assign(walls_.value.size(), kNone);
    for (Index n = 0; n < grid_.count(); ++n) {
      if (!reached[n]) continue;
      watch_.step();
      reach_.value[n] = static_cast<float>(-surplus(n));
      bool at_front = false;
      grid_.each_neighbour(n, [&](Index next) { at_front = at_front || !reached[next]; });
      if (at_front) reach_.source[n] = n;
    }
    spread(
        grid_, ball_ + 2,
        [&](Index n, Index source) {
          return (grid_.place(n) - grid_.place(source)).norm() / grid_.side() - surplus(source);
        },
        reach_, watch_);
  }
  // How much farther the walls are than the ball needs, up to the distance that is measured.
  double surplus(Index node) const {
    return std::min<double>(walls_.value[node], wall_ + ball_ + 2) - wall_ - ball_;
  }

  const SoupWalls& shape_;
  Watch& watch_;
  DenseGrid grid_;
  double wall_, largest_ball_, ball_ = 0;  // half the thickness, radii; in cells
  Distances walls_, reach_;
};

}  // namespace mspskel::detail
