#include "mspskel/repair/unite_shells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>

#include "crossing_shells.h"
#include "cut_union.h"
#include "disjoint_sets.h"
#include "inflated_shells.h"
#include "merge_short_edges.h"
#include "mspskel/base/error.h"
#include "mspskel/base/watch.h"
#include "mspskel/mesh/build_mesh.h"
#include "shell_grid.h"
#include "split_long_edges.h"
#include "whole_pieces.h"

namespace mspskel {
namespace {

using detail::InflatedShells;
using detail::Shell;
using detail::ShellGroup;
using detail::Watch;
using detail::WholePieces;

constexpr const char* kUnionStage = "union of shells";

// The way through the shell's solid that is longer from nine of ten of its vertices: limbs are thinner than
// most.
double thickness(const SurfaceSnapshot& surface, const Shell& shell, const BoundingVolumeHierarchy& solid) {
  constexpr std::size_t kSamples = 200, kThin = 10;
  std::vector<double> ways;
  for (std::size_t i = 0; i < shell.vertices.size(); i += 1 + shell.vertices.size() / kSamples) {
    const Index v = shell.vertices[i];
    const Vector3 inward =
        (solid.inside(surface.position[v] - 1e-6 * surface.normal[v]) ? -1 : 1) * surface.normal[v];
    if (const auto hit = solid.first_hit(surface.position[v] + 1e-6 * inward, inward))
      ways.push_back(hit->distance);
  }
  if (ways.empty()) return 0;
  std::nth_element(ways.begin(), ways.begin() + ways.size() / kThin, ways.end());
  return ways[ways.size() / kThin];
}

struct Fineness {
  std::vector<double> thickness;  // per shell
  double thinnest = 0, cell = 0;
  bool resolves = true;  // the thinnest shell
  bool asked = false;    // by the options
};

Fineness fineness_for(const ShellGroup& group, const UniteOptions& options, const Watch& watch) {
  constexpr double kCoarsest = 0.01, kFinest = 0.001, kCellsAcross = 3, kNodesACell = 6, kThinnest = 1e-4;
  // Few faces tell of few details.
  constexpr double kNodesAFace = 20, kFewestNodes = 6e4, kMostNodes = 3e5;
  const double extent = (group.high() - group.low()).norm();
  Fineness result;
  for (std::size_t i = 0; i < group.size(); ++i) {
    watch.ask();
    result.thickness.push_back(
        std::max(kThinnest * extent, thickness(group.surface(), group.shell(i), group.solid(i))));
  }
  result.thinnest = *std::min_element(result.thickness.begin(), result.thickness.end());
  const double wanted = result.thinnest / kCellsAcross;
  result.cell = options.cell * extent;
  result.asked = options.cell > 0;
  if (options.cell == 0) {
    double area = 0;
    for (const Index f : group.faces()) area += group.surface().face_normal_times_twice_area(f).norm() / 2;
    const double nodes =
        std::clamp(kNodesAFace * static_cast<double>(group.faces().size()), kFewestNodes, kMostNodes);
    const double affordable = std::sqrt(kNodesACell * area / nodes);
    result.cell =
        std::clamp(wanted, std::max(kFinest * extent, affordable), std::max(kCoarsest * extent, affordable));
  }
  result.resolves = result.cell <= wanted;
  return result;
}

// A tube of few long triangles needs vertices along it.
void split_along(detail::CutShells& cut, const std::vector<double>& thickness, Index faces) {
  constexpr double kLongest = 1.5;  // in thicknesses
  constexpr Index kMostAFace = 4, kFewest = 20000;
  std::vector<double> limit;
  for (const std::size_t shell : cut.shell) limit.push_back(kLongest * thickness[shell]);
  detail::split_long_edges(cut.soup, std::move(limit), std::max(kFewest, kMostAFace * faces));
}

// Whether no two vertices lie in one place, as readers take such for one.
bool has_separate_points(const PolygonSoup& soup) {
  constexpr double kSame = 1e-9;
  std::vector<std::array<std::int64_t, 3>> places;
  for (const Vector3& p : soup.points)
    places.push_back({std::llround(p.x() / kSame), std::llround(p.y() / kSame), std::llround(p.z() / kSame)});
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) == places.end();
}

// The union of the solids of shells that cross.
class Union {
 public:
  // own: handles that the shells have.
  Union(const ShellGroup& group, Index own, const Fineness& fineness)
      : group_(group), own_(own), most_(own + static_cast<Index>(group.size())), fineness_(fineness) {}

