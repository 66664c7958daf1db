// Options as the command line spells them.
#pragma once

#include <string>
#include <vector>

#include "run_options.h"

namespace mspskel::python {

struct Options {
  cli::RunOptions run;
  bool keep_failed = false;
  cli::Json values;  // of all options, by name
};

// From words such as --smallest=0.004. Throws UsageError.
Options parse_options(const std::vector<std::string>& words);

}  // namespace mspskel::python
