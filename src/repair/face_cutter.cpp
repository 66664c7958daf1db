#include "face_cutter.h"

#include <algorithm>
#include <limits>

namespace mspskel::detail {
namespace {

constexpr int next_side(int k) { return k == 2 ? 0 : k + 1; }
constexpr int previous_side(int k) { return k == 0 ? 2 : k - 1; }

int place_of(const std::array<Index, 3>& list, Index wanted) {
  return list[0] == wanted ? 0 : list[1] == wanted ? 1 : list[2] == wanted ? 2 : -1;
}

}  // namespace

FaceCutter::FaceCutter(const Point& a, const Point& b, const Point& c)
    : point_{a, b, c}, parts_{{{0, 1, 2}, {kNone, kNone, kNone}, {0, 0, 0}}}, part_at_{0, 0, 0} {}

Index FaceCutter::add(const Point& p) {
  point_.push_back(p);
  part_at_.push_back(0);
  return static_cast<Index>(point_.size()) - 1;
}

void FaceCutter::set(Index part, const std::array<Index, 3>& corner, const std::array<Index, 3>& beside,
                     const std::array<char, 3>& kept) {
  parts_[part] = {corner, beside, kept};
  for (const Index v : corner) part_at_[v] = part;
}

void FaceCutter::point_back(Index part, Index old_part, Index new_part) {
  if (part == kNone) return;
  for (Index& beside : parts_[part].beside)
    if (beside == old_part) {
      beside = new_part;
      return;
    }
}

// Visits (part, place of v in it), until visit returns true.
template <class Visit>
void FaceCutter::each_part_at(Index v, Visit visit) const {
  const Index first = part_at_[v];
  Index part = first;
  do {  // against the clock
    const int k = place_of(parts_[part].corner, v);
    if (visit(part, k)) return;
    part = parts_[part].beside[previous_side(k)];
  } while (part != kNone && part != first);
  if (part == first) return;
  part = first;
  while (true) {
    part = parts_[part].beside[place_of(parts_[part].corner, v)];
    if (part == kNone) return;
    if (visit(part, place_of(parts_[part].corner, v))) return;
  }
}

std::pair<Index, int> FaceCutter::find_side(Index from, Index to) const {
  std::pair<Index, int> found{kNone, 0};
  each_part_at(from, [&](Index part, int k) {
    if (parts_[part].corner[next_side(k)] == to)
      found = {part, k};
    else if (parts_[part].corner[previous_side(k)] == to)
      found = {part, previous_side(k)};
    return found.first != kNone;
  });
  return found;
}

void FaceCutter::split_side(Index part, int side, Index p) {
  const Part old = parts_[part];
  const Index a = old.corner[side], b = old.corner[next_side(side)], c = old.corner[previous_side(side)];
  const Index other = old.beside[side];
  const char kept = old.kept[side];
  const auto added = static_cast<Index>(parts_.size());
  parts_.emplace_back();
  Index far_added = kNone;
  if (other != kNone) {
    const Part across = parts_[other];
    const int k = place_of(across.beside, part);
    const Index d = across.corner[previous_side(k)];
    far_added = static_cast<Index>(parts_.size());
    parts_.emplace_back();
    // across runs b, a, d.
    set(other, {p, a, d}, {part, across.beside[next_side(k)], far_added},
        {kept, across.kept[next_side(k)], 0});
    set(far_added, {b, p, d}, {added, other, across.beside[previous_side(k)]},
        {kept, 0, across.kept[previous_side(k)]});
    point_back(across.beside[previous_side(k)], other, far_added);
  }
  set(part, {a, p, c}, {other, added, old.beside[previous_side(side)]},
      {kept, 0, old.kept[previous_side(side)]});
  set(added, {p, b, c}, {far_added, old.beside[next_side(side)], part}, {kept, old.kept[next_side(side)], 0});
  point_back(old.beside[next_side(side)], part, added);
}

void FaceCutter::add_on_side(int side, const Point& p) {
  const auto [part, k] = find_side(last_[side], next_side(side));
  const Index v = add(p), apex = parts_[part].corner[previous_side(k)];
  split_side(part, k, v);
  last_[side] = v;
  improve({{v, apex}});
}

// The one that has it, by a walk; where rounding leads that round, the one that it is least outside of.
Index FaceCutter::part_with(const Point& p) const {
  Index part = found_;
  for (std::size_t steps = 0; steps <= parts_.size(); ++steps) {
    const Part& at = parts_[part];
    int out = -1;
    double most = 0;
    for (int k = 0; k < 3; ++k) {
      const double side = turn(point_[at.corner[k]], point_[at.corner[next_side(k)]], p);
      if (side < most) {
        most = side;
        out = k;
      }
    }
    if (out == -1) return found_ = part;
    if (at.beside[out] == kNone) break;
    part = at.beside[out];
  }
  double best = -std::numeric_limits<double>::infinity();
  for (Index i = 0; i < static_cast<Index>(parts_.size()); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
      least = std::min(least, turn(point_[parts_[i].corner[k]], point_[parts_[i].corner[next_side(k)]], p));
    if (least <= best) continue;
    best = least;
    part = i;
  }
  return found_ = part;
}

void FaceCutter::add_within(const Point& p) {
  const Index part = part_with(p), v = add(p);
  const Part old = parts_[part];
  const auto [a, b, c] = old.corner;
  const auto second = static_cast<Index>(parts_.size()), third = second + 1;
  parts_.resize(parts_.size() + 2);
  set(part, {a, b, v}, {old.beside[0], second, third}, {old.kept[0], 0, 0});
  set(second, {b, c, v}, {old.beside[1], third, part}, {old.kept[1], 0, 0});
  set(third, {c, a, v}, {old.beside[2], part, second}, {old.kept[2], 0, 0});
  point_back(old.beside[1], part, second);
  point_back(old.beside[2], part, third);
  improve({{a, b}, {b, c}, {c, a}});
}

bool FaceCutter::can_flip(Index part, int side) const {
  const Part &own = parts_[part], &other = parts_[own.beside[side]];
  const Index a = own.corner[side], b = own.corner[next_side(side)], c = own.corner[previous_side(side)];
  const Index d = other.corner[previous_side(place_of(other.beside, part))];
  return turn(c, a, d) > 0 && turn(d, b, c) > 0;
}

void FaceCutter::flip(Index part, int side) {
  const Index other = parts_[part].beside[side];
  const Part own = parts_[part], across = parts_[other];
  const int k = place_of(across.beside, part);
  const Index a = own.corner[side], b = own.corner[next_side(side)], c = own.corner[previous_side(side)];
  const Index d = across.corner[previous_side(k)];
  set(part, {c, a, d}, {own.beside[previous_side(side)], across.beside[next_side(k)], other},
      {own.kept[previous_side(side)], across.kept[next_side(k)], 0});
  set(other, {d, b, c}, {across.beside[previous_side(k)], own.beside[next_side(side)], part},
      {across.kept[previous_side(k)], own.kept[next_side(side)], 0});
  point_back(across.beside[next_side(k)], other, part);
  point_back(own.beside[next_side(side)], part, other);
}

// Whether the circle through the part has the corner across the side in it.
bool FaceCutter::is_thin(Index part, int side) const {
  const Part &own = parts_[part], &other = parts_[own.beside[side]];
  const Point& d = point_[other.corner[previous_side(place_of(other.beside, part))]];
  std::array<std::array<double, 3>, 3> row{};
  for (int i = 0; i < 3; ++i) {
    const double x = point_[own.corner[i]][0] - d[0], y = point_[own.corner[i]][1] - d[1];
    row[i] = {x, y, x * x + y * y};
  }
  const auto minor = [&](int i, int j) { return row[i][0] * row[j][1] - row[j][0] * row[i][1]; };
  return row[0][2] * minor(1, 2) - row[1][2] * minor(0, 2) + row[2][2] * minor(0, 1) > 0;
}

void FaceCutter::improve(std::vector<std::pair<Index, Index>> sides) {
  // Rounding may let a few flips go round in a circle.
  for (std::size_t left = 20 * point_.size(); !sides.empty() && left > 0; --left) {
    const auto [a, b] = sides.back();
    sides.pop_back();
    const auto [part, k] = find_side(a, b);
    if (part == kNone || parts_[part].beside[k] == kNone || parts_[part].kept[k]) continue;
    if (!is_thin(part, k) || !can_flip(part, k)) continue;
    const Part own = parts_[part], other = parts_[own.beside[k]];
    flip(part, k);
    for (const Part* p : {&own, &other})
      for (int i = 0; i < 3; ++i)
        if (place_of(p == &own ? other.corner : own.corner, p->corner[i]) == -1 ||
            place_of(p == &own ? other.corner : own.corner, p->corner[next_side(i)]) == -1)
          sides.emplace_back(p->corner[i], p->corner[next_side(i)]);
  }
}

bool FaceCutter::keep(Index from, Index to) {
  const auto mark = [&](Index part, int k) {
    parts_[part].kept[k] = 1;
    const Index other = parts_[part].beside[k];
    if (other != kNone) parts_[other].kept[place_of(parts_[other].beside, part)] = 1;
  };
  if (const auto [part, k] = find_side(from, to); part != kNone) {
    mark(part, k);
    return true;
  }
  // The sides across the way.
  std::vector<std::pair<Index, Index>> crossed;  // points on its right and left
  Index part = kNone;
  int side = 0;
  each_part_at(from, [&](Index at, int k) {
    const Index right = parts_[at].corner[next_side(k)], left = parts_[at].corner[previous_side(k)];
    if (!(turn(from, to, right) < 0 && turn(from, to, left) > 0)) return false;
    part = at;
    side = next_side(k);
    return true;
  });
  if (part == kNone) return false;
  while (true) {
    const Part& at = parts_[part];
    if (at.kept[side] || at.beside[side] == kNone || crossed.size() > parts_.size()) return false;
    crossed.emplace_back(at.corner[side], at.corner[next_side(side)]);
    const Index other = at.beside[side];
    const int k = place_of(parts_[other].beside, part);
    const Index apex = parts_[other].corner[previous_side(k)];
    if (apex == to) break;
    const double turned = turn(from, to, apex);
    if (turned == 0) return false;
    part = other;
    side = turned > 0 ? next_side(k) : previous_side(k);  // other runs left, right, apex
  }
  std::vector<std::pair<Index, Index>> made;
  std::size_t tries = 0;
  const std::size_t most = 50 + 10 * crossed.size() * crossed.size();
  for (std::size_t i = 0; i < crossed.size(); ++i) {
    if (++tries > most) return false;
    const auto [a, b] = crossed[i];
    const auto [at, k] = find_side(a, b);
    if (at == kNone) return false;
    if (!can_flip(at, k)) {
      crossed.emplace_back(a, b);
      continue;
    }
    flip(at, k);
    const Index c = parts_[at].corner[0], d = parts_[at].corner[2];  // the diagonal
    if ((c == from && d == to) || (c == to && d == from)) continue;
    const bool crosses =
        c != from && c != to && d != from && d != to && (turn(from, to, c) > 0) != (turn(from, to, d) > 0);
    (crosses ? crossed : made).emplace_back(c, d);
  }
  const auto [done, k] = find_side(from, to);
  if (done == kNone) return false;
  mark(done, k);
  improve(std::move(made));
  return true;
}

}  // namespace mspskel::detail
