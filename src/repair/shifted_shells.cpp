#include "shifted_shells.h"

#include <random>

namespace mspskel::detail {

ShiftedShells::ShiftedShells(const ShellGroup& group, unsigned seed)
    : group_(group), member_(group.surface().position.size(), kNone), point_(group.surface().position) {
  std::mt19937 random(seed);
  const auto share = [&] { return 2.0 * (static_cast<double>(random()) / 4294967296.0) - 1; };
  for (std::size_t m = 0; m < group.size(); ++m) {
    const Vector3 shift = kShellShift * Vector3(share(), share(), share());
    shift_.push_back(shift);
    for (const Index v : group.shell(m).vertices) {
      member_[v] = static_cast<Index>(m);
      point_[v] += shift;
    }
  }
}

Index ShiftedShells::add_point(const Vector3& p) {
  point_.push_back(p);
  return static_cast<Index>(point_.size()) - 1;
}

FacePlane ShiftedShells::plane_of(Index f) const {
  const Vector3& a = point_[corner(f, 0)];
  const Vector3 normal = (point_[corner(f, 1)] - a).cross(point_[corner(f, 2)] - a);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return normal[axis] > 0 ? FacePlane{u, v} : FacePlane{v, u};
}

bool ShiftedShells::is_in(Index member, const Vector3& p) const {
  const auto m = static_cast<std::size_t>(member);
  return group_.is_in(m, p - shift_[m]);
}

}  // namespace mspskel::detail
