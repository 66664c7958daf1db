// What the default command was asked to do.
#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "mspskel/rig/make_rig.h"
#include "mspskel/segment/segment_surface.h"
#include "root_option.h"
#include "run_options.h"
#include "terminal.h"

namespace mspskel::cli {

struct ExtractSettings {
  std::string input;
  std::vector<std::string> outputs;
  std::string report;  // empty: none
  std::string stages;  // folder; empty: none
  RootOption root;
  std::string surface;   // file of the mesh that the skeleton belongs to; empty: none
  std::string segments;  // file of the parts; empty: none
  SegmentOptions segmentation;
  bool rig = false;  // .glb files have joints instead of lines
  RigOptions rigging;
  std::vector<std::string> poses;  // NAME=AXIS,ANGLE each
  std::string bent;                // file of the surface in that pose; empty: none
  bool keep_failed = false;
  bool quiet = false;
  bool verbose = false;
  double max_memory = 0;  // megabytes; 0: no limit
  bool version = false;   // nothing but that is asked for
  RunOptions run;
  Json values;  // of all options, for the report

  bool needs_rig() const;
  Verbosity verbosity() const {
    return quiet ? Verbosity::kQuiet : verbose ? Verbosity::kVerbose : Verbosity::kNormal;
  }
};

inline constexpr const char* kExtractDescription =
    "Curve skeleton of a closed triangle mesh by minimum slice perimeter (MSP).";

// The options of the default command. Settings and line must outlive it.
class ExtractOptionTable {
 public:
  // `words` are what the line is to parse: the defaults of some options depend on others.
  ExtractOptionTable(const std::vector<std::string>& words, ExtractSettings& settings, CommandLine& line);
  // After parsing: what options mean together. Throws UsageError.
  void resolve();

 private:
  void add_options();
  void add_help();

  ExtractSettings& settings_;
  CommandLine& line_;
  RunOptionTable run_;
};

}  // namespace mspskel::cli
