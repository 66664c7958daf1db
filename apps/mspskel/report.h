// --report FILE.json: what a run did, for programs.
#pragma once

#include <string>

#include "extract_settings.h"

namespace mspskel::cli {

// Seconds that only the program knows.
struct ProgramSeconds {
  double total = 0;
  double read = 0;
  double write = 0;
};

Json make_report(const ExtractSettings& settings, const ExtractResult& result, const ProgramSeconds& seconds);

// The JSON text, two spaces deep. Paths that are not UTF-8 get replacement characters.
std::string report_text(const Json& report);

}  // namespace mspskel::cli
