// Shells grown until what touches overlaps.
#pragma once

#include <optional>
#include <vector>

#include "shell_grid.h"

namespace mspskel::detail {

// Shells of a surface that are a little larger than they were: those in contact overlap, slits between them
// close, and of faces in one plane each has a height of its own.
class InflatedShells {
 public:
  InflatedShells(const SurfaceSnapshot& surface, const std::vector<Shell>& shells)
      : original_(surface), original_shells_(shells) {}

  // The members grown by `by`, times one to one and a half, at most a hundredth of their width. Valid until
  // the next call.
  const ShellGroup& grow(const std::vector<Index>& members, double by, const Execution& execution);

 private:
  const SurfaceSnapshot& original_;
  const std::vector<Shell>& original_shells_;
  SurfaceSnapshot surface_;  // copied when first asked for
  std::vector<Shell> shells_;
  std::optional<ShellGroup> group_;
};

}  // namespace mspskel::detail
