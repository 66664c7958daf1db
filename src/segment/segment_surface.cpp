#include "mspskel/segment/segment_surface.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "mspskel/base/error.h"
#include "mspskel/graph/check_surface_map.h"

namespace mspskel {
namespace {

// Of each face: what two of its corners agree on, else its first corner's part.
std::vector<Index> carry_to_faces(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                                  const std::vector<Index>& part_of_node) {
  std::vector<Index> part(surface.face_count());
  for (Index f = 0; f < surface.face_count(); ++f) {
    const auto corner = [&](int k) {
      return part_of_node[skeleton.node_of_vertex[surface.origin[3 * f + k]]];
    };
    part[f] = corner(1) == corner(2) ? corner(1) : corner(0);
  }
  return part;
}

// Numbers the parts that have faces anew, from the largest area to the smallest.
void number_by_area(const SurfaceSnapshot& surface, Index count, Segmentation& segmentation) {
  std::vector<double> area(count, 0.0);
  std::vector<char> used(count, 0);
  for (Index f = 0; f < surface.face_count(); ++f) {
    area[segmentation.part_of_face[f]] += surface.face_normal_times_twice_area(f).norm();
    used[segmentation.part_of_face[f]] = 1;
  }
  std::vector<Index> order(count), number(count, kNone);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return area[a] > area[b]; });
  for (const Index p : order)
    if (used[p]) number[p] = segmentation.count++;
  for (Index& p : segmentation.part_of_face) p = number[p];
  for (Index& p : segmentation.part_of_node) p = number[p];
}

}  // namespace

std::vector<NodeContact> node_contacts(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton) {
  check_surface_map(surface, skeleton);
  std::map<std::array<Index, 2>, double> length;
  for (Index f = 0; f < surface.face_count(); ++f) {
    std::array<Index, 3> node{};
    std::array<Vector3, 3> x;
    for (int k = 0; k < 3; ++k) {
      node[k] = skeleton.node_of_vertex[surface.origin[3 * f + k]];
      x[k] = surface.position[surface.origin[3 * f + k]];
    }
    const bool three = node[0] != node[1] && node[1] != node[2] && node[2] != node[0];
    const Vector3 middle = (x[0] + x[1] + x[2]) / 3;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      if (three)
        length[{std::min(node[i], node[j]), std::max(node[i], node[j])}] +=
            (middle - 0.5 * (x[i] + x[j])).norm();
      else if (node[i] == node[j] && node[k] != node[i])
        length[{std::min(node[i], node[k]), std::max(node[i], node[k])}] += 0.5 * (x[i] - x[j]).norm();
    }
  }
  std::vector<NodeContact> contacts;
  contacts.reserve(length.size());
  for (const auto& [nodes, sum] : length) contacts.push_back({nodes, surface.frame.scale * sum});
  return contacts;
}

Segmentation segment_surface(const SurfaceSnapshot& surface, const CurveSkeleton& skeleton,
                             const SegmentOptions& options) {
  validate(options.borders);
  SkeletonParts parts = find_parts(skeleton, node_contacts(surface, skeleton), options.parts);
  Segmentation segmentation;
  segmentation.part_of_face = carry_to_faces(surface, skeleton, parts.part_of_node);
  segmentation.part_of_node = std::move(parts.part_of_node);
  connect_parts(surface, segmentation.part_of_face);
  smooth_borders(surface, segmentation.part_of_face, options.borders);
  connect_parts(surface, segmentation.part_of_face);
  number_by_area(surface, parts.count, segmentation);
  return segmentation;
}

}  // namespace mspskel
