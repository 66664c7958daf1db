// --report FILE.json: what a run did, for programs.
#pragma once

#include <string>

#include "extract_settings.h"
#include "mspskel/collapse/topology_certificate.h"

namespace mspskel::cli {

// Seconds that only the program knows.
struct ProgramSeconds {
  double total = 0;
  double read = 0;
  double write = 0;
};

// What was found, the same on every run: input, counts, skeleton, checks, warnings. The checks are the
// certificate.
Json make_report(const ExtractSettings& settings, const ExtractResult& result,
                 const TopologyCertificate& certificate);

// With what differs from run to run: options, seconds, peak memory.
Json with_costs(const Json& report, const ExtractSettings& settings, const ExtractResult& result,
                const ProgramSeconds& seconds);

// The JSON text, indented by so many blanks, or on one line if negative. Paths that are not UTF-8 get
// replacement characters.
std::string report_text(const Json& report, int indent = 2);

}  // namespace mspskel::cli
