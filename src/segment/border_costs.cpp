#include "mspskel/segment/border_costs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mspskel/base/clones.h"
#include "mspskel/base/error.h"

namespace mspskel {
namespace {

// Three right-hand sides at once; a fourth makes rows as long as a processor's registers.
using Four = std::array<double, 4>;
using Columns = std::vector<Four>;

// A face has three neighbours, so with the face itself a row has four entries at most. They are in the order
// of their columns; what is left over is 0 times column 0.
struct Row {
  Four value{};
  std::array<Index, 4> column{};
  double diagonal = 0;
};

// Share of the normals that conjugate gradients may leave unsolved: far below the angles that count.
constexpr double kNormalError = 3e-3;

// Of the mean distance between faces' middles: across a crease between faces of one size the whole angle
// counts, but not what the narrow ends of long faces on a round wall turn by.
constexpr double kLeastWindow = 0.8;

// Some faces of a surface, or all, by their places in a list.
struct Faces {
  Faces(const SurfaceSnapshot& surface, const std::vector<char>& chosen)
      : place(surface.face_count(), kNone) {
    for (Index f = 0; f < surface.face_count(); ++f) {
      if (!chosen.empty() && !chosen[f]) continue;
      place[f] = static_cast<Index>(face.size());
      face.push_back(f);
      weighted_normal.push_back(0.5 * surface.face_normal_times_twice_area(f));
      area.push_back(weighted_normal.back().norm());
      mean += area.back();
      middle.push_back((surface.position[surface.origin[3 * f]] +
                        surface.position[surface.origin[3 * f + 1]] +
                        surface.position[surface.origin[3 * f + 2]]) /
                       3);
    }
    mean /= std::max<double>(1, static_cast<double>(face.size()));
    measure_apart(surface);
  }
  Index count() const { return static_cast<Index>(face.size()); }

  std::vector<Index> face;   // of the surface
  std::vector<Index> place;  // per face of the surface; kNone: not here
  std::vector<Vector3> weighted_normal, middle;
  std::vector<double> area;
  double mean = 0;                              // of the areas
  std::vector<std::array<Index, 3>> neighbour;  // per face and half-edge a place; kNone: not here
  std::vector<std::array<double, 3>> apart;     // per face and half-edge: between the middles
  double mean_apart = 0;

