#pragma once

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>

#include "mspskel/base/error.h"
#include "mspskel/base/linkage.h"

namespace mspskel {
namespace detail {

inline void require_partition(const SurfaceSnapshot& snapshot, const CurveSkeleton& skeleton) {
  if (static_cast<Index>(skeleton.node_of_vertex.size()) != snapshot.vertex_count())
    throw UsageError("the surface map has " + std::to_string(skeleton.node_of_vertex.size()) +
                     " entries for " + std::to_string(snapshot.vertex_count()) + " vertices");
  for (Index v = 0; v < snapshot.vertex_count(); ++v) {
    const Index node = skeleton.node_of_vertex[v];
    const bool isolated = snapshot.component[v] == kNone;
    if (isolated ? node != kNone : node < 0 || node >= static_cast<Index>(skeleton.nodes.size()))
      throw UsageError("vertex " + std::to_string(v) + " maps to node " + std::to_string(node));
  }
}

// Per patch, whether it stays: the largest of its node on its component, the earliest of equals.
inline std::vector<bool> settled_patches(const SurfaceSnapshot& snapshot, const SurfacePatches& patches) {
  const Index n = static_cast<Index>(patches.node.size());
  std::vector<Index> component(n, kNone), order(n);
  for (Index v = 0; v < snapshot.vertex_count(); ++v)
    if (patches.patch_of_vertex[v] != kNone) component[patches.patch_of_vertex[v]] = snapshot.component[v];
  for (Index k = 0; k < n; ++k) order[k] = k;
  const auto key = [&](Index k) {
    return std::make_tuple(patches.node[k], component[k], -patches.area[k], k);
  };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
  std::vector<bool> settled(n, false);
  for (Index i = 0; i < n; ++i)
    settled[order[i]] = i == 0 || patches.node[order[i]] != patches.node[order[i - 1]] ||
                        component[order[i]] != component[order[i - 1]];
  return settled;
}

inline std::vector<Vector3> patch_centroids(const SurfaceSnapshot& snapshot, const SurfacePatches& patches) {
  std::vector<Vector3> sum(patches.node.size(), Vector3::Zero());
  std::vector<double> weight(patches.node.size(), 0.0);
  for (Index v = 0; v < snapshot.vertex_count(); ++v) {
    const Index k = patches.patch_of_vertex[v];
    if (k == kNone) continue;
    // Vertices without area count a little, so that a patch of such has a place too.
    const double w = snapshot.vertex_area[v] + 1e-30;
    sum[k] += w * snapshot.position[v];
    weight[k] += w;
  }
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] /= weight[k];
  return sum;
}

// Pairs of patches that touch, the first one unsettled, each pair once.
inline std::vector<std::pair<Index, Index>> touching_patches(const SurfaceSnapshot& snapshot,
                                                             const SurfacePatches& patches,
                                                             const std::vector<bool>& settled) {
  std::vector<std::pair<Index, Index>> touching;
  for (Index h = 0; h < snapshot.halfedge_count(); ++h) {
    const Index from = patches.patch_of_vertex[snapshot.origin[h]],
                to = patches.patch_of_vertex[snapshot.target(h)];
    if (from != to && !settled[from]) touching.emplace_back(from, to);
  }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  return touching;
}

// One round: where each unsettled patch that touches a settled one goes; kNone for the others.
inline std::vector<Index> choose_nodes(const SurfaceSnapshot& snapshot, const CurveSkeleton& skeleton,
                                       const std::vector<std::vector<Index>>& next,
                                       const SurfacePatches& patches, const std::vector<Vector3>& centroid,
                                       const std::vector<std::pair<Index, Index>>& touching,
                                       const std::vector<bool>& settled) {
  using Choice = std::tuple<bool, double, Index>;  // not joined, squared distance, node
  std::vector<Index> goes(patches.node.size(), kNone);
  std::vector<Choice> best(patches.node.size(), Choice(true, std::numeric_limits<double>::infinity(), 0));
  for (const auto& [from, to] : touching) {
    if (settled[from] || !settled[to]) continue;
    const Index node = patches.node[to];
    const auto& joined = next[patches.node[from]];
    const Vector3 place = snapshot.frame.to_normalised(skeleton.nodes[node].position);
    const Choice choice(!std::binary_search(joined.begin(), joined.end(), node),
                        (place - centroid[from]).squaredNorm(), node);
    if (goes[from] == kNone || choice < best[from]) {
      best[from] = choice;
      goes[from] = node;
    }
  }
  return goes;
}

// A patch whose node has come to lie next to it, by what other patches did, is part of that node's patch.
inline void settle_joined(const SurfacePatches& patches, const std::vector<std::pair<Index, Index>>& touching,
                          std::vector<bool>& settled) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [from, to] : touching) {
      if (settled[from] || !settled[to] || patches.node[from] != patches.node[to]) continue;
      settled[from] = changed = true;
    }
  }
}