  // From the shells' own triangles. Where parts that touch leave slits, and these tiny handles, the shells
  // are grown until they overlap: handles that stay are openings.
  void cut(InflatedShells& inflated, const std::vector<Index>& members, const Execution& execution) {
    constexpr double kGrowth = 5e-4;
    const double extent = (group_.high() - group_.low()).norm();
    for (const double growth : {0.0, kGrowth}) {
      if (best_ && faults(*best_) == 0) return;
      add_cut(growth == 0 ? group_ : inflated.grow(members, growth * extent, execution), execution);
    }
  }
  // From a grid, unless a cut is there: the margin would close openings, too.
  void sample(const Execution& execution) {
    if (best_) return;
    const double cell = fineness_.cell;
    Watch watch(execution.progress, kUnionStage);
    // Where shells nearly touch, their own triangles leave handles that a margin closes.
    for (const double margin : {0.0, 0.5 * std::sqrt(3.0) * cell}) {
      WholePieces pieces = detail::without_crumbs(detail::boundary_of_union(group_, cell, margin, execution));
      if (pieces.genus <= most_ && is_better(pieces)) best_ = std::move(pieces);
      if (best_ && faults(*best_) == 0) break;
    }
    if (best_) best_->soup = detail::without_short_edges(best_->soup, detail::kShortEdge * cell, watch);
  }

  // Nothing if the union has more handles than its shells have and make by crossing: an assembly of parts in
  // contact, or walls too thin for the cells.
  std::optional<WholePieces> take() { return std::move(best_); }
  bool found() const { return best_.has_value(); }
  bool is_cut() const { return is_cut_; }

 private:
  // Shells that cross hang together, and so does their union, unless parts of it are thinner than the cells.
  Index faults(const WholePieces& pieces) const {
    return std::max<Index>(0, pieces.genus - own_) + pieces.solids - 1 + pieces.cavities;
  }
  bool is_better(const WholePieces& pieces) const {
    return pieces.solids > 0 && (!best_ || faults(pieces) < faults(*best_));
  }

  void add_cut(const ShellGroup& group, const Execution& execution) {
    constexpr double kShortest = 0.15;  // edges of a cut surface that tell nothing, in thicknesses
    constexpr double kPocket = 0.01;    // hollows that parts leave between them
    std::optional<detail::CutShells> cut = detail::cut_union(group, execution);
    if (!cut) return;
    Watch watch(execution.progress, kUnionStage);
    watch.ask(1.0);
    split_along(*cut, fineness_.thickness, static_cast<Index>(group.faces().size()));
    watch.ask(1.0);
    WholePieces pieces = detail::without_crumbs(cut->soup, kPocket);
    // A tree of crossings closes no handle, each further pair may close one.
    const std::size_t further = cut->crossings + 1 - std::min(cut->crossings + 1, group.size());
    const std::size_t made = std::max(group.size(), further);
    most_ = std::max(most_, own_ + static_cast<Index>(made));
    if (pieces.genus > most_ || !is_better(pieces)) return;
    pieces.soup = detail::without_short_edges(
        pieces.soup, std::max(10 * detail::kShellShift, kShortest * fineness_.thinnest), watch);
    watch.ask(1.0);
    if (!has_separate_points(pieces.soup)) return;
    best_ = std::move(pieces);
    is_cut_ = true;
  }

