#include <array>
#include <cmath>
#include <vector>

#include "mspskel/base/error.h"
#include "mspskel/mesh/default_mesh.h"
#include "mspskel/samples/polygonise.h"

namespace mspskel {

namespace {

struct Traits : DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::None);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Point = Mesh::Point;
using VertexHandle = Mesh::VertexHandle;
using HalfedgeHandle = Mesh::HalfedgeHandle;
using EdgeHandle = Mesh::EdgeHandle;

constexpr double kLongest = 4.0 / 3,
                 kShortest = 0.7;     // of the wanted edge length: Botsch, Kobbelt 2004, sections 4
constexpr double kLeastCosine = 0.5;  // between a face and the solid's surface, as far as steps decide
constexpr double kFarthest = 0.05;    // of a relaxed vertex from the surface, edge lengths

class Remesher {
 public:
  Remesher(const PolygonSoup& soup, const ImplicitSolid& solid, const RemeshOptions& options)
      : solid_(solid), options_(options) {
    mesh_.add_property(edge_);
    for (const Vector3& p : soup.points) set_edge(mesh_.add_vertex({p.x(), p.y(), p.z()}));
    for (std::size_t c = 0; c < soup.corners.size(); c += 3)
      mesh_.add_face(VertexHandle(soup.corners[c]), VertexHandle(soup.corners[c + 1]),
                     VertexHandle(soup.corners[c + 2]));
  }

  PolygonSoup run() {
    measure_normals(0);
    for (int round = 0; round < options_.rounds; ++round) {
      const std::size_t count = mesh_.n_vertices();
      split_long_edges();
      measure_normals(count);
      collapse_short_edges();
      flip_edges();
      relax(round + 1 < options_.rounds ? 1 : 2);
    }
    mesh_.garbage_collection();
    PolygonSoup result;
    for (const auto v : mesh_.vertices()) result.points.push_back(to_vector3(mesh_.point(v)));
    for (const auto f : mesh_.faces()) {
      auto v = mesh_.cfv_iter(f);
      const Index a = (v++)->idx(), b = (v++)->idx(), c = v->idx();
      result.add_triangle(a, b, c);
    }
    return result;
  }

