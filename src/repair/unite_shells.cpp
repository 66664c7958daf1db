#include "mspskel/repair/unite_shells.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "crossing_shells.h"
#include "cut_union.h"
#include "disjoint_sets.h"
#include "merge_short_edges.h"
#include "mspskel/base/error.h"
#include "mspskel/mesh/build_mesh.h"
#include "shell_grid.h"
#include "split_long_edges.h"
#include "whole_pieces.h"

namespace mspskel {
namespace {

using detail::Shell;
using detail::ShellGroup;
using detail::WholePieces;

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

Fineness fineness_for(const ShellGroup& group, const UniteOptions& options) {
  constexpr double kCoarsest = 0.01, kFinest = 0.001, kCellsAcross = 3, kNodesACell = 6, kThinnest = 1e-4;
  // Few faces tell of few details.
  constexpr double kNodesAFace = 20, kFewestNodes = 6e4, kMostNodes = 3e5;
  const double extent = (group.high() - group.low()).norm();
  Fineness result;
  for (std::size_t i = 0; i < group.size(); ++i)
    result.thickness.push_back(
        std::max(kThinnest * extent, thickness(group.surface(), group.shell(i), group.solid(i))));
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

// The union of the solids of shells that cross.
class Union {
 public:
  // own: handles that the shells have.
  Union(const ShellGroup& group, Index own, const Fineness& fineness)
      : group_(group), own_(own), fineness_(fineness) {}

  // Nothing if the union has more handles than its shells have and make by crossing: an assembly of parts in
  // contact, or walls too thin for the cells.
  std::optional<WholePieces> run(const Execution& execution) {
    constexpr double kShortest = 0.15;  // edges of a cut surface that tell nothing, in thicknesses
    std::optional<WholePieces> best;
    std::size_t made = group_.size();
    std::optional<detail::CutShells> cut;
    if (!fineness_.asked) cut = detail::cut_union(group_, execution);
    if (cut) {
      split_along(*cut, fineness_.thickness, static_cast<Index>(group_.faces().size()));
      best = detail::without_crumbs(cut->soup);
      if (best->solids == 0) best.reset();
      // A tree of crossings closes no handle, each further pair may close one.
      if (cut->crossings >= made) made = std::max(made, cut->crossings + 1 - made);
    }
    const auto most = own_ + static_cast<Index>(made);
    is_cut_ = best.has_value();
    if (!best || best->genus > most) sample(best, execution);
    if (!best || best->genus > most) return std::nullopt;
    best->soup = detail::without_short_edges(
        best->soup, is_cut_ ? std::max(10 * detail::kShellShift, kShortest * fineness_.thinnest)
                            : detail::kShortEdge * fineness_.cell);
    return best;
  }
  bool is_cut() const { return is_cut_; }

 private:
  // Shells that cross hang together, and so does their union, unless parts of it are thinner than the cells.
  Index faults(const WholePieces& pieces) const {
    return std::max<Index>(0, pieces.genus - own_) + pieces.solids - 1;
  }
  // Where shells nearly touch, their own triangles leave handles that a margin closes.
  void sample(std::optional<WholePieces>& best, const Execution& execution) {
    const double cell = fineness_.cell;
    for (const double margin : {0.0, 0.5 * std::sqrt(3.0) * cell}) {
      if (best && faults(*best) == 0) return;
      WholePieces pieces = detail::without_crumbs(detail::boundary_of_union(group_, cell, margin, execution));
      if (pieces.solids == 0 || (best && faults(pieces) >= faults(*best))) continue;
      best = std::move(pieces);
      is_cut_ = false;
    }
  }

  const ShellGroup& group_;
  Index own_;
  Fineness fineness_;
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
    const BoundingVolumeHierarchy tree(part);
    for (const Index m : members) {
      united_.replaced[m] = true;
      const std::vector<Index>& vertices = shells_[m].vertices;
      parallel_for(
          static_cast<Index>(vertices.size()), "union of shells", execution, [] { return 0; },
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

}  // namespace

void validate(const UniteOptions& options) {
  if (options.cell != 0 && !(options.cell >= 0.001 && options.cell <= 0.1))
    throw UsageError("cells of united shells must be from 0.001 to 0.1 of the extent, or 0");
}

std::vector<std::vector<Index>> crossing_shells(const SurfaceSnapshot& surface, const Execution& execution) {
  if (surface.component_count < 2) return {};
  return detail::crossing_groups(surface, detail::shells_of(surface), execution.progress);
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

UnitedShells unite_shells(const SurfaceSnapshot& surface, const std::vector<std::vector<Index>>& groups,
                          const UniteOptions& options, const Execution& execution) {
  validate(options);
  const std::vector<Shell> shells = detail::shells_of(surface);
  std::vector<bool> grouped(shells.size(), false);
  for (const std::vector<Index>& group : groups)
    for (const Index m : group) grouped[m] = true;
  Uniting uniting(surface, shells);
  for (Index c = 0; c < surface.component_count; ++c)
    if (!grouped[c]) uniting.keep(c);
  const std::vector<Index> euler = twice_euler_characteristics(surface);
  for (const std::vector<Index>& members : groups) {
    Index own = 0;
    const std::vector<Index> distinct = detail::without_copies(surface, shells, members);
    if (distinct.size() == 1) {
      uniting.replace(members, own_faces(surface, shells[distinct[0]]), {}, execution);
      continue;
    }
    for (const Index m : distinct) own += (4 - euler[m]) / 4;
    const ShellGroup group(surface, shells, distinct, execution);
    const Fineness fineness = fineness_for(group, options);
    Union one(group, own, fineness);
    if (const std::optional<WholePieces> pieces = one.run(execution))
      uniting.replace(members, *pieces, one.is_cut() ? Fineness{} : fineness, execution);
    else
      uniting.leave_apart(members);
  }
  return uniting.take();
}

}  // namespace mspskel
