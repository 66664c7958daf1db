// --root: where trees and centrelines begin.
#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "mspskel/repair/opening.h"
#include "mspskel/skeleton/spanning_forest.h"

namespace mspskel::cli {

struct RootOption {
  std::string text = "thickest";  // as given

  void add_to(CommandLine& line);
  // Throws UsageError for what is no choice, and for an opening that the mesh does not have.
  RootChoice resolve(const std::vector<Opening>& openings) const;
};

}  // namespace mspskel::cli