 private:
  static Point normal(const Point& a, const Point& b, const Point& c) { return (b - a) % (c - a); }
  // The cosine of the angle between a triangle and the solid's surface at its corners; points may differ from
  // the corners'.
  static double cosine(const Point& n, const Point& up) {
    const double size = n.norm() * up.norm();
    return size > 0 ? (n | up) / size : -1.0;
  }
  Point up(VertexHandle a, VertexHandle b, VertexHandle c) const {
    return mesh_.normal(a) + mesh_.normal(b) + mesh_.normal(c);
  }
  // Whether a step that changes a face's normal so leaves it steep on the surface, and no less steep than it
  // was.
  static bool turns(const Point& before, const Point& after, const Point& up) {
    const double result = cosine(after, up);
    return result < kLeastCosine && result <= cosine(before, up);
  }
  Point apex(HalfedgeHandle h) const {
    return mesh_.point(mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)));
  }
  // The wanted edge length at a vertex.
  double edge(VertexHandle v) const { return mesh_.property(edge_, v); }
  void set_edge(VertexHandle v) {
    mesh_.property(edge_, v) =
        options_.by_width ? options_.edge * solid_.width(to_vector3(mesh_.point(v))) : options_.edge;
  }
  double edge(VertexHandle a, VertexHandle b) const { return 0.5 * (edge(a) + edge(b)); }
  double wanted_length(EdgeHandle e) const {
    const auto h = mesh_.halfedge_handle(e, 0);
    return edge(mesh_.from_vertex_handle(h), mesh_.to_vertex_handle(h));
  }
  double length(EdgeHandle e) const {
    const auto h = mesh_.halfedge_handle(e, 0);
    return (mesh_.point(mesh_.to_vertex_handle(h)) - mesh_.point(mesh_.from_vertex_handle(h))).norm();
  }

  void split_long_edges() {
    const std::size_t count = mesh_.n_edges();
    for (std::size_t i = 0; i < count; ++i) {
      const EdgeHandle e(static_cast<int>(i));
      if (mesh_.status(e).deleted() || length(e) <= kLongest * wanted_length(e)) continue;
      const auto h = mesh_.halfedge_handle(e, 0);
      const VertexHandle middle = mesh_.add_vertex(
          0.5 * (mesh_.point(mesh_.to_vertex_handle(h)) + mesh_.point(mesh_.from_vertex_handle(h))));
      set_edge(middle);
      mesh_.split(e, middle);
    }
  }

  // v0 goes to v1's place: no face round v0 may turn much, no edge may become long.
  bool may_collapse(HalfedgeHandle h) {
    const VertexHandle v0 = mesh_.from_vertex_handle(h), v1 = mesh_.to_vertex_handle(h);
    const Point& target = mesh_.point(v1);
    for (auto it = mesh_.cvoh_iter(v0); it.is_valid(); ++it) {
      const VertexHandle b = mesh_.to_vertex_handle(*it);
      if (b == v1) continue;
      if ((mesh_.point(b) - target).norm() > kLongest * edge(b, v1)) return false;
      const VertexHandle c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(*it));
      if (c == v1) continue;
      const Point &pb = mesh_.point(b), &pc = mesh_.point(c);
      if (turns(normal(mesh_.point(v0), pb, pc), normal(target, pb, pc), up(v1, b, c))) return false;
    }
    return mesh_.is_collapse_ok(h);
  }

  // Whether one of the edge's faces looks into the solid: no small step mends that, the face has to go.
  bool beside_fold(EdgeHandle e) const {
    for (unsigned side = 0; side < 2; ++side) {
      const auto h = mesh_.halfedge_handle(e, side);
      const VertexHandle a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h),
                         c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h));
      if (cosine(normal(mesh_.point(a), mesh_.point(b), mesh_.point(c)), up(a, b, c)) < 0.2) return true;
    }
    return false;
  }

  void collapse_short_edges() {
    const std::size_t count = mesh_.n_edges();
    for (std::size_t i = 0; i < count; ++i) {
      const EdgeHandle e(static_cast<int>(i));
      if (mesh_.status(e).deleted() || (length(e) >= kShortest * wanted_length(e) && !beside_fold(e)))
        continue;
      for (unsigned side = 0; side < 2; ++side)
        if (const auto h = mesh_.halfedge_handle(e, side); may_collapse(h)) {
          mesh_.collapse(h);
          break;
        }
    }
    mesh_.garbage_collection();
  }

  // How far the valences of an edge's ends a, b and its two apexes c, d are from six, squared.
  //      c
  //     / \.        a flip takes one from a and b
  //    a - b         and gives it to c and d
  //     \ /
  //      d
  static int excess(const std::array<int, 4>& valence, int flips) {
    int sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const int x = valence[i] - 6 + (i < 2 ? -flips : flips);
      sum += x * x;
    }
    return sum;
  }

  // Valences toward six, where the two faces are flat enough for either diagonal.
  void flip_edges() {
    std::vector<int> valence(mesh_.n_vertices(), 0);
    for (const auto h : mesh_.halfedges()) ++valence[mesh_.to_vertex_handle(h).idx()];
    for (const auto e : mesh_.edges()) {
      const auto h = mesh_.halfedge_handle(e, 0), o = mesh_.halfedge_handle(e, 1);
      const VertexHandle a = mesh_.from_vertex_handle(h), b = mesh_.to_vertex_handle(h);
      const VertexHandle c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(h)),
                         d = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(o));
      const std::array<int, 4> around{valence[a.idx()], valence[b.idx()], valence[c.idx()], valence[d.idx()]};
      if (excess(around, 1) >= excess(around, 0) || !may_flip(a, b, c, d) || !mesh_.is_flip_ok(e)) continue;
      mesh_.flip(e);
      --valence[a.idx()], --valence[b.idx()], ++valence[c.idx()], ++valence[d.idx()];
    }
  }

  bool may_flip(VertexHandle a, VertexHandle b, VertexHandle c, VertexHandle d) const {
    const Point &pa = mesh_.point(a), &pb = mesh_.point(b), &pc = mesh_.point(c), &pd = mesh_.point(d);
    const Point left = normal(pa, pb, pc), right = normal(pb, pa, pd), outward = up(a, b, c) + up(b, a, d);
    if (cosine(left, right) < kLeastCosine) return false;
    return !turns(left + right, normal(pa, pd, pc), outward) &&
           !turns(left + right, normal(pb, pc, pd), outward);
  }

  // Forward differences over a hundredth of an edge.
  Vector3 gradient(const Vector3& p, double value, double edge) const {
    const double step = 0.01 * edge;
    Vector3 result;
    for (Eigen::Index k = 0; k < 3; ++k) {
      Vector3 q = p;
      q[k] += step;
      result[k] = (solid_.value(q) - value) / step;
    }
    return result;
  }

  // Newton steps along the gradient. `up` receives the direction of the last one.
  Vector3 projected(Vector3 p, int steps, double edge, Vector3& up) const {
    for (int i = 0; i < steps; ++i) {
      const double value = solid_.value(p);
      up = gradient(p, value, edge);
      if (up.squaredNorm() < 0.01) return p;
      Vector3 move = -value / up.squaredNorm() * up;
      if (move.norm() > 0.5 * edge) move *= 0.5 * edge / move.norm();
      p += move;
    }
    return p;
  }

  void set_normal(VertexHandle v, const Vector3& up) {
    const double size = up.norm();
    if (size > 0) mesh_.set_normal(v, Point(up.x() / size, up.y() / size, up.z() / size));
  }

  void measure_normals(std::size_t from) {
    for (std::size_t i = from; i < mesh_.n_vertices(); ++i) {
      const VertexHandle v(static_cast<int>(i));
      const Vector3 p = to_vector3(mesh_.point(v));
      set_normal(v, gradient(p, solid_.value(p), edge(v)));
    }
  }

  // Each vertex to the middle of its neighbours, along the surface.
  void relax(int newton_steps) {
    for (const auto v : mesh_.vertices()) {
      Vector3 mean = Vector3::Zero(), normal_sum = Vector3::Zero();
      int valence = 0;
      for (auto it = mesh_.cvoh_iter(v); it.is_valid(); ++it) {
        const Point b = mesh_.point(mesh_.to_vertex_handle(*it));
        mean += to_vector3(b);
        ++valence;
        normal_sum += to_vector3(normal(mesh_.point(v), b, apex(*it)));
      }
      mean /= valence;
      normal_sum.normalize();
      const Vector3 p = to_vector3(mesh_.point(v)), shift = mean - p;
      if (!move(v, p + shift - normal_sum.dot(shift) * normal_sum, newton_steps)) move(v, p, newton_steps);
    }
  }

  // Moves a vertex to the surface near `goal`; false if it does not get there (in a crease the gradient
  // misleads) or a face would turn over.
  bool move(VertexHandle v, const Vector3& goal, int newton_steps) {
    Vector3 outward;
    const Vector3 to = projected(goal, newton_steps, edge(v), outward);
    if (std::abs(solid_.value(to)) > kFarthest * edge(v)) return false;
    const Point target(to.x(), to.y(), to.z());
    for (auto it = mesh_.cvoh_iter(v); it.is_valid(); ++it) {
      const VertexHandle b = mesh_.to_vertex_handle(*it),
                         c = mesh_.to_vertex_handle(mesh_.next_halfedge_handle(*it));
      const Point &pb = mesh_.point(b), &pc = mesh_.point(c);
      if (turns(normal(mesh_.point(v), pb, pc), normal(target, pb, pc), up(v, b, c))) return false;
    }
    mesh_.set_point(v, target);
    set_edge(v);
    set_normal(v, outward);
    return true;
  }

  Mesh mesh_;
  OpenMesh::VPropHandleT<double> edge_;
  const ImplicitSolid& solid_;
  RemeshOptions options_;
};

}  // namespace

PolygonSoup remesh(const PolygonSoup& soup, const ImplicitSolid& solid, const RemeshOptions& options) {
  if (!(options.edge > 0) || !std::isfinite(options.edge)) throw UsageError("edge must be a positive number");
  if (options.by_width && !solid.width) throw UsageError("the solid has no width to follow");
  if (options.rounds < 0) throw UsageError("rounds must not be negative");
  return Remesher(soup, solid, options).run();
}

}  // namespace mspskel
