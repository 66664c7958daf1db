// The collapse's cost and merging sets as a module of OpenMesh's decimaters.
#pragma once

#include <OpenMesh/Tools/Decimater/ModBaseT.hh>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "mspskel/collapse/collapse_options.h"
#include "mspskel/collapse/merging_set.h"
#include "mspskel/collapse/saturation.h"
#include "mspskel/mesh/default_mesh.h"

namespace mspskel {

// Decimates a mesh by minimum slice perimeter in any OpenMesh decimater: the priority of a collapse is the
// total cost of Eq. 4.4, the remaining vertex takes over the merging set of the removed one and moves to the
// place of Eq. 4.6.
//
//     OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
//     ModMspSkeletonT<Mesh>::Handle handle;
//     decimater.add(handle);
//     auto& module = decimater.module(handle);
//     module.set_vertices(vertices);  // one MergingVertex a mesh vertex
//     decimater.initialize();
//     decimater.decimate_to(100);
//     const std::vector<Index> node = module.node_of_vertex();  // before garbage_collection()
//
// It computes the same values as SkeletonDecimater for the same merging sets, but it does not make a
// skeleton: OpenMesh keeps a two-manifold with at least a tetrahedron a component, so no edge ever loses its
// faces, and a tube never becomes an arc; labels are not looked at, the link condition keeps every loop of
// the surface; priorities are float and are recomputed within one ring of a collapse only; of equal
// priorities the decimater takes any. Use it for a coarse skeleton mesh, for merging sets as a clustering of
// the surface, or together with other modules. One thread only.
template <class MeshT>
class ModMspSkeletonT : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(ModMspSkeletonT, MeshT, MspSkeleton)

  explicit ModMspSkeletonT(MeshT& mesh) : Base(mesh, false) { mesh.add_property(node_); }
  // The mesh keeps no property of the module.
  ~ModMspSkeletonT() override { Base::mesh().remove_property(node_); }
  ModMspSkeletonT(const ModMspSkeletonT&) = delete;
  ModMspSkeletonT& operator=(const ModMspSkeletonT&) = delete;

  // One a vertex of the mesh, by index. Lengths in the mesh's units.
  void set_vertices(std::vector<MergingVertex> vertices) { vertices_ = std::move(vertices); }
  // Of the options, lambda, angle_floor and cost apply. Throws UsageError.
  void set_options(const CollapseOptions& options) {
    validate(options);
    options_ = options;
  }
  // Whether a vertex moves to the mean of its merging set (default) or stays.
  void set_moves_points(bool moves) { moves_points_ = moves; }
  // Collapses are illegal unless the edge's saturation (Eq. 4.5) is below options.saturation_threshold. Off
  // by default: the thesis asks it of edges without faces only, which OpenMesh has not, and at the start
  // neighbours have about equal areas and saturations near 1. A threshold above 1 keeps limbs apart from what
  // they grow on by the MSP ratio.
  void set_saturation_constraint(bool on) { saturation_constraint_ = on; }

  // Called by the decimater. Throws UsageError unless set_vertices() got one entry a vertex.
  void initialize() override {
    MeshT& mesh = Base::mesh();
    if (vertices_.size() != mesh.n_vertices())
      throw UsageError("vertices: there must be one for each of the mesh's " +
                       std::to_string(mesh.n_vertices()));
    for (const auto v : mesh.all_vertices()) {
      Node& node = mesh.property(node_, v);
      node = Node{};
      node.set = MergingSet(vertices_[static_cast<std::size_t>(v.idx())]);
      refresh(node);
    }
    longest_ = 0.0;
    for (const auto e : mesh.edges()) {
      const auto h = mesh.halfedge_handle(e, 0);
      longest_ = std::max(longest_, length(mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)));
    }
  }

  float collapse_priority(const CollapseInfo& info) override {
    const Node &u = node(info.v0), &v = node(info.v1);
    if (saturation_constraint_ && !(edge_saturation(u.set, v.set) < options_.saturation_threshold))
      return static_cast<float>(Base::ILLEGAL_COLLAPSE);
    const double value = cost(info.v0, info.v1);
    return std::isnan(value) ? static_cast<float>(Base::ILLEGAL_COLLAPSE) : static_cast<float>(value);
  }

  void postprocess_collapse(const CollapseInfo& info) override {
    Node &kept = node(info.v1), &gone = node(info.v0);
    kept.set.merge(gone.set);
    gone.parent = static_cast<Index>(info.v1.idx());
    refresh(kept);
    if (moves_points_)
      for (int i = 0; i < 3; ++i)
        Base::mesh().point(info.v1)[i] = static_cast<typename MeshT::Scalar>(kept.position[i]);
  }

  // M(e) of Eq. 4.4 for the edge between two vertices, in double.
  double cost(typename MeshT::VertexHandle a, typename MeshT::VertexHandle b) const {
    const Node &u = node(a), &v = node(b);
    CostTerms terms;
    terms.perimeter_ratio = perimeter_ratio(u.perimeter, v.perimeter);
    terms.relative_length = longest_ > 0 ? length(a, b) / longest_ : 0.0;
    terms.angle = axis_angle(u.axis, v.axis);
    terms.slice_error = slice_error_metric(u.set, v.set);
    return options_.cost ? options_.cost(terms) : total_cost(terms, options_.lambda, options_.angle_floor);
  }
  const MergingSet& merging_set(typename MeshT::VertexHandle v) const { return node(v).set; }

  // For each vertex of the mesh as it was at initialize(): the index of the vertex that stands for it, itself
  // where it was never collapsed. Valid until garbage_collection() renumbers the vertices.
  std::vector<Index> node_of_vertex() const {
    std::vector<Index> result(vertices_.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
      Index v = static_cast<Index>(i);
      while (node(typename MeshT::VertexHandle(v)).parent != kNone)
        v = node(typename MeshT::VertexHandle(v)).parent;
      result[i] = v;
    }
    return result;
  }

 private:
  struct Node {
    MergingSet set;
    Vector3 position = Vector3::Zero(), axis = Vector3::Zero();
    double perimeter = 0.0;
    Index parent = kNone;
  };

  static void refresh(Node& node) {
    node.position = node.set.position();
    node.axis = node.set.axis();
    node.perimeter = node.set.perimeter();
  }
  Node& node(typename MeshT::VertexHandle v) { return Base::mesh().property(node_, v); }
  // ModBaseT hands out its mesh to non-const modules only.
  const Node& node(typename MeshT::VertexHandle v) const {
    return const_cast<ModMspSkeletonT*>(this)->node(v);
  }
  double length(typename MeshT::VertexHandle a, typename MeshT::VertexHandle b) const {
    return (node(a).position - node(b).position).norm();
  }

  OpenMesh::VPropHandleT<Node> node_;
  std::vector<MergingVertex> vertices_;
  CollapseOptions options_;
  double longest_ = 0.0;
  bool moves_points_ = true, saturation_constraint_ = false;
};

}  // namespace mspskel
