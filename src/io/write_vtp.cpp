#include "write_vtp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "append_text.h"

namespace mspskel::detail {
namespace {

struct PointArrays {
  std::vector<double> abscissa, curvature, torsion;
  std::vector<Vector3> tangent, normal, binormal, transported;
};

struct CellArrays {
  std::vector<Index> centerline, tract, blanking;
  std::vector<double> length, tortuosity;
  std::vector<std::array<Index, 2>> joints;
};

Vector3 any_normal(const Vector3& tangent) {
  int least = 0;
  tangent.cwiseAbs().minCoeff(&least);
  return tangent.cross(Vector3::Unit(least)).normalized();
}

class Centerlines {
 public:
  Centerlines(const CurveSkeleton& skeleton, const RootChoice& root)
      : skeleton_(skeleton), forest_(span(skeleton, root)), degree_(skeleton.nodes.size(), 0) {
    for (const auto& [a, b] : skeleton.edges) ++degree_[a], ++degree_[b];
    measure_ways();
    for (Branch& branch : branches(skeleton)) lines.push_back(std::move(branch.nodes));
    for (std::vector<Index>& line : lines)
      if (points.abscissa[line.front()] > points.abscissa[line.back()])
        std::reverse(line.begin(), line.end());
    std::stable_sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) {
      return points.abscissa[a.front()] < points.abscissa[b.front()];
    });
    set_frames();
    set_cells();
    number_ways();
  }

  std::vector<std::vector<Index>> lines;
  PointArrays points;
  CellArrays cells;
  const std::vector<Index>& degrees() const { return degree_; }

 private:
  const Vector3& place(Index node) const { return skeleton_.nodes[node].position; }

  void measure_ways() {
    points.abscissa.assign(skeleton_.nodes.size(), 0.0);
    for (const Index v : forest_.order)
      if (forest_.parent[v] != kNone)
        points.abscissa[v] =
            points.abscissa[forest_.parent[v]] + (place(v) - place(forest_.parent[v])).norm();
  }

  // Branches come from the root outward, so the one that leads to a joint sets its frame first.
  void set_frames() {
    const std::size_t n = skeleton_.nodes.size();
    points.curvature.assign(n, 0.0);
    points.torsion.assign(n, 0.0);
    for (auto* list : {&points.tangent, &points.normal, &points.binormal, &points.transported})
      list->assign(n, Vector3::Zero());
    std::vector<char> done(n, 0);
    for (const std::vector<Index>& line : lines) set_frames(line, done);
  }

