#include "mspskel/mesh/build_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "defects.h"
#include "mspskel/base/error.h"
#include "mspskel/mesh/detail/unit_scale.h"
#include "oriented_surface.h"
#include "triangulate.h"

namespace mspskel {
namespace {

using detail::NamedCount;
using detail::OrientedSurface;

// Everything that the steps after it take for granted.
void check_soup(const PolygonSoup& soup) {
  if (soup.begin.size() < 2) throw MeshError("the mesh has no faces");
  constexpr std::size_t kMost = 700'000'000;
  if (soup.points.size() > kMost || soup.corners.size() > kMost) throw MeshError("the mesh is too large");
  if (soup.begin.front() != 0 || soup.begin.back() != static_cast<Index>(soup.corners.size()) ||
      !std::is_sorted(soup.begin.begin(), soup.begin.end()))
    throw MeshError("the polygons' ranges do not cover their corners");
  NamedCount infinite, small, repeating, outside;
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    if (!soup.points[v].allFinite()) infinite.add(std::to_string(v));
  const auto vertices = static_cast<Index>(soup.points.size());
  std::vector<Index> last_face(soup.points.size(), kNone);
  for (Index f = 0; f < static_cast<Index>(soup.polygon_count()); ++f) {
    bool repeats = false, out = false;
    for (Index i = soup.begin[f]; i < soup.begin[f + 1]; ++i) {
      const Index v = soup.corners[i];
      out = out || v < 0 || v >= vertices;
      if (out) break;
      repeats = repeats || last_face[v] == f;
      last_face[v] = f;
    }
    if (soup.begin[f + 1] - soup.begin[f] < 3) small.add(std::to_string(f));
    if (repeats) repeating.add(std::to_string(f));
    if (out) outside.add(std::to_string(f));
  }
  std::string message;
  const auto add = [&](const NamedCount& count, const char* one, const char* many) {
    if (count.any())
      message += (message.empty() ? "" : "; ") + count.count(one, many) + ", first " + count.names();
  };
  add(infinite, "vertex has a coordinate that is not finite",
      "vertices have a coordinate that is not finite");
  add(outside, "face has a vertex index out of range", "faces have a vertex index out of range");
  add(small, "face has fewer than three corners", "faces have fewer than three corners");
  add(repeating, "face repeats a vertex", "faces repeat a vertex");
  if (!message.empty()) throw MeshError(message);
}

struct Piece {        // one component
  double volume = 0;  // signed, six times
  Vector3 low, high;
  Index first_vertex = kNone;
};

class InsideOut {
 public:
  InsideOut(const std::vector<Vector3>& points, const OrientedSurface& surface)
      : points_(points), s_(surface), pieces_(surface.component_count) {
    for (Index f = 0; f < s_.face_count(); ++f) measure(f);
  }
  Index degenerate_faces() const { return degenerate_faces_; }
  Index flat_components() const {
    return static_cast<Index>(
        std::count_if(pieces_.begin(), pieces_.end(), [](const Piece& p) { return is_flat(p); }));
  }

  // Per component: 1 if it has to be turned. `nested` counts the inside-out ones that lie within another.
  std::vector<char> find(Index& nested) const {
    double total = 0;
    for (const Piece& piece : pieces_) total += piece.volume;
    const char all = total < 0;
    std::vector<char> turn(pieces_.size(), all);
    for (Index c = 0; c < s_.component_count; ++c) {
      const Piece& piece = pieces_[c];
      if (is_flat(piece) || (all ? piece.volume <= 0 : piece.volume >= 0)) continue;
      if (lies_within_another(c))
        ++nested;
      else
        turn[c] ^= 1;
    }
    return turn;
  }

 private:
  const Vector3& corner(Index f, int i) const { return points_[s_.corners[3 * f + i]]; }
  static bool is_flat(const Piece& p) {
    return std::abs(p.volume) <= 1e-14 * std::pow((p.high - p.low).norm(), 3);
  }

  void measure(Index f) {
    Piece& piece = pieces_[s_.component[f]];
    const Vector3 &a = corner(f, 0), &b = corner(f, 1), &c = corner(f, 2);
    if (piece.first_vertex == kNone) {
      piece.first_vertex = s_.corners[3 * f];
      piece.low = piece.high = a;
    }
    for (const Vector3* p : {&a, &b, &c}) {
      piece.low = piece.low.cwiseMin(*p);
      piece.high = piece.high.cwiseMax(*p);
    }
    const Vector3& base = points_[piece.first_vertex];  // near the piece: no cancellation far from the origin
    piece.volume += (a - base).dot((b - base).cross(c - base));
    degenerate_faces_ += (b - a).cross(c - a).squaredNorm() == 0;
  }

  bool lies_within_another(Index c) const {
    const Vector3& p = points_[pieces_[c].first_vertex];
    std::vector<char> candidate(pieces_.size(), 0);
    bool any = false;
    for (Index d = 0; d < s_.component_count; ++d) {
      if (d == c || (p.array() < pieces_[d].low.array()).any() || (p.array() > pieces_[d].high.array()).any())
        continue;
      candidate[d] = any = true;
    }
    if (!any) return false;
    std::vector<double> angle(pieces_.size(), 0.0);
    for (Index f = 0; f < s_.face_count(); ++f)
      if (candidate[s_.component[f]]) angle[s_.component[f]] += solid_angle(f, p);
    // The winding number is an integer for a point off the surface; its sign depends on how the other
    // component is turned.
    return std::any_of(angle.begin(), angle.end(), [](double a) { return std::abs(a) > 2 * kPi; });
  }
  // Van Oosterom and Strackee 1983.
  double solid_angle(Index f, const Vector3& p) const {
    const Vector3 a = corner(f, 0) - p, b = corner(f, 1) - p, c = corner(f, 2) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }

  const std::vector<Vector3>& points_;
  const OrientedSurface& s_;
  std::vector<Piece> pieces_;
  Index degenerate_faces_ = 0;
};

// The half-edges are matched already, so the connectivity is written as it is; add_face would search for
// every edge again.
DefaultMesh fill_mesh(const std::vector<Vector3>& points, const OrientedSurface& s) {
  DefaultMesh mesh;
  const auto halfedges = static_cast<Index>(s.corners.size());
  mesh.reserve(points.size(), static_cast<std::size_t>(halfedges) / 2,
               static_cast<std::size_t>(s.face_count()));
  for (const Vector3& p : points) mesh.new_vertex({p[0], p[1], p[2]});
  std::vector<OpenMesh::HalfedgeHandle> handle(s.corners.size());
  for (Index h = 0; h < halfedges; ++h) {
    if (s.twin[h] < h) continue;
    handle[h] = mesh.new_edge(OpenMesh::VertexHandle(s.corners[h]),
                              OpenMesh::VertexHandle(s.corners[OrientedSurface::next(h)]));
    handle[s.twin[h]] = mesh.opposite_halfedge_handle(handle[h]);
  }
  for (Index f = 0; f < s.face_count(); ++f) {
    const OpenMesh::FaceHandle face = mesh.new_face();
    mesh.set_halfedge_handle(face, handle[3 * f + 2]);
    for (Index h = 3 * f; h < 3 * f + 3; ++h) {
      mesh.set_face_handle(handle[h], face);
      mesh.set_next_halfedge_handle(handle[h], handle[OrientedSurface::next(h)]);
      mesh.set_halfedge_handle(OpenMesh::VertexHandle(s.corners[h]), handle[h]);
    }
  }
  return mesh;
}

void add_warnings(BuiltMesh& built, Index flat_components) {
  const auto warn = [&](Index count, const char* one, const char* many) {
    if (count > 0) built.warnings.push_back(std::to_string(count) + " " + (count == 1 ? one : many));
  };
  warn(built.reoriented_faces, "face was turned over to agree with its neighbours",
       "faces were turned over to agree with their neighbours");
  warn(built.flipped_components, "component was inside out and was turned",
       "components were inside out and were turned");
  warn(built.nested_components, "component is a cavity within another",
       "components are cavities within another");
  warn(flat_components, "component encloses no volume", "components enclose no volume");
  warn(built.isolated_vertices, "vertex belongs to no face", "vertices belong to no face");
  warn(built.degenerate_faces, "face has no area", "faces have no area");
}

// The soup at a size at which its areas and volumes are numbers; nothing if it has that.
std::optional<PolygonSoup> at_measurable_size(const PolygonSoup& soup) {
  constexpr double kExtreme = 1e60;  // products of four lengths are numbers up to here
  const double scale = detail::unit_scale(soup.points);
  if (scale < kExtreme && scale > 1 / kExtreme) return std::nullopt;
  PolygonSoup scaled = soup;
  for (Vector3& p : scaled.points) p *= scale;
  return scaled;
}

}  // namespace

BuiltMesh build_mesh_with_report(const PolygonSoup& soup) {
  check_soup(soup);
  const auto vertices = static_cast<Index>(soup.points.size());
  const std::optional<PolygonSoup> scaled = at_measurable_size(soup);
  const PolygonSoup& measured = scaled ? *scaled : soup;
  const detail::Triangulation triangulation = detail::triangulate(measured);
  OrientedSurface surface = detail::orient_surface(vertices, triangulation);

  BuiltMesh built;
  const InsideOut inside_out(measured.points, surface);
  const std::vector<char> turn_component = inside_out.find(built.nested_components);
  built.flipped_components = static_cast<Index>(std::count(turn_component.begin(), turn_component.end(), 1));
  if (built.flipped_components > 0) {
    std::vector<char> turn(surface.face_count());
    for (Index f = 0; f < surface.face_count(); ++f) turn[f] = turn_component[surface.component[f]];
    detail::turn_faces(surface, turn);
  }
  built.component_count = surface.component_count;
  built.triangulated_polygons = triangulation.cut_polygons;
  built.reoriented_faces = surface.reoriented_faces;
  built.degenerate_faces = inside_out.degenerate_faces();
  std::vector<char> used(soup.points.size(), 0);
  for (const Index v : surface.corners) used[v] = 1;
  built.isolated_vertices = static_cast<Index>(std::count(used.begin(), used.end(), 0));
  add_warnings(built, inside_out.flat_components());
  built.mesh = fill_mesh(soup.points, surface);
  return built;
}

DefaultMesh build_mesh(const PolygonSoup& soup) { return build_mesh_with_report(soup).mesh; }

PolygonSoup to_soup(const DefaultMesh& mesh) {
  PolygonSoup soup;
  for (const auto v : mesh.vertices()) soup.points.push_back(to_vector3(mesh.point(v)));
  for (const auto f : mesh.faces()) {
    for (const auto v : mesh.fv_range(f)) soup.corners.push_back(v.idx());
    soup.begin.push_back(static_cast<Index>(soup.corners.size()));
  }
  return soup;
}

}  // namespace mspskel