  const ShellGroup& group_;
  Index own_, most_;  // handles
  const Fineness& fineness_;
  std::optional<WholePieces> best_;
  bool is_cut_ = false;
};

// What of several copies stays.
WholePieces own_faces(const SurfaceSnapshot& surface, const Shell& shell) {
  WholePieces pieces;
  std::vector<Index> vertex(surface.position.size(), kNone);
  for (const Index v : shell.vertices) {
    vertex[v] = static_cast<Index>(pieces.soup.points.size());
    pieces.soup.points.push_back(surface.position[v]);
  }
  for (const Index f : shell.faces)
    pieces.soup.add_triangle(vertex[surface.origin[3 * f]], vertex[surface.origin[3 * f + 1]],
                             vertex[surface.origin[3 * f + 2]]);
  pieces.solids = 1;
  return pieces;
}

class Uniting {
 public:
  Uniting(const SurfaceSnapshot& surface, const std::vector<Shell>& shells)
      : surface_(surface), shells_(shells) {
    united_.replaced.assign(shells.size(), false);
    united_.vertex_of.assign(surface.position.size(), kNone);
  }

  void keep(Index component) {
    for (const Index v : shells_[component].vertices) {
      united_.vertex_of[v] = static_cast<Index>(united_.soup.points.size());
      united_.soup.points.push_back(surface_.frame.to_model(surface_.position[v]));
    }
    for (const Index f : shells_[component].faces)
      united_.soup.add_triangle(united_.vertex_of[surface_.origin[3 * f]],
                                united_.vertex_of[surface_.origin[3 * f + 1]],
                                united_.vertex_of[surface_.origin[3 * f + 2]]);
  }

  void replace(const std::vector<Index>& members, const WholePieces& pieces, const Fineness& fineness,
               const Execution& execution) {
    const auto first = static_cast<Index>(united_.soup.points.size());
    for (const Vector3& p : pieces.soup.points) united_.soup.points.push_back(surface_.frame.to_model(p));
    for (std::size_t i = 0; i < pieces.soup.corners.size(); i += 3)
      united_.soup.add_triangle(first + pieces.soup.corners[i], first + pieces.soup.corners[i + 1],
                                first + pieces.soup.corners[i + 2]);
    const SurfaceSnapshot part = make_snapshot(build_mesh(pieces.soup));
    report_progress(execution.progress, kUnionStage, 1.0);
    const BoundingVolumeHierarchy tree(part);
    for (const Index m : members) {
      united_.replaced[m] = true;
      const std::vector<Index>& vertices = shells_[m].vertices;
      parallel_for(
          static_cast<Index>(vertices.size()), kUnionStage, execution, [] { return 0; },
          [&](Index i, int&) {
            united_.vertex_of[vertices[i]] =
                first + nearest_vertex(part, tree, part.frame.to_normalised(surface_.position[vertices[i]]));
          },
          256);
    }
    united_.shells += static_cast<Index>(members.size());
    united_.solids += pieces.solids;
    united_.cell = std::max(united_.cell, fineness.cell * surface_.frame.scale);
    united_.resolved = united_.resolved && fineness.resolves;
  }

  void leave_apart(const std::vector<Index>& members) {
    for (const Index m : members) keep(m);
    united_.left_apart += static_cast<Index>(members.size());
  }

  UnitedShells take() {
    if (united_.shells == 0) united_.soup = {};
    return std::move(united_);
  }

 private:
  static Index nearest_vertex(const SurfaceSnapshot& part, const BoundingVolumeHierarchy& tree,
                              const Vector3& p) {
    const Index face = tree.closest(p).face;
    Index best = part.origin[3 * face];
    for (Index h = 3 * face + 1; h < 3 * face + 3; ++h)
      if ((part.position[part.origin[h]] - p).squaredNorm() < (part.position[best] - p).squaredNorm())
        best = part.origin[h];
    return best;
  }

  const SurfaceSnapshot& surface_;
  const std::vector<Shell>& shells_;
  UnitedShells united_;
};

class Groups {
 public:
  Groups(const SurfaceSnapshot& surface, const std::vector<Shell>& shells, const CrossingShells& crossing,
         const UniteOptions& options, const Execution& execution, Uniting& uniting)
      : surface_(surface),
        shells_(shells),
        crossing_(crossing),
        options_(options),
        execution_(execution),
        uniting_(uniting),
        euler_(twice_euler_characteristics(surface)),
        inflated_(surface, shells) {}

  void run() {
    for (const std::vector<Index>& members : crossing_.groups) unite(members, true);
  }