  void set_frames(const std::vector<Index>& line, std::vector<char>& done) {
    const std::size_t n = line.size();
    std::vector<Vector3> tangent(n), normal(n), binormal(n), transported(n);
    std::vector<double> curvature(n, 0.0), torsion(n, 0.0), at(n, 0.0);
    for (std::size_t i = 1; i < n; ++i) at[i] = at[i - 1] + (place(line[i]) - place(line[i - 1])).norm();
    const auto slope = [&](const std::vector<Vector3>& values, std::size_t i) {
      const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, n - 1);
      return at[b] > at[a] ? Vector3((values[b] - values[a]) / (at[b] - at[a])) : Vector3(Vector3::Zero());
    };
    std::vector<Vector3> places(n);
    for (std::size_t i = 0; i < n; ++i) places[i] = place(line[i]);
    for (std::size_t i = 0; i < n; ++i) tangent[i] = slope(places, i).stableNormalized();
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3 turn = slope(tangent, i) - slope(tangent, i).dot(tangent[i]) * tangent[i];
      curvature[i] = turn.norm();
      // Where the line is straight the frame goes on as it was.
      normal[i] = curvature[i] > 0 ? Vector3(turn / curvature[i])
                  : i > 0
                      ? Vector3(normal[i - 1] - normal[i - 1].dot(tangent[i]) * tangent[i]).stableNormalized()
                      : any_normal(tangent[i]);
      binormal[i] = tangent[i].cross(normal[i]);
      const Vector3 before = i > 0 ? transported[i - 1] : any_normal(tangent[i]);
      transported[i] = Vector3(before - before.dot(tangent[i]) * tangent[i]).stableNormalized();
    }
    for (std::size_t i = 0; i < n; ++i) torsion[i] = -slope(binormal, i).dot(normal[i]);
    for (std::size_t i = 0; i < n; ++i) {
      const Index v = line[i];
      if (done[v]) continue;
      done[v] = 1;
      points.tangent[v] = tangent[i];
      points.normal[v] = normal[i];
      points.binormal[v] = binormal[i];
      points.transported[v] = transported[i];
      points.curvature[v] = curvature[i];
      points.torsion[v] = torsion[i];
    }
  }

  void set_cells() {
    for (const std::vector<Index>& line : lines) {
      double length = 0;
      for (std::size_t i = 1; i < line.size(); ++i) length += (place(line[i]) - place(line[i - 1])).norm();
      const double distance = (place(line.front()) - place(line.back())).norm();
      const auto joint = [&](Index v) { return degree_[v] > 2 ? v : kNone; };
      const std::array<Index, 2> ends{joint(line.front()), joint(line.back())};
      double covered = 0;
      for (const Index v : ends)
        if (v != kNone) covered += skeleton_.nodes[v].radius;
      cells.length.push_back(length);
      cells.tortuosity.push_back(distance > 0 ? length / distance - 1 : 0.0);
      cells.joints.push_back(ends);
      cells.blanking.push_back(ends[0] != kNone && ends[1] != kNone && length <= covered);
    }
  }

  // Ways from a root to each tip, tips in the order of the forest; a branch off every way counts as one.
  void number_ways() {
    std::vector<Index> line_to(skeleton_.nodes.size(),
                               kNone);  // per node the branch of the edge to its parent
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t k = 1; k < lines[i].size(); ++k) {
        const Index a = lines[i][k - 1], b = lines[i][k];
        if (forest_.parent[b] == a) line_to[b] = static_cast<Index>(i);
        if (forest_.parent[a] == b) line_to[a] = static_cast<Index>(i);
      }
    cells.centerline.assign(lines.size(), kNone);
    cells.tract.assign(lines.size(), 0);
    Index ways = 0;
    for (const Index tip : forest_.order) {
      if (degree_[tip] != 1 || forest_.parent[tip] == kNone) continue;
      std::vector<Index> way;
      for (Index v = tip; forest_.parent[v] != kNone; v = forest_.parent[v])
        if (way.empty() || way.back() != line_to[v]) way.push_back(line_to[v]);
      for (std::size_t i = 0; i < way.size(); ++i) {
        if (cells.centerline[way[i]] != kNone) continue;
        cells.centerline[way[i]] = ways;
        cells.tract[way[i]] = static_cast<Index>(way.size() - 1 - i);
      }
      ++ways;
    }
    for (Index& id : cells.centerline)
      if (id == kNone) id = ways++;
  }

  const CurveSkeleton& skeleton_;
  SpanningForest forest_;
  std::vector<Index> degree_;
};

class Xml {
 public:
  template <class Values>
  void array(const char* type, const char* name, int components, const Values& values) {
    append_all(text, "        <DataArray type=\"", type, "\" Name=\"", name, "\"");
    if (components > 1) append_all(text, " NumberOfComponents=\"", Index{components}, "\"");
    append(text, " format=\"ascii\">");
    for (const auto& value : values) append_all(text, ' ', value);
    append(text, " </DataArray>\n");
  }
  // <Verts> or <Lines>: where each cell ends in the list of its points.
  void cells(const char* name, const std::vector<std::vector<Index>>& cells) {
    std::vector<Index> corners, ends;
    for (const auto& cell : cells) {
      corners.insert(corners.end(), cell.begin(), cell.end());
      ends.push_back(static_cast<Index>(corners.size()));
    }
    append_all(text, "      <", name, ">\n");
    array("Int64", "connectivity", 1, corners);
    array("Int64", "offsets", 1, ends);
    append_all(text, "      </", name, ">\n");
  }

