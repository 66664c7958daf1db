#include "triangulate.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <unordered_set>

namespace mspskel::detail {
namespace {

// Edges that exist already: a diagonal along one of them would give it more than two faces. Only looked up,
// never iterated.
class EdgeSet {
 public:
  explicit EdgeSet(const PolygonSoup& soup) {
    edges_.reserve(soup.corners.size());
    for (std::size_t f = 0; f < soup.polygon_count(); ++f)
      for (Index i = soup.begin[f], last = soup.begin[f + 1] - 1; i <= last; ++i)
        insert(soup.corners[i], soup.corners[i == last ? soup.begin[f] : i + 1]);
  }
  void insert(Index a, Index b) { edges_.insert(key(a, b)); }
  bool contains(Index a, Index b) const { return edges_.count(key(a, b)) > 0; }

 private:
  static std::uint64_t key(Index a, Index b) {
    return std::uint64_t{static_cast<std::uint32_t>(std::min(a, b))} << 32 |
           static_cast<std::uint32_t>(std::max(a, b));
  }
  std::unordered_set<std::uint64_t> edges_;
};

// Corners of one polygon and the direction that its plane faces (Newell's normal, which no concave corner
// misleads).
class Polygon {
 public:
  Polygon(const std::vector<Vector3>& points, const Index* corners, Index size)
      : points_(points), corners_(corners), size_(size) {
    Vector3 normal = Vector3::Zero();
    for (Index i = 1; i + 1 < size; ++i) normal += (at(i) - at(0)).cross(at(i + 1) - at(0));
    normal_ = normal.normalized();
  }
  Index size() const { return size_; }
  Index vertex(Index i) const { return corners_[i]; }
  const Vector3& at(Index i) const { return points_[corners_[i]]; }
  double twice_area(Index i, Index j, Index k) const {
    return normal_.dot((at(j) - at(i)).cross(at(k) - at(i)));
  }
  // Free of scale: largest for equilateral triangles, negative for those that face the other way.
  double shape(Index i, Index j, Index k) const {
    const double squares =
        (at(j) - at(i)).squaredNorm() + (at(k) - at(j)).squaredNorm() + (at(i) - at(k)).squaredNorm();
    return squares > 0 ? twice_area(i, j, k) / squares : 0;
  }

 private:
  const std::vector<Vector3>& points_;
  const Index* corners_;
  Index size_;
  Vector3 normal_;
};

class EarClipper {
 public:
  EarClipper(const Polygon& polygon, EdgeSet& edges, std::vector<Index>& out)
      : polygon_(polygon),
        edges_(edges),
        out_(out),
        next_(polygon.size()),
        previous_(polygon.size()),
        rank_(polygon.size()) {}

  void run() {
    const Index n = polygon_.size();
    for (Index i = 0; i < n; ++i) {
      next_[i] = i + 1 == n ? 0 : i + 1;
      previous_[i] = i == 0 ? n - 1 : i - 1;
    }
    for (Index i = 0; i < n; ++i)
      if (!is_convex(i)) concave_.push_back(i);
    for (Index i = 0; i < n; ++i) add(i);
    for (Index left = n; left > 3; --left) clip(std::get<2>(*queue_.rbegin()));
    emit(std::get<2>(*queue_.rbegin()));
  }

 private:
  // Best last: whether it is a proper ear, its shape, and the corner's place in the polygon.
  using Rank = std::tuple<int, double, Index>;