 private:
  // Where the cut fails, shells that cross less than a grid can tell stay apart.
  void unite(const std::vector<Index>& members, bool may_part) {
    std::vector<Index> distinct;
    for (const Index m : members)
      if (crossing_.copy_of[m] == kNone) distinct.push_back(m);
    if (distinct.size() == 1) {
      uniting_.replace(members, own_faces(surface_, shells_[distinct[0]]), {}, execution_);
      return;
    }
    Index own = 0;
    for (const Index m : distinct) own += (4 - euler_[m]) / 4;
    const ShellGroup group(surface_, shells_, distinct, execution_);
    const Fineness fineness = fineness_for(group, options_, Watch(execution_.progress, kUnionStage));
    Union one(group, own, fineness);
    if (!fineness.asked) one.cut(inflated_, distinct, execution_);
    if (!one.found() && may_part) {
      const std::vector<std::vector<Index>> parts = deep_parts(members);
      if (parts.size() > 1) {
        for (const std::vector<Index>& part : parts)
          if (part.size() > 1)
            unite(part, false);
          else
            uniting_.keep(part[0]);
        return;
      }
    }
    one.sample(execution_);
    const bool is_cut = one.is_cut();
    if (const std::optional<WholePieces> pieces = one.take())
      uniting_.replace(members, *pieces, is_cut ? Fineness{} : fineness, execution_);
    else
      uniting_.leave_apart(members);
  }

  std::vector<std::vector<Index>> deep_parts(const std::vector<Index>& members) {
    if (part_of_.empty()) {
      part_of_.resize(shells_.size());
      std::iota(part_of_.begin(), part_of_.end(), 0);
      for (const std::vector<Index>& part :
           detail::deep_groups(surface_, shells_, crossing_.copy_of, execution_.progress))
        for (const Index m : part) part_of_[m] = part[0];
    }
    std::map<Index, std::vector<Index>> by_part;
    for (const Index m : members) by_part[part_of_[m]].push_back(m);
    std::vector<std::vector<Index>> parts;
    for (auto& [first, part] : by_part) parts.push_back(std::move(part));
    return parts;
  }

  const SurfaceSnapshot& surface_;
  const std::vector<Shell>& shells_;
  const CrossingShells& crossing_;
  const UniteOptions& options_;
  const Execution& execution_;
  Uniting& uniting_;
  std::vector<Index> euler_;  // twice, per shell
  InflatedShells inflated_;
  std::vector<Index> part_of_;  // per shell: the first of those that it crosses deeply
};

}  // namespace

void validate(const UniteOptions& options) {
  if (options.cell != 0 && !(options.cell >= 0.001 && options.cell <= 0.1))
    throw UsageError("cells of united shells must be from 0.001 to 0.1 of the extent, or 0");
}

CrossingShells crossing_shells(const SurfaceSnapshot& surface, const Execution& execution) {
  if (surface.component_count < 2) return {};
  return detail::find_crossings(surface, detail::shells_of(surface), execution.progress);
}

bool has_repeated_shells(const SurfaceSnapshot& surface) {
  if (surface.component_count < 2) return false;
  const auto before = [](const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::vector<std::vector<Vector3>> places;
  for (const Shell& shell : detail::shells_of(surface)) {
    std::vector<Vector3>& own = places.emplace_back();
    for (const Index v : shell.vertices) own.push_back(surface.position[v]);
    std::sort(own.begin(), own.end(), before);
  }
  std::sort(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), before);
  });
  return std::adjacent_find(places.begin(), places.end()) != places.end();
}

UnitedShells unite_shells(const SurfaceSnapshot& surface, const CrossingShells& crossing,
                          const UniteOptions& options, const Execution& execution) {
  validate(options);
  const std::vector<Shell> shells = detail::shells_of(surface);
  std::vector<bool> grouped(shells.size(), false);
  for (const std::vector<Index>& group : crossing.groups)
    for (const Index m : group) grouped[m] = true;
  Uniting uniting(surface, shells);
  for (Index c = 0; c < surface.component_count; ++c)
    if (!grouped[c]) uniting.keep(c);
  Groups(surface, shells, crossing, options, execution, uniting).run();
  return uniting.take();
}

}  // namespace mspskel
