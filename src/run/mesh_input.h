// The mesh that a user gave, made usable: as it is where it is closed, else mended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/repair/mend_soup.h"
#include "mspskel/repair/unite_shells.h"
#include "mspskel/repair/wrap_soup.h"
#include "mspskel/skeleton/curve_skeleton.h"

namespace mspskel::cli {

enum class WrapMode { kAuto, kNever, kAlways };

struct RepairSettings {
  bool repair = true;
  MendOptions options;
  std::string components = "0.025";  // as given; resolve() reads it
  bool unite = true;                 // shells that cross each other
  std::string wrap = "auto";         // as given; resolve() reads it
  WrapMode wrap_mode = WrapMode::kAuto;
  WrapOptions wrapping;

  // Sets what --components and --wrap say. Throws UsageError.
  void resolve();
};

// The group "Repair".
void add_repair_options(CommandLine& line, RepairSettings& settings);

struct MeshInput {
  BuiltMesh built;
  bool mended = false;
  MendedSoup repair;                   // of a mended one, without its soup
  std::optional<UnitedShells> united;  // if shells crossed; without its soup
  std::optional<WrappedSoup> wrapped;  // without its soup
  // The mesh's vertex that stands for each point of the file; empty: its own.
  std::vector<Index> vertex_of_point;

  // Whether shells were united; whether vertices and faces have other numbers than in the file for that or
  // for mending.
  bool united_shells() const { return united && united->shells > 0; }
  bool renumbered() const { return mended || !vertex_of_point.empty(); }

  // The skeleton with the map of the vertices that the file has.
  CurveSkeleton of_file(const CurveSkeleton& skeleton) const;
  // The other way round; vertices that mending added have no node.
  CurveSkeleton of_surface(const CurveSkeleton& skeleton) const;
};

// A closed, manifold mesh comes through as build_mesh leaves it, unless the settings ask for more; any other
// is mended, which the first warning sums up, or wrapped. Then shells that cross each other are united.
// Throws MeshError.
MeshInput prepare_mesh(const PolygonSoup& soup, const RepairSettings& settings,
                       const Execution& execution = {});

// The soup that the input was prepared from, wrapped as settings.wrapping says, whatever its surface is.
// Where the input has open ends its mended surface is wrapped, so that the wrap does not go into them, and
// they are ends no more. Throws MeshError.
MeshInput wrap_mesh(const MeshInput& input, const PolygonSoup& soup, const RepairSettings& settings,
                    const Execution& execution = {});

// What was done, for the report.
Json repair_facts(const MeshInput& input);
Json counts_json(const MendCounts& counts);

}  // namespace mspskel::cli