  bool is_convex(Index i) const { return polygon_.twice_area(previous_[i], i, next_[i]) > 0; }
  bool is_empty(Index i) const {
    const Index a = previous_[i], c = next_[i];
    for (const Index p : concave_) {
      if (p == a || p == i || p == c || next_[p] == kNone) continue;
      if (polygon_.at(p) == polygon_.at(a) || polygon_.at(p) == polygon_.at(c)) continue;
      if (polygon_.twice_area(a, i, p) >= 0 && polygon_.twice_area(i, c, p) >= 0 &&
          polygon_.twice_area(c, a, p) >= 0)
        return false;
    }
    return true;
  }
  void add(Index i) {
    const Index a = previous_[i], c = next_[i];
    int grade = 0;
    if (is_convex(i)) grade = is_empty(i) ? 2 : 1;
    if (!edges_.contains(polygon_.vertex(a), polygon_.vertex(c))) grade += 3;
    rank_[i] = {grade, polygon_.shape(a, i, c), i};
    queue_.insert(rank_[i]);
  }
  void emit(Index i) {
    for (const Index k : {previous_[i], i, next_[i]}) out_.push_back(polygon_.vertex(k));
  }
  void clip(Index i) {
    emit(i);
    const Index a = previous_[i], c = next_[i];
    edges_.insert(polygon_.vertex(a), polygon_.vertex(c));
    next_[a] = c;
    previous_[c] = a;
    next_[i] = kNone;
    queue_.erase(rank_[i]);
    concave_.erase(std::remove_if(concave_.begin(), concave_.end(),
                                  [&](Index p) { return next_[p] == kNone || is_convex(p); }),
                   concave_.end());
    for (const Index k : {a, c}) {
      queue_.erase(rank_[k]);
      add(k);
    }
  }

  const Polygon& polygon_;
  EdgeSet& edges_;
  std::vector<Index>& out_;
  std::vector<Index> next_, previous_, concave_;
  std::vector<Rank> rank_;
  std::set<Rank> queue_;
};

//   d --- c      the diagonal a-c leaves abc and acd, the diagonal b-d leaves abd and bcd
//   |     |
//   a --- b
void cut_quad(const Polygon& q, EdgeSet& edges, std::vector<Index>& out) {
  const double ac = std::min(q.shape(0, 1, 2), q.shape(0, 2, 3)),
               bd = std::min(q.shape(0, 1, 3), q.shape(1, 2, 3));
  const bool ac_taken = edges.contains(q.vertex(0), q.vertex(2)),
             bd_taken = edges.contains(q.vertex(1), q.vertex(3));
  // Near ties (every rectangle) go to the smallest index, so that rounding does not decide.
  constexpr double kTie = 1e-9;
  bool use_ac = ac > bd;
  if (std::abs(ac - bd) <= kTie)
    use_ac = std::min(q.vertex(0), q.vertex(2)) < std::min(q.vertex(1), q.vertex(3));
  if (ac_taken != bd_taken) use_ac = bd_taken;
  edges.insert(q.vertex(use_ac ? 0 : 1), q.vertex(use_ac ? 2 : 3));
  const std::array<Index, 6> corners =
      use_ac ? std::array<Index, 6>{0, 1, 2, 0, 2, 3} : std::array<Index, 6>{0, 1, 3, 1, 2, 3};
  for (const Index k : corners) out.push_back(q.vertex(k));
}

}  // namespace

Triangulation triangulate(const PolygonSoup& soup) {
  Triangulation result;
  if (soup.corners.size() == 3 * soup.polygon_count()) {  // no polygon has fewer than three
    result.corners = soup.corners;
    return result;
  }
  EdgeSet edges(soup);
  for (std::size_t f = 0; f < soup.polygon_count(); ++f) {
    const Index* corners = soup.corners.data() + soup.begin[f];
    const Index size = soup.begin[f + 1] - soup.begin[f];
    if (size == 3) {
      result.corners.insert(result.corners.end(), corners, corners + 3);
    } else {
      ++result.cut_polygons;
      const Polygon polygon(soup.points, corners, size);
      if (size == 4)
        cut_quad(polygon, edges, result.corners);
      else
        EarClipper(polygon, edges, result.corners).run();
    }
    result.polygon_of_triangle.resize(result.corners.size() / 3, static_cast<Index>(f));
  }
  return result;
}

}  // namespace mspskel::detail