  std::string text;
};

// The values of lines after `zeros` ones for the cells that are points.
template <class Value>
std::vector<Value> after(std::size_t zeros, const std::vector<Value>& values, Value zero) {
  std::vector<Value> all(zeros, zero);
  all.insert(all.end(), values.begin(), values.end());
  return all;
}

}  // namespace

std::string format_vtp(const CurveSkeleton& skeleton, const RootChoice& root) {
  const Centerlines centerlines(skeleton, root);
  const std::vector<Index>& degree = centerlines.degrees();
  std::vector<std::vector<Index>> dots;
  std::vector<double> radius;
  std::vector<Vector3> place;
  std::vector<Index> marks;
  for (Index v = 0; v < static_cast<Index>(skeleton.nodes.size()); ++v) {
    if (degree[v] == 0) dots.push_back({v});
    radius.push_back(skeleton.nodes[v].radius);
    place.push_back(skeleton.nodes[v].position);
    marks.push_back(degree[v] > 2);
  }
  Xml xml;
  append_all(
      xml.text,
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <PolyData>\n    <Piece NumberOfPoints=\"",
      skeleton.nodes.size(), "\" NumberOfVerts=\"", dots.size(), "\" NumberOfLines=\"",
      centerlines.lines.size(), "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
      "      <PointData Scalars=\"MaximumInscribedSphereRadius\">\n");
  const PointArrays& points = centerlines.points;
  xml.array("Float64", "MaximumInscribedSphereRadius", 1, radius);
  xml.array("Float64", "Radius", 1, radius);
  xml.array("Float64", "Abscissas", 1, points.abscissa);
  xml.array("Float64", "Curvature", 1, points.curvature);
  xml.array("Float64", "Torsion", 1, points.torsion);
  xml.array("Float64", "FrenetTangent", 3, points.tangent);
  xml.array("Float64", "FrenetNormal", 3, points.normal);
  xml.array("Float64", "FrenetBinormal", 3, points.binormal);
  xml.array("Float64", "ParallelTransportNormals", 3, points.transported);
  xml.array("Int64", "Marks", 1, marks);
  append(xml.text, "      </PointData>\n      <CellData Scalars=\"GroupIds\">\n");
  const CellArrays& cells = centerlines.cells;
  std::vector<Index> groups(dots.size() + centerlines.lines.size());
  std::iota(groups.begin(), groups.end(), 0);
  std::vector<Index> topology(2 * dots.size(), kNone);
  for (const auto& ends : cells.joints) topology.insert(topology.end(), ends.begin(), ends.end());
  xml.array("Int64", "CenterlineIds", 1, after<Index>(dots.size(), cells.centerline, kNone));
  xml.array("Int64", "TractIds", 1, after<Index>(dots.size(), cells.tract, 0));
  xml.array("Int64", "GroupIds", 1, groups);
  xml.array("Int64", "Blanking", 1, after<Index>(dots.size(), cells.blanking, 0));
  xml.array("Float64", "Length", 1, after(dots.size(), cells.length, 0.0));
  xml.array("Float64", "Tortuosity", 1, after(dots.size(), cells.tortuosity, 0.0));
  xml.array("Int64", "Topology", 2, topology);
  append(xml.text, "      </CellData>\n      <Points>\n");
  xml.array("Float64", "Points", 3, place);
  append(xml.text, "      </Points>\n");
  xml.cells("Verts", dots);
  xml.cells("Lines", centerlines.lines);
  return xml.text + "    </Piece>\n  </PolyData>\n</VTKFile>\n";
}

}  // namespace mspskel::detail
