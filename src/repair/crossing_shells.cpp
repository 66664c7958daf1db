#include "crossing_shells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "disjoint_sets.h"
#include "mspskel/base/watch.h"

namespace mspskel::detail {
namespace {

// Of the smaller shell's extent, or of its width if that is less.
constexpr double kDepth = 1e-3, kDepthInWidths = 0.01;
constexpr double kSteps = 4;  // in such depths, behind a face: edges enter aslant

bool boxes_meet(const Vector3& low, const Vector3& high, const Shell& shell) {
  return (low.array() <= shell.high.array()).all() && (shell.low.array() <= high.array()).all();
}

// Where the segment pq passes through the face: the points of it a step before and behind, or at its ends.
std::optional<std::array<Vector3, 2>> passage(const SurfaceSnapshot& surface, const Vector3& p,
                                              const Vector3& q, double step, Index face) {
  const Vector3 &a = surface.position[surface.origin[3 * face]],
                &b = surface.position[surface.origin[3 * face + 1]],
                &c = surface.position[surface.origin[3 * face + 2]];
  const Vector3 normal = (b - a).cross(c - a);
  const double at_p = normal.dot(p - a), at_q = normal.dot(q - a);
  if (!(at_p * at_q < 0)) return std::nullopt;
  const double share = at_p / (at_p - at_q), reach = step / (q - p).norm();
  const Vector3 x = p + share * (q - p);
  const auto beside = [&](const Vector3& s, const Vector3& t) {
    return (t - s).cross(x - s).dot(normal) < 0;
  };
  if (beside(a, b) || beside(b, c) || beside(c, a)) return std::nullopt;
  return std::array<Vector3, 2>{p + std::max(0.0, share - reach) * (q - p),
                                p + std::min(1.0, share + reach) * (q - p)};
}

enum class CrossingDepth { kAny, kDeep };

// Finds shells that lie in one place.
class Copies {
 public:
  Copies(const SurfaceSnapshot& surface, const std::vector<Shell>& shells, Watch& watch)
      : surface_(surface), shells_(shells), watch_(watch) {}

  // Per shell the first one that it is a copy of and that is none itself; kNone.
  std::vector<Index> run() {
    const auto count = static_cast<Index>(shells_.size());
    std::vector<Index> copy_of(shells_.size(), kNone);
    for (Index c = 0; c < count; ++c)
      for (Index d = 0; d < c && copy_of[c] == kNone; ++d)
        if (copy_of[d] == kNone && are_copies(d, c)) copy_of[c] = d;
    return copy_of;
  }

 private:
  static constexpr double kCopy = 0.005;  // of the width

  bool are_copies(Index c, Index d) {
    watch_.step();
    const double most = kCopy * std::min(shells_[c].width, shells_[d].width);
    const Shell &one = shells_[c], &other = shells_[d];
    return (one.low - other.low).cwiseAbs().maxCoeff() <= most &&
           (one.high - other.high).cwiseAbs().maxCoeff() <= most && is_beside(c, d, most) &&
           is_beside(d, c, most);
  }

  bool is_beside(Index c, Index d, double most) {
    const BoundingVolumeHierarchy& walls = walls_.try_emplace(d, surface_, shells_[d].faces).first->second;
    const auto near = [&](const Vector3& p) {
      watch_.step();
      return walls.closest(p, 1.01 * most).distance <= most;
    };
    const auto corner = [&](Index f, Index k) -> const Vector3& {
      return surface_.position[surface_.origin[3 * f + k]];
    };
    return std::all_of(shells_[c].vertices.begin(), shells_[c].vertices.end(),
                       [&](Index v) { return near(surface_.position[v]); }) &&
           std::all_of(shells_[c].faces.begin(), shells_[c].faces.end(),
                       [&](Index f) { return near((corner(f, 0) + corner(f, 1) + corner(f, 2)) / 3); });
  }

  const SurfaceSnapshot& surface_;
  const std::vector<Shell>& shells_;
  Watch& watch_;
  std::map<Index, BoundingVolumeHierarchy> walls_;
};

class Crossings {
 public:
  Crossings(const SurfaceSnapshot& surface, const std::vector<Shell>& shells, CrossingDepth depth)
      : surface_(surface), shells_(shells), depth_(depth), groups_(static_cast<Index>(shells.size())) {}

  // Finds the copies where they are not known.
  void run(std::vector<Index>& copy_of, const ProgressCallback& progress) {
    const std::vector<Index> near = faces_near_others(progress);
    if (near.empty()) return;
    Watch watch(progress, "shells");
    if (copy_of.empty()) copy_of = Copies(surface_, shells_, watch).run();
    for (Index c = 0; c < static_cast<Index>(shells_.size()); ++c)
      if (copy_of[c] != kNone) groups_.unite(c, copy_of[c]);
    near_.emplace(surface_, near, progress);
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (i % 1024 == 0)
        report_progress(progress, "shells", static_cast<double>(i) / static_cast<double>(near.size()));
      pass_through(near[i]);
    }
    for (const auto& [c, d] : meetings_) {
      report_progress(progress, "shells", 1.0);
      if (groups_.root(c) != groups_.root(d) && (reaches_into(c, d, watch) || reaches_into(d, c, watch)))
        groups_.unite(c, d);
    }
  }

  std::vector<std::vector<Index>> groups() {
    std::vector<std::vector<Index>> members(shells_.size());
    for (Index c = 0; c < static_cast<Index>(shells_.size()); ++c) members[groups_.root(c)].push_back(c);
    members.erase(std::remove_if(members.begin(), members.end(), [](const auto& m) { return m.size() < 2; }),
                  members.end());
    return members;
  }

