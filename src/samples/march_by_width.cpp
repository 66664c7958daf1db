#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/base/random.h"
#include "mspskel/samples/polygonise.h"
#include "tetrahedron_cut.h"

namespace mspskel {

namespace {
// Halved between its corners 0 and `tag`. The children of a child's child's child have its shape, and those
// of neighbours cut common faces alike, once both are cut (Maubach 1995).
struct TaggedTetrahedron {
  std::array<Index, 4> corner;
  int tag;
  bool halved = false;
};

class WidthMarch {
 public:
  WidthMarch(const ImplicitSolid& solid, double cell) : solid_(solid), longest_(std::sqrt(3.0) * cell) {
    const double side = 1.1 * (solid.high - solid.low).maxCoeff();
    // The shift keeps symmetric solids from meeting grid points exactly.
    const Vector3 origin = solid.low - 0.05 * side * Vector3(0.8190, 0.7548, 0.6710);
    for (int k = 0; k < 8; ++k) add_point(origin + side * Vector3(k & 1, k >> 1 & 1, k >> 2));
    constexpr std::array<std::array<Index, 4>, 6> kKuhn{
        {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 2, 3, 7}, {0, 4, 6, 7}, {0, 1, 5, 7}}};
    for (const auto& corners : kKuhn) add({corners, 3});
  }

  PolygonSoup result() {
    while (!open_.empty()) {
      const Index t = open_.back();
      open_.pop_back();
      if (!all_[t].halved && (has_cut_edge(all_[t]) || is_large(all_[t]))) halve(t);
    }
    for (const TaggedTetrahedron& t : all_)
      if (!t.halved) cut(t);
    return std::move(soup_);
  }

 private:
  using Edge = std::uint64_t;
  static Edge edge(Index a, Index b) {
    return static_cast<Edge>(std::min(a, b)) << 32 | static_cast<Edge>(std::max(a, b));
  }

  // Keys that differ in a few bits only would crowd in a table of their remainders.
  struct Mixed {
    std::size_t operator()(Edge e) const { return static_cast<std::size_t>(Random(e).next()); }
  };
  using EdgeMap = std::unordered_map<Edge, Index, Mixed>;

  Index add_point(const Vector3& p) {
    point_.push_back(p);
    value_.push_back(solid_.value(p));
    star_.emplace_back();
    return static_cast<Index>(point_.size()) - 1;
  }

  void add(const TaggedTetrahedron& t) {
    const auto number = static_cast<Index>(all_.size());
    all_.push_back(t);
    for (const Index c : t.corner) star_[c].push_back(number);
    open_.push_back(number);
  }

  // Whether the surface passes through or near it, and it is long for the solid's width.
  bool is_large(const TaggedTetrahedron& t) const {
    Vector3 middle = Vector3::Zero();
    for (const Index c : t.corner) middle += 0.25 * point_[c];
    double reach = 0;
    for (const Index c : t.corner) reach = std::max(reach, (point_[c] - middle).norm());
    if (std::abs(solid_.value(middle)) > reach) return false;
    const double length = (point_[t.corner[0]] - point_[t.corner[t.tag]]).norm();
    return length > longest_ * (solid_.width(middle) - 0.25 * reach);
  }

  bool has_cut_edge(const TaggedTetrahedron& t) const {
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j)
        if (middle_.count(edge(t.corner[i], t.corner[j])) > 0) return true;
    return false;
  }

  // x0 .. x3 gives x0 .. z .. x3, where z stands for x_tag, and x1 .. x_tag z .. x3. What shares the edge has
  // to follow.
  void halve(Index number) {
    all_[number].halved = true;
    const TaggedTetrahedron t = all_[number];
    const Index a = t.corner[0], b = t.corner[t.tag];
    const auto [place, is_new] = middle_.try_emplace(edge(a, b), static_cast<Index>(point_.size()));
    const Index z = place->second;
    if (is_new) {
      add_point(0.5 * (point_[a] + point_[b]));
      reopen(a, b);
    }
    TaggedTetrahedron left = t, right = t;
    left.halved = right.halved = false;
    left.tag = right.tag = t.tag > 1 ? t.tag - 1 : 3;
    left.corner[t.tag] = z;
    for (int i = 0; i < t.tag; ++i) right.corner[i] = t.corner[i + 1];
    right.corner[t.tag] = z;
    add(left);
    add(right);
  }

  void reopen(Index a, Index b) {
    if (star_[b].size() < star_[a].size()) std::swap(a, b);
    std::vector<Index>& star = star_[a];
    star.erase(std::remove_if(star.begin(), star.end(), [&](Index t) { return all_[t].halved; }), star.end());
    for (const Index t : star)
      if (std::count(all_[t].corner.begin(), all_[t].corner.end(), b) > 0) open_.push_back(t);
  }

  void cut(TaggedTetrahedron t) {
    const auto volume = [&] {
      const Vector3& o = point_[t.corner[0]];
      return (point_[t.corner[1]] - o).cross(point_[t.corner[2]] - o).dot(point_[t.corner[3]] - o);
    };
    if (volume() < 0) std::swap(t.corner[2], t.corner[3]);
    std::array<double, 4> value;
    for (std::size_t k = 0; k < 4; ++k) value[k] = value_[t.corner[k]];
    detail::cut_tetrahedron(soup_, value, [&](int i, int j) {
      const Index a = std::min(t.corner[i], t.corner[j]), b = std::max(t.corner[i], t.corner[j]);
      const auto [place, is_new] = vertex_.try_emplace(edge(a, b), static_cast<Index>(soup_.points.size()));
      if (is_new) soup_.points.push_back(detail::cut_point(point_[a], value_[a], point_[b], value_[b]));
      return place->second;
    });
  }

  const ImplicitSolid& solid_;
  double longest_;  // edge, in widths
  std::vector<Vector3> point_;
  std::vector<double> value_;
  std::vector<std::vector<Index>>
      star_;  // of a point: tetrahedra that have it as a corner, some of them halved
  std::vector<TaggedTetrahedron> all_;
  std::vector<Index> open_;  // to be looked at
  EdgeMap middle_, vertex_;
  PolygonSoup soup_;
};
}  // namespace

PolygonSoup march_by_width(const ImplicitSolid& solid, double cell) {
  if (!(cell > 0) || !std::isfinite(cell)) throw UsageError("cell must be a positive number");
  if (!solid.width) throw UsageError("the solid has no width to follow");
  return WidthMarch(solid, cell).result();
}

}  // namespace mspskel
