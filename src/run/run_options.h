// What is computed, as options with names and ranges.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "command_line.h"
#include "mesh_input.h"
#include "mspskel/extract_skeleton.h"
#include "presets.h"

namespace mspskel::cli {

struct RunOptions {
  ExtractOptions extract;
  RepairSettings repair;
  double time_limit = 0;      // seconds; 0: none
  double least_inside = 0.9;  // share of the refined skeleton's length; below it there is none
};

// Adds the options to a command line that is to be parsed with `arguments`, in three steps between which the
// command may list options of its own; repair options are added by add_repair_options. `target` and the table
// must outlive the parsing.
class RunOptionTable {
 public:
  // Sets the target to the defaults of the mode that the arguments ask for.
  RunOptionTable(const std::vector<std::string>& arguments, RunOptions& target);

  void add_general(CommandLine& line);  // preset, mode, threads, seed, time limit
  void add_stages(CommandLine& line);   // slices, skeletal points, collapse, arcs
  // After parsing: the preset, and options that stand for several settings. Throws UsageError.
  void resolve(CommandLine& line);

 private:
  RunOptions& target_;
  PresetOption preset_;
  std::uint64_t seed_ = 0;
  int planes_ = 0;
  double step_ = 0, usual_step_ = 0, detail_ = 1;
};

}  // namespace mspskel::cli