// Finds the edge of a chain that is nearest to a point.
class NearestOnChain {
 public:
  NearestOnChain(const CurveSkeleton& skeleton, const Branch& branch) : branch_(branch) {
    double along = 0;
    for (const Index node : branch.nodes) {
      const Vector3& p = skeleton.nodes[node].position;
      if (!point_.empty()) along += (p - point_.back()).norm();
      point_.push_back(p);
      along_.push_back(along);
    }
  }

  // Its nearer end, in model units; of equals the first. Edges that are too far along the chain to be nearer
  // than the best so far, at first the answer before this one, are skipped: points in a sensible order look
  // at few.
  Index operator()(const Vector3& p) {
    double s = 0, least = (1 + 1e-9) * square_to(last_, p, s), near = std::sqrt(least);
    Index best = branch_.nodes[s <= 0.5 ? last_ : last_ + 1];
    for (std::size_t k = 0; k + 1 < point_.size(); ++k) {
      const double square = square_to(k, p, s);
      if (square < least) {
        least = square;
        near = std::sqrt(square);
        best = branch_.nodes[s <= 0.5 ? k : k + 1];
        last_ = k;
      } else if (square > 1.5 * least) {
        const double reach = along_[k] + (std::sqrt(square) - near) * (1 - 1e-9);
        while (k + 2 < point_.size() && along_[k + 2] < reach) ++k;
      }
    }
    return best;
  }

 private:
  // To edge k, and the share of the edge at which its nearest point lies.
  double square_to(std::size_t k, const Vector3& p, double& share) const {
    if (point_.size() == 1) return (p - point_[0]).squaredNorm();
    const Vector3 edge = point_[k + 1] - point_[k], from = p - point_[k];
    const double square = edge.squaredNorm();
    share = square > 0 ? std::min(1.0, std::max(0.0, from.dot(edge) / square)) : 0.0;
    return (share * edge - from).squaredNorm();
  }

  const Branch& branch_;
  std::vector<Vector3> point_;
  std::vector<double> along_;
  std::size_t last_ = 0;
};

}  // namespace detail