 private:
  void measure_apart(const SurfaceSnapshot& surface) {
    neighbour.resize(face.size());
    apart.resize(face.size());
    double sum = 0, pairs = 0;
    for (Index i = 0; i < count(); ++i)
      for (Index k = 0; k < 3; ++k) {
        const Index twin = surface.twin[3 * face[i] + k], j = neighbour[i][k] = place[twin / 3];
        if (j == kNone) continue;
        if (j < i) {
          apart[i][k] = apart[j][twin % 3];
          continue;
        }
        sum += apart[i][k] = (middle[i] - middle[j]).norm();
        ++pairs;
      }
    mean_apart = pairs > 0 ? sum / pairs : 0.0;
  }
};

Four times(const Row& row, const Columns& x) {
  Four sum{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 4; ++c) sum[c] += row.value[k] * x[row.column[k]][c];
  return sum;
}
void add_product(Four& sum, const Four& a, const Four& b) {
  for (std::size_t c = 0; c < 4; ++c) sum[c] += a[c] * b[c];
}
Four share(const Four& a, const Four& b) {
  Four shares{};
  for (std::size_t c = 0; c < 4; ++c) shares[c] = b[c] > 0 ? a[c] / b[c] : 0.0;
  return shares;
}

// Solves system * x = given by conjugate gradients with the diagonal as preconditioner, from the x given,
// each column by itself: one pass over the matrix serves all. The system is positive definite.
MSPSKEL_AVX_CLONES void solve(const std::vector<Row>& system, const Columns& given, Columns& x) {
  const std::size_t count = system.size();
  Columns left(count), way(count), moved(count);
  Four steep{}, enough{}, rest{};
  for (std::size_t i = 0; i < count; ++i) {
    const Four product = times(system[i], x);
    const double weight = 1 / system[i].diagonal;
    for (std::size_t c = 0; c < 4; ++c) {
      left[i][c] = given[i][c] - product[c];
      way[i][c] = weight * left[i][c];
    }
    add_product(steep, left[i], way[i]);
    add_product(rest, left[i], left[i]);
    add_product(enough, given[i], given[i]);
  }
  for (double& most : enough) most *= kNormalError * kNormalError;
  const auto is_solved = [&] {
    for (std::size_t c = 0; c < 4; ++c)
      if (rest[c] > enough[c]) return false;
    return true;
  };
  for (std::size_t round = 0; round < count && !is_solved(); ++round) {
    Four bent{};
    for (std::size_t i = 0; i < count; ++i) {
      moved[i] = times(system[i], way);
      add_product(bent, way[i], moved[i]);
    }
    const Four step = share(steep, bent);
    Four next{};
    rest = Four{};
    for (std::size_t i = 0; i < count; ++i) {
      const double weight = 1 / system[i].diagonal;
      Four eased{};
      for (std::size_t c = 0; c < 4; ++c) {
        x[i][c] += way[i][c] * step[c];
        left[i][c] -= moved[i][c] * step[c];
        eased[c] = weight * left[i][c];
      }
      moved[i] = eased;
      add_product(next, left[i], eased);
      add_product(rest, left[i], left[i]);
    }
    const Four kept = share(next, steep);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 4; ++c) way[i][c] = way[i][c] * kept[c] + moved[i][c];
    steep = next;
  }
}

// Adds to the entry of the column; there are `count` so far, in the order of their columns.
void add(Row& row, std::size_t& count, Index column, double value) {
  std::size_t at = 0;
  while (at < count && row.column[at] < column) ++at;
  if (at == count || row.column[at] != column) {
    for (std::size_t k = count++; k > at; --k) {
      row.column[k] = row.column[k - 1];
      row.value[k] = row.value[k - 1];
    }
    row.column[at] = column;
    row.value[at] = 0;
  }
  row.value[at] += value;
}

// After one implicit step of diffusion over the faces: (M + reach^2 L) x = M n. Reaches span few faces, so
// conjugate gradients from the faces' own normals take few rounds, where a factorisation would cost most of
// the stage.
std::vector<Vector3> unit_normals(const SurfaceSnapshot& surface, const Faces& faces, double reach) {
  const Index count = faces.count();
  std::vector<Vector3> normals(count);
  if (!(reach > 0) || count == 0) {
    for (Index i = 0; i < count; ++i) normals[i] = faces.weighted_normal[i].normalized();
    return normals;
  }
  std::vector<Row> system(count);
  Columns given(count), solution(count);
  const double least_apart = 1e-3 * std::sqrt(faces.mean);
  for (Index i = 0; i < count; ++i) {
    // Faces without area follow their neighbours.
    const double area = faces.area[i] + 1e-9 * faces.mean;
    double own = area;
    std::size_t entries = 0;
    for (Index k = 0; k < 3; ++k) {
      const Index j = faces.neighbour[i][k];
      if (j == kNone) continue;
      const double flow = reach * reach * surface.edge_length(3 * faces.face[i] + k) /
                          std::max(faces.apart[i][k], least_apart);
      own += flow;
      add(system[i], entries, j, -flow);
    }
    add(system[i], entries, i, own);
    for (std::size_t k = 0; k < 4; ++k)
      if (k < entries && system[i].column[k] == i) system[i].diagonal = system[i].value[k];
    for (Index c = 0; c < 3; ++c) {
      given[i][c] = faces.weighted_normal[i][c];
      solution[i][c] = faces.weighted_normal[i][c] / area;
    }
  }
  solve(system, given, solution);
  for (Index i = 0; i < count; ++i)
    normals[i] = Vector3(solution[i][0], solution[i][1], solution[i][2]).normalized();
  return normals;
}

// By how much a surface with these unit normals, whose faces are `across` from each other and `apart`, turns
// within `window`; 0 where it is convex. Radians.
double crease_angle(const Vector3& a, const Vector3& b, const Vector3& across, double apart, double window) {
  if (!((a - b).dot(across) > 0)) return 0;
  return std::min(kPi, std::atan2(a.cross(b).norm(), a.dot(b)) * window / apart);
}

}  // namespace

void validate(const CreaseOptions& options) {
  if (!(options.crease >= 0 && options.crease <= 100))
    throw UsageError("creases: crease must be from 0 to 100");
  if (!(options.width >= 0 && options.width <= 1)) throw UsageError("creases: width must be from 0 to 1");
}

std::vector<double> border_costs(const SurfaceSnapshot& surface, const CreaseOptions& options,
                                 const std::vector<char>& where) {
  validate(options);
  if (!where.empty() && static_cast<Index>(where.size()) != surface.face_count())
    throw UsageError("creases: there are not as many flags as faces");
  const Faces faces(surface, where);
  const double total = std::accumulate(surface.vertex_area.begin(), surface.vertex_area.end(), 0.0);
  const double reach = options.width * std::sqrt(total);
  const std::vector<Vector3> normals = unit_normals(surface, faces, reach);
  // Faces that are wider than the reach show no more than by how much they turn from one to the next.
  const double window = std::max(2 * reach, kLeastWindow * faces.mean_apart);
  std::vector<double> costs(surface.halfedge_count());
  for (Index h = 0; h < surface.halfedge_count(); ++h) {
    const Index k = surface.twin[h];
    if (k < h) {
      costs[h] = costs[k];
      continue;
    }
    costs[h] = surface.edge_length(h);
    const Index a = faces.place[h / 3], b = faces.place[k / 3];
    if (a == kNone || b == kNone) continue;
    costs[h] /= 1 + options.crease * crease_angle(normals[a], normals[b], faces.middle[b] - faces.middle[a],
                                                  faces.apart[a][h % 3], window);
  }
  return costs;
}

}  // namespace mspskel
