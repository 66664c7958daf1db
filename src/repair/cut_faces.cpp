#include "cut_faces.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "face_cutter.h"

namespace mspskel::detail {
namespace {

class FaceCutting {
 public:
  FaceCutting(const ShiftedShells& shells, const CrossingCurves& curves) : shells_(shells), curves_(curves) {}

  std::optional<std::vector<CutPiece>> run(Watch& watch) {
    if (!cut_faces(watch)) return std::nullopt;
    return std::move(pieces_);
  }

 private:
  const SurfaceSnapshot& surface() const { return shells_.surface(); }
  const Vector3& point(Index v) const { return shells_.point(v); }

  bool cut_faces(Watch& watch) {
    std::unordered_map<Index, std::vector<std::pair<double, Index>>> on_edge;
    for (const EdgePassage& p : curves_.passages) on_edge[p.edge].push_back({p.share, p.point});
    for (auto& [edge, list] : on_edge) std::sort(list.begin(), list.end());
    std::vector<char> is_cut(static_cast<std::size_t>(surface().face_count()), 0);
    for (const Index f : curves_.faces) is_cut[f] = 1;
    for (const Index f : shells_.group().faces())
      if (!is_cut[f])
        pieces_.push_back({{shells_.corner(f, 0), shells_.corner(f, 1), shells_.corner(f, 2)}, f, {0, 0, 0}});
    for (const Index f : curves_.faces)
      if (!cut_face(f, on_edge, watch)) return false;
    return true;
  }

  bool cut_face(Index f, const std::unordered_map<Index, std::vector<std::pair<double, Index>>>& on_edge,
                Watch& watch) {
    const FacePlane plane = shells_.plane_of(f);
    const Vector3 base = point(shells_.corner(f, 0));
    const auto flat = [&](Index v) { return plane.at(point(v) - base); };
    FaceCutter cutter(flat(shells_.corner(f, 0)), flat(shells_.corner(f, 1)), flat(shells_.corner(f, 2)));
    std::vector<Index> name{shells_.corner(f, 0), shells_.corner(f, 1), shells_.corner(f, 2)};
    std::unordered_map<Index, Index> number;
    const auto add_name = [&](Index v) {
      number.emplace(v, static_cast<Index>(name.size()));
      name.push_back(v);
    };
    for (int k = 0; k < 3; ++k) {
      const Index h = 3 * f + k;
      const auto found = on_edge.find(std::min(h, surface().twin[h]));
      if (found == on_edge.end()) continue;
      std::vector<std::pair<double, Index>> list = found->second;
      if (surface().origin[h] > surface().target(h)) std::reverse(list.begin(), list.end());
      for (const auto& [share, v] : list) {
        cutter.add_on_side(k, flat(v));
        add_name(v);
      }
    }
    const auto add = [&](Index v) {
      if (number.count(v) > 0) return;
      watch.step();
      cutter.add_within(flat(v));
      add_name(v);
    };
    for (const Index s : curves_.on_face.at(f)) {
      for (const Index v : curves_.segments[s].end) add(v);
      for (const Index v : curves_.segments[s].between) add(v);
    }
    for (const Index s : curves_.on_face.at(f)) {
      watch.step();
      Index from = curves_.segments[s].end[0];
      for (const Index v : curves_.segments[s].between) {
        if (!cutter.keep(number[from], number[v])) return false;
        from = v;
      }
      if (!cutter.keep(number[from], number[curves_.segments[s].end[1]])) return false;
    }
    for (const FaceCutter::Part& part : cutter.parts())
      pieces_.push_back({{name[part.corner[0]], name[part.corner[1]], name[part.corner[2]]}, f, part.kept});
    return true;
  }

  const ShiftedShells& shells_;
  const CrossingCurves& curves_;
  std::vector<CutPiece> pieces_;
};

}  // namespace

std::optional<std::vector<CutPiece>> cut_along_curves(const ShiftedShells& shells,
                                                      const CrossingCurves& curves, Watch& watch) {
  return FaceCutting(shells, curves).run(watch);
}

}  // namespace mspskel::detail