MSPSKEL_INLINE SurfacePatches find_patches(const SurfaceSnapshot& snapshot,
                                           const std::vector<Index>& node_of_vertex) {
  // Union and find in the order of storage: a walk from vertex to vertex would wait for memory. The root is
  // the first vertex of its set.
  SurfacePatches patches;
  std::vector<Index>& root = patches.patch_of_vertex;
  root.resize(snapshot.position.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (Index h = 0; h < snapshot.halfedge_count(); ++h) {
    if (h > snapshot.twin[h]) continue;
    const Index a = snapshot.origin[h], b = snapshot.target(h);
    if (node_of_vertex[a] != node_of_vertex[b]) continue;
    const Index ra = find(a), rb = find(b);
    root[std::max(ra, rb)] = std::min(ra, rb);
  }
  for (Index v = 0; v < snapshot.vertex_count(); ++v) {
    if (node_of_vertex[v] == kNone || snapshot.vertex_halfedge[v] == kNone) {
      root[v] = kNone;
      continue;
    }
    // Roots come first, and hold the patch's number from then on.
    Index& patch = root[v];
    if (patch == v) {
      patch = static_cast<Index>(patches.node.size());
      patches.node.push_back(node_of_vertex[v]);
      patches.area.push_back(0.0);
    } else {
      patch = root[patch];
    }
    patches.area[patch] += snapshot.vertex_area[v];
  }
  return patches;
}

MSPSKEL_INLINE SurfaceMapReport report_surface_map(const SurfaceSnapshot& snapshot,
                                                   const CurveSkeleton& skeleton) {
  SurfaceMapReport report;
  const Index n = static_cast<Index>(skeleton.nodes.size());
  report.patches.assign(n, 0);
  // Entries out of range and missing ones count as unmapped.
  std::vector<Index> map(snapshot.vertex_count(), kNone);
  bool isolated_mapped = false;
  for (Index v = 0; v < snapshot.vertex_count(); ++v) {
    const bool there = v < static_cast<Index>(skeleton.node_of_vertex.size());
    const Index node = there ? skeleton.node_of_vertex[v] : kNone;
    if (node >= 0 && node < n) map[v] = node;
    if (snapshot.component[v] == kNone)
      isolated_mapped = isolated_mapped || node != kNone;
    else if (map[v] == kNone)
      ++report.unmapped_vertices;
  }
  report.partition = report.unmapped_vertices == 0 && !isolated_mapped &&
                     static_cast<Index>(skeleton.node_of_vertex.size()) == snapshot.vertex_count();
  for (const Index node : find_patches(snapshot, map).node) ++report.patches[node];
  report.empty_nodes = static_cast<Index>(std::count(report.patches.begin(), report.patches.end(), 0));
  report.nodes_in_one_patch = static_cast<Index>(std::count(report.patches.begin(), report.patches.end(), 1));
  const Index used = n - report.empty_nodes;
  report.share_in_one_patch = used > 0 ? static_cast<double>(report.nodes_in_one_patch) / used : 1.0;
  return report;
}

MSPSKEL_INLINE PatchRepair make_patches_connected(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton) {
  detail::require_partition(snapshot, skeleton);
  SurfacePatches patches = find_patches(snapshot, skeleton.node_of_vertex);
  std::vector<bool> settled = detail::settled_patches(snapshot, patches);
  PatchRepair repair;
  std::vector<Index> kept(skeleton.nodes.size(), 0);
  for (std::size_t k = 0; k < settled.size(); ++k)
    if (settled[k] && ++kept[patches.node[k]] == 2) ++repair.nodes_left;
  if (std::find(settled.begin(), settled.end(), false) != settled.end()) {
    const auto next = adjacency(skeleton);
    const auto centroid = detail::patch_centroids(snapshot, patches);
    const auto touching = detail::touching_patches(snapshot, patches, settled);
    // Each component is connected and has a settled patch, so some unsettled patch touches a settled one.
    while (std::find(settled.begin(), settled.end(), false) != settled.end()) {
      const std::vector<Index> goes =
          detail::choose_nodes(snapshot, skeleton, next, patches, centroid, touching, settled);
      ++repair.rounds;
      for (std::size_t k = 0; k < goes.size(); ++k) {
        if (goes[k] == kNone) continue;
        ++repair.moved_patches;
        patches.node[k] = goes[k];
        settled[k] = true;
      }
      detail::settle_joined(patches, touching, settled);
    }
    for (Index v = 0; v < snapshot.vertex_count(); ++v) {
      const Index patch = patches.patch_of_vertex[v];
      if (patch == kNone || skeleton.node_of_vertex[v] == patches.node[patch]) continue;
      skeleton.node_of_vertex[v] = patches.node[patch];
      ++repair.moved_vertices;
    }
  }
  set_areas(snapshot, skeleton);
  return repair;
}

MSPSKEL_INLINE PatchRepair assign_vertices_to_branch_nodes(const SurfaceSnapshot& snapshot,
                                                           CurveSkeleton& skeleton,
                                                           const std::vector<Index>& branch_of_vertex,
                                                           const std::vector<Branch>& branches,
                                                           const Execution& execution) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (branches[b].nodes.empty()) throw UsageError("branch " + std::to_string(b) + " has no nodes");
    for (const Index k : branches[b].nodes)
      if (k < 0 || k >= static_cast<Index>(skeleton.nodes.size()))
        throw UsageError("branch " + std::to_string(b) + " names node " + std::to_string(k));
  }
  if (static_cast<Index>(branch_of_vertex.size()) != snapshot.vertex_count())
    throw UsageError("branch_of_vertex has " + std::to_string(branch_of_vertex.size()) + " entries for " +
                     std::to_string(snapshot.vertex_count()) + " vertices");
  std::vector<detail::NearestOnChain> nearest;
  nearest.reserve(branches.size());
  for (const Branch& branch : branches) nearest.emplace_back(skeleton, branch);
  skeleton.node_of_vertex.resize(branch_of_vertex.size(), kNone);
  parallel_for(
      snapshot.vertex_count(), "surface map", execution, [&] { return nearest; },
      [&](Index v, std::vector<detail::NearestOnChain>& own) {
        const Index b = branch_of_vertex[v];
        if (b == kNone || snapshot.component[v] == kNone) return;
        if (b < 0 || b >= static_cast<Index>(branches.size()))
          throw UsageError("vertex " + std::to_string(v) + " belongs to branch " + std::to_string(b));
        skeleton.node_of_vertex[v] = own[b](snapshot.frame.to_model(snapshot.position[v]));
      },
      detail::kMapGrain);
  return make_patches_connected(snapshot, skeleton);
}

MSPSKEL_INLINE void set_areas(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton) {
  for (SkeletonNode& node : skeleton.nodes) node.area = 0.0;
  for (Index v = 0; v < snapshot.vertex_count(); ++v)
    if (skeleton.node_of_vertex[v] != kNone)
      skeleton.nodes[skeleton.node_of_vertex[v]].area +=
          snapshot.vertex_area[v] * snapshot.frame.scale * snapshot.frame.scale;
}

}  // namespace mspskel
