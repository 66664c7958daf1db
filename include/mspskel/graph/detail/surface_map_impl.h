#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "mspskel/base/error.h"

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

// One round: where each unsettled patch that touches a settled one goes; kNone for the others.
inline std::vector<Index> choose_nodes(const SurfaceSnapshot& snapshot, const CurveSkeleton& skeleton,
                                       const std::vector<std::vector<Index>>& next,
                                       const SurfacePatches& patches, const std::vector<bool>& settled) {
  using Choice = std::tuple<bool, double, Index>;  // not joined, squared distance, node
  const auto centroid = patch_centroids(snapshot, patches);
  std::vector<Index> goes(patches.node.size(), kNone);
  std::vector<Choice> best(patches.node.size(), Choice(true, std::numeric_limits<double>::infinity(), 0));
  for (Index h = 0; h < snapshot.halfedge_count(); ++h) {
    const Index from = patches.patch_of_vertex[snapshot.origin[h]],
                to = patches.patch_of_vertex[snapshot.target(h)];
    if (from == to || settled[from] || !settled[to]) continue;
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

// The nearer end of the edge of the chain that is nearest to p (model units).
inline Index nearest_chain_node(const CurveSkeleton& skeleton, const Branch& branch, const Vector3& p) {
  Index best = branch.nodes[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < branch.nodes.size(); ++k) {
    const Vector3 &a = skeleton.nodes[branch.nodes[k]].position,
                  &b = skeleton.nodes[branch.nodes[k + 1]].position;
    const double square = (b - a).squaredNorm();
    const double s = square > 0 ? std::min(1.0, std::max(0.0, (p - a).dot(b - a) / square)) : 0.0;
    const double d = (a + s * (b - a) - p).squaredNorm();
    if (d < least) {
      least = d;
      best = branch.nodes[s <= 0.5 ? k : k + 1];
    }
  }
  return best;
}

}  // namespace detail

inline SurfacePatches find_patches(const SurfaceSnapshot& snapshot,
                                   const std::vector<Index>& node_of_vertex) {
  SurfacePatches patches;
  patches.patch_of_vertex.assign(snapshot.vertex_count(), kNone);
  std::vector<Index> stack;
  for (Index seed = 0; seed < snapshot.vertex_count(); ++seed) {
    const Index node = node_of_vertex[seed];
    if (node == kNone || patches.patch_of_vertex[seed] != kNone || snapshot.vertex_halfedge[seed] == kNone)
      continue;
    const Index patch = static_cast<Index>(patches.node.size());
    patches.node.push_back(node);
    patches.area.push_back(0.0);
    patches.patch_of_vertex[seed] = patch;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Index v = stack.back(), first = snapshot.vertex_halfedge[v];
      stack.pop_back();
      patches.area.back() += snapshot.vertex_area[v];
      Index h = first;
      do {
        const Index w = snapshot.target(h);
        if (node_of_vertex[w] == node && patches.patch_of_vertex[w] == kNone) {
          patches.patch_of_vertex[w] = patch;
          stack.push_back(w);
        }
        h = snapshot.next_outgoing(h);
      } while (h != first);
    }
  }
  return patches;
}

inline SurfaceMapReport report_surface_map(const SurfaceSnapshot& snapshot, const CurveSkeleton& skeleton) {
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

inline PatchRepair make_patches_connected(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton) {
  detail::require_partition(snapshot, skeleton);
  const auto next = adjacency(skeleton);
  PatchRepair repair;
  for (;;) {
    const SurfacePatches patches = find_patches(snapshot, skeleton.node_of_vertex);
    const std::vector<bool> settled = detail::settled_patches(snapshot, patches);
    if (std::find(settled.begin(), settled.end(), false) == settled.end()) break;
    // Each component is connected and has a settled patch, so some unsettled patch touches a settled one.
    const std::vector<Index> goes = detail::choose_nodes(snapshot, skeleton, next, patches, settled);
    ++repair.rounds;
    repair.moved_patches += static_cast<Index>(goes.size() - std::count(goes.begin(), goes.end(), kNone));
    for (Index v = 0; v < snapshot.vertex_count(); ++v) {
      const Index patch = patches.patch_of_vertex[v];
      if (patch == kNone || goes[patch] == kNone) continue;
      skeleton.node_of_vertex[v] = goes[patch];
      ++repair.moved_vertices;
    }
  }
  const SurfaceMapReport report = report_surface_map(snapshot, skeleton);
  repair.nodes_left = static_cast<Index>(
      std::count_if(report.patches.begin(), report.patches.end(), [](Index k) { return k > 1; }));
  set_areas(snapshot, skeleton);
  return repair;
}

inline PatchRepair assign_vertices_to_branch_nodes(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton,
                                                   const std::vector<Index>& branch_of_vertex,
                                                   const std::vector<Branch>& branches) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    if (branches[b].nodes.empty()) throw UsageError("branch " + std::to_string(b) + " has no nodes");
    for (const Index k : branches[b].nodes)
      if (k < 0 || k >= static_cast<Index>(skeleton.nodes.size()))
        throw UsageError("branch " + std::to_string(b) + " names node " + std::to_string(k));
  }
  if (static_cast<Index>(branch_of_vertex.size()) != snapshot.vertex_count())
    throw UsageError("branch_of_vertex has " + std::to_string(branch_of_vertex.size()) + " entries for " +
                     std::to_string(snapshot.vertex_count()) + " vertices");
  skeleton.node_of_vertex.resize(branch_of_vertex.size(), kNone);
  for (Index v = 0; v < snapshot.vertex_count(); ++v) {
    const Index b = branch_of_vertex[v];
    if (b == kNone || snapshot.component[v] == kNone) continue;
    if (b < 0 || b >= static_cast<Index>(branches.size()))
      throw UsageError("vertex " + std::to_string(v) + " belongs to branch " + std::to_string(b));
    skeleton.node_of_vertex[v] =
        detail::nearest_chain_node(skeleton, branches[b], snapshot.frame.to_model(snapshot.position[v]));
  }
  return make_patches_connected(snapshot, skeleton);
}

inline void set_areas(const SurfaceSnapshot& snapshot, CurveSkeleton& skeleton) {
  for (SkeletonNode& node : skeleton.nodes) node.area = 0.0;
  for (Index v = 0; v < snapshot.vertex_count(); ++v)
    if (skeleton.node_of_vertex[v] != kNone)
      skeleton.nodes[skeleton.node_of_vertex[v]].area +=
          snapshot.vertex_area[v] * snapshot.frame.scale * snapshot.frame.scale;
}

}  // namespace mspskel