 private:
  // The faces whose box meets the box of what other shells' boxes share with that of their own: where no
  // other shell is, none passes through.
  std::vector<Index> faces_near_others(const ProgressCallback& progress) const {
    std::vector<Index> near;
    for (std::size_t c = 0; c < shells_.size(); ++c) {
      report_progress(progress, "shells", static_cast<double>(c) / static_cast<double>(shells_.size()));
      const Shell& own = shells_[c];
      Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
      for (std::size_t d = 0; d < shells_.size(); ++d) {
        if (d == c || !boxes_meet(own.low, own.high, shells_[d])) continue;
        low = low.cwiseMin(own.low.cwiseMax(shells_[d].low));
        high = high.cwiseMax(own.high.cwiseMin(shells_[d].high));
      }
      for (const Index f : own.faces) {
        const Vector3 &p = corner(f, 0), &q = corner(f, 1), &r = corner(f, 2);
        if ((p.cwiseMin(q).cwiseMin(r).array() <= high.array()).all() &&
            (p.cwiseMax(q).cwiseMax(r).array() >= low.array()).all())
          near.push_back(f);
      }
    }
    return near;
  }
  const Vector3& corner(Index f, Index k) const { return surface_.position[surface_.origin[3 * f + k]]; }

  void pass_through(Index f) {
    const Index c = surface_.component[surface_.origin[3 * f]];
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      if (h > surface_.twin[h]) continue;
      const Vector3 &p = surface_.position[surface_.origin[h]], &q = surface_.position[surface_.target(h)];
      near_->for_each_in_box(p.cwiseMin(q), p.cwiseMax(q), [&](Index g) {
        const Index d = surface_.component[surface_.origin[3 * g]];
        if (d == c || groups_.root(c) == groups_.root(d)) return true;
        const auto points = passage(surface_, p, q, kSteps * least_depth(c, d), g);
        if (!points) return true;
        if (is_deep((*points)[0], c, d) || is_deep((*points)[1], c, d))
          groups_.unite(c, d);
        else
          meetings_.insert({std::min(c, d), std::max(c, d)});
        return true;
      });
    }
  }

  // Whether a point of c lies well inside d.
  bool is_deep(const Vector3& p, Index c, Index d) {
    if (!boxes_meet(p, p, shells_[d])) return false;
    const BoundingVolumeHierarchy& solid = solids_.try_emplace(d, surface_, shells_[d].faces).first->second;
    return solid.inside(p) && solid.distance(p) > least_depth(c, d);
  }

  double least_depth(Index c, Index d) const {
    return std::min(least_depth(shells_[c]), least_depth(shells_[d]));
  }
  double least_depth(const Shell& shell) const {
    const double deep = kDepth * shell.extent();
    return depth_ == CrossingDepth::kDeep ? deep : std::min(deep, kDepthInWidths * shell.width);
  }

  bool reaches_into(Index c, Index d, Watch& watch) {
    return std::any_of(shells_[c].vertices.begin(), shells_[c].vertices.end(), [&](Index v) {
      watch.step();
      return is_deep(surface_.position[v], c, d);
    });
  }

  const SurfaceSnapshot& surface_;
  const std::vector<Shell>& shells_;
  CrossingDepth depth_;
  std::optional<BoundingVolumeHierarchy> near_;  // of the faces near other shells
  DisjointSets groups_;
  std::set<std::pair<Index, Index>> meetings_;  // pairs with an edge through a face, not deep
  std::map<Index, BoundingVolumeHierarchy> solids_;
};

}  // namespace

std::vector<Shell> shells_of(const SurfaceSnapshot& surface) {
  std::vector<Shell> shells(static_cast<std::size_t>(surface.component_count));
  for (Index v = 0; v < surface.vertex_count(); ++v) {
    if (surface.vertex_halfedge[v] == kNone) continue;
    Shell& shell = shells[surface.component[v]];
    const Vector3& p = surface.position[v];
    shell.low = shell.vertices.empty() ? p : Vector3(shell.low.cwiseMin(p));
    shell.high = shell.vertices.empty() ? p : Vector3(shell.high.cwiseMax(p));
    shell.vertices.push_back(v);
  }
  for (Index f = 0; f < surface.face_count(); ++f)
    shells[surface.component[surface.origin[3 * f]]].faces.push_back(f);
  for (Shell& shell : shells) {
    double volume = 0, area = 0;
    for (const Index f : shell.faces) {
      const Vector3 normal = surface.face_normal_times_twice_area(f);
      volume += normal.dot(surface.position[surface.origin[3 * f]] - shell.low) / 6;
      area += normal.norm() / 2;
    }
    shell.inside_out = volume < 0;
    shell.width = area > 0 ? 4 * std::abs(volume) / area : 0;
  }
  return shells;
}

CrossingShells find_crossings(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                              const ProgressCallback& progress) {
  CrossingShells found;
  Crossings crossings(surface, shells, CrossingDepth::kAny);
  crossings.run(found.copy_of, progress);
  found.groups = crossings.groups();
  return found;
}

std::vector<std::vector<Index>> deep_groups(const SurfaceSnapshot& surface, const std::vector<Shell>& shells,
                                            const std::vector<Index>& copy_of,
                                            const ProgressCallback& progress) {
  std::vector<Index> known = copy_of;
  Crossings crossings(surface, shells, CrossingDepth::kDeep);
  crossings.run(known, progress);
  return crossings.groups();
}

}  // namespace mspskel::detail
