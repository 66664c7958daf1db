// mspskel info FILE: what a mesh or a skeleton is, in numbers.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>

#include "commands.h"
#include "mesh_input.h"
#include "mspskel/base/counted.h"
#include "mspskel/base/error.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/io/read_skeleton.h"
#include "mspskel/mesh/mesh_report.h"
#include "report.h"
#include "terminal.h"

namespace mspskel::cli {
namespace {

// .obj and .ply are skeletons where they have no faces; what other formats hold, the name tells.
bool is_skeleton(const std::string& path) {
  SkeletonFormat format;
  try {
    format = skeleton_format_of(path);
  } catch (const UsageError&) {  // of a mesh
    return false;
  }
  if (format == SkeletonFormat::kObj || format == SkeletonFormat::kPly)
    return read_polygon_soup(path).polygon_count() == 0;
  return format != SkeletonFormat::kVtp && format != SkeletonFormat::kGraphml;  // which are only written
}

Json mesh_facts(const MeshInput& input, const MeshReport& report) {
  Json components = Json::array();
  for (const ComponentReport& c : report.components)
    components.push_back({{"vertices", c.vertices},
                          {"faces", c.faces},
                          {"genus", c.genus},
                          {"area", c.area},
                          {"volume", c.signed_volume},
                          {"cavity", c.depth % 2 == 1}});
  return {
      {"kind", "mesh"},
      {"vertices", report.vertices},
      {"faces", report.faces},
      {"components", std::move(components)},
      {"genus", report.genus},
      {"cavities", report.cavities},
      {"diagonal", report.diagonal},
      {"area", report.area},
      {"volume", report.signed_volume},
      {"edges",
       {{"shortest", report.shortest_edge}, {"mean", report.mean_edge}, {"longest", report.longest_edge}}},
      {"degenerate_faces", report.degenerate_faces},
      {"self_intersections", report.self_intersections},
      {"repair", repair_facts(input)},
      {"warnings", input.built.warnings}};
}

void print_mesh(const MeshInput& input, const MeshReport& r) {
  std::printf("mesh         %s, %s, %s, genus %d, %s\n", counted(r.vertices, "vertex", "vertices").c_str(),
              counted(r.faces, "face").c_str(),
              counted(static_cast<long long>(r.components.size()), "component").c_str(), r.genus,
              counted(r.cavities, "cavity", "cavities").c_str());
  std::printf("size         diagonal %g, area %g, volume %g\n", r.diagonal, r.area, r.signed_volume);
  std::printf("edges        %g to %g, mean %g\n", r.shortest_edge, r.longest_edge, r.mean_edge);
  std::printf("flaws        %s without area, %s of faces that cross\n",
              counted(r.degenerate_faces, "face").c_str(), counted(r.self_intersections, "pair").c_str());
  const std::vector<Opening>& openings = input.repair.openings;
  for (std::size_t k = 0; k < openings.size(); ++k)
    std::printf("open end %-3zu centre %g %g %g, radius %g\n", k, openings[k].centre[0],
                openings[k].centre[1], openings[k].centre[2], openings[k].radius);
}

struct BranchFacts {
  double length = 0, least = std::numeric_limits<double>::infinity(), mean = 0;  // radii
};

// The mean radius is weighted by length.
BranchFacts measure(const CurveSkeleton& skeleton, const Branch& branch) {
  BranchFacts facts;
  double weighted = 0;
  for (std::size_t i = 0; i < branch.nodes.size(); ++i) {
    const SkeletonNode& node = skeleton.nodes[branch.nodes[i]];
    facts.least = std::min(facts.least, node.radius);
    if (i == 0) continue;
    const SkeletonNode& last = skeleton.nodes[branch.nodes[i - 1]];
    const double length = (node.position - last.position).norm();
    facts.length += length;
    weighted += length * (node.radius + last.radius) / 2;
  }
  facts.mean = facts.length > 0 ? weighted / facts.length : facts.least;
  return facts;
}

Json skeleton_facts(const CurveSkeleton& skeleton, const GraphCounts& counts) {
  Json list = Json::array();
  for (const Branch& branch : branches(skeleton)) {
    const BranchFacts facts = measure(skeleton, branch);
    list.push_back({{"from", branch.nodes.front()},
                    {"to", branch.nodes.back()},
                    {"nodes", branch.nodes.size()},
                    {"length", facts.length},
                    {"mean_radius", facts.mean},
                    {"least_radius", facts.least}});
  }
  return {{"kind", "skeleton"},         {"nodes", counts.nodes},
          {"edges", counts.edges},      {"components", counts.components},
          {"cycles", counts.cycles},    {"leaves", counts.leaves},
          {"joints", counts.joints},    {"length", counts.length},
          {"branches", std::move(list)}};
}

void print_skeleton(const CurveSkeleton& skeleton, const GraphCounts& c) {
  std::printf("skeleton     %s, %s, %s, %s, %s, %s\n", counted(c.nodes, "node").c_str(),
              counted(c.edges, "edge").c_str(), counted(c.components, "piece").c_str(),
              counted(c.cycles, "cycle").c_str(), counted(c.leaves, "leaf", "leaves").c_str(),
              counted(c.joints, "joint").c_str());
  std::printf("length       %g\n\n  branch     from       to      length  mean radius least radius\n",
              c.length);
  const std::vector<Branch> all = branches(skeleton);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const BranchFacts facts = measure(skeleton, all[i]);
    std::printf("%8zu %8d %8d %11.5g %12.5g %12.5g\n", i, all[i].nodes.front(), all[i].nodes.back(),
                facts.length, facts.mean, facts.least);
  }
}

class InfoCommand : public Command {
 public:
  InfoCommand()
      : Command("info FILE [options]",
                "What a mesh or a skeleton is: counts, components, genus, openings, size; branches with "
                "length and radius.") {
    CommandLine& table = line();
    table
        .argument("FILE", path_,
                  "mesh (.off .obj .ply .stl .vtk .vtp .gltf .glb .3mf) or skeleton (.skel .obj .ply .json "
                  ".swc .cgal .polylines.txt)")
        ->required();
    table.flag("--json", as_json_, "the same for programs");
    table.flag("-q,--quiet", quiet_, "no warnings");
    add_repair_options(table, repair_);
  }

  int run() override {
    repair_.resolve();
    if (path_ != "-" && is_skeleton(path_)) {
      const CurveSkeleton skeleton = read_skeleton(path_);
      const GraphCounts counts = count_graph(skeleton);
      if (as_json_)
        std::cout << report_text(skeleton_facts(skeleton, counts));
      else
        print_skeleton(skeleton, counts);
      return 0;
    }
    const MeshInput input = prepare_mesh(read_polygon_soup(path_), repair_);
    const MeshReport report = report_mesh(make_snapshot(input.built.mesh));
    if (as_json_) {
      std::cout << report_text(mesh_facts(input, report));
      return 0;
    }
    Terminal terminal(quiet_ ? Verbosity::kQuiet : Verbosity::kNormal);
    for (const std::string& warning : input.built.warnings) terminal.warning(warning);
    print_mesh(input, report);
    return 0;
  }

 private:
  std::string path_;
  bool as_json_ = false, quiet_ = false;
  RepairSettings repair_;
};

}  // namespace

std::unique_ptr<Command> make_info_command(const std::vector<std::string>&) {
  return std::make_unique<InfoCommand>();
}

}  // namespace mspskel::cli
