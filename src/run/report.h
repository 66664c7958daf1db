// What a run did, for programs.
#pragma once

#include <string>

#include "command_line.h"
#include "mspskel/base/error.h"
#include "mspskel/collapse/topology_certificate.h"
#include "mspskel/extract_skeleton.h"
#include "mspskel/limbs/coverage.h"
#include "mspskel/skeleton/check_skeleton.h"

namespace mspskel::cli {

// Seconds that only the program knows.
struct ProgramSeconds {
  double total = 0;
  double read = 0;
  double write = 0;
};

// What was found, the same on every run: input, counts, skeleton, checks, warnings. `file` is the mesh's; the
// checks are the certificate.
Json make_report(const std::string& file, const ExtractResult& result, const TopologyCertificate& certificate,
                 const std::vector<UncoveredPart>& uncovered);

// With what differs from run to run: the options' values, seconds, peak memory.
Json with_costs(const Json& report, const Json& options, const ExtractResult& result,
                const ProgramSeconds& seconds);

// Of a mesh without a result: file, options, seconds, and why; with what mending had done if it refused.
Json refusal_report(const std::string& file, const Json& options, const Error& error, double seconds);

// The report's "error": exit status and message.
Json error_json(const Error& error);

// What `check` found.
Json checks_json(const SkeletonChecks& checks, const TopologyCertificate& certificate,
                 const std::vector<UncoveredPart>& uncovered);

// The JSON text, indented by so many blanks, or on one line if negative. Paths that are not UTF-8 get
// replacement characters.
std::string report_text(const Json& report, int indent = 2);

}  // namespace mspskel::cli
