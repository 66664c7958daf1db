// mspskel-experiments: chapter 5 of the thesis on any models, as one page.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>

#include "command_line.h"
#include "mspskel/base/error.h"
#include "mspskel/io/atomic_file.h"
#include "mspskel/io/read_mesh.h"
#include "mspskel/mesh/build_mesh.h"
#include "mspskel/samples/samples.h"
#include "page.h"
#include "pictures.h"
#include "terminal.h"

namespace mspskel::experiments {
namespace {

constexpr const char* kDescription =
    "Reruns chapter 5 of the thesis on the models and writes index.html, index.md and the pictures into OUT.";

struct Settings {
  std::string folder;
  std::vector<std::string> models;
  Index resolution = 0;
  Execution execution;
};

bool parse(const std::vector<std::string>& arguments, Settings& settings) {
  settings.execution.threads = 1;
  cli::CommandLine line("mspskel-experiments OUT [MODEL...] [options]", kDescription);
  line.argument("OUT", settings.folder, "folder, made if absent")->required();
  line.arguments("MODELS", settings.models,
                 "mesh files (.off .obj .ply .stl) or names of samples; without any, the samples quadruped, "
                 "octoped and heptoroid");
  line.number("--resolution", settings.resolution, {0, 1e8}, "of samples, vertices; 0: the sample's own");
  line.number("-t,--threads", settings.execution.threads, {0, 4096},
              "0: as many as the machine has; with one, seconds compare with the thesis's");
  if (!line.parse(arguments)) return false;
  if (settings.models.empty()) settings.models = {"quadruped", "octoped", "heptoroid"};
  return true;
}

SurfaceSnapshot load(const std::string& model, Index resolution) {
  if (std::filesystem::path(model).has_extension()) return make_snapshot(read_mesh(model));
  SampleOptions options;
  options.resolution = resolution;
  return make_snapshot(build_mesh(make_sample(model, options)));
}

// Pictures are named by the models.
std::vector<std::string> names_of(const std::vector<std::string>& models) {
  std::vector<std::string> names;
  for (const std::string& model : models) {
    const std::string name = std::filesystem::path(model).stem().string();
    if (std::find(names.begin(), names.end(), name) != names.end())
      throw UsageError("two models have the name " + name);
    names.push_back(name);
  }
  return names;
}

void make_folder(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw WriteError(folder + ": " + failure.message());
}

int run(const std::vector<std::string>& arguments) {
  Settings settings;
  if (!parse(arguments, settings)) return 0;
  const std::vector<std::string> names = names_of(settings.models);
  make_folder(settings.folder);
  std::vector<Study> studies;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::cerr << names[i] << std::endl;
    studies.push_back(run_study(names[i], load(settings.models[i], settings.resolution), settings.execution));
    write_pictures(studies.back(), settings.folder, settings.execution);
    drop_bulk(studies.back());
  }
  write_time_chart(studies, settings.folder);
  const Document page = make_page(studies, settings.execution.threads);
  const std::filesystem::path folder = settings.folder;
  write_file_atomically((folder / "index.html").string(), page.html());
  write_file_atomically((folder / "index.md").string(), page.markdown());
  return 0;
}

int run_and_report(const std::vector<std::string>& arguments) {
  try {
    return run(arguments);
  } catch (const Error& error) {
    cli::Terminal().error(error.what());
    return static_cast<int>(error.kind());
  } catch (const std::exception& error) {
    cli::Terminal().error(error.what());
  }
  return static_cast<int>(ErrorKind::kNoSkeleton);
}

}  // namespace
}  // namespace mspskel::experiments

int main(int argc, char** argv) {
  return mspskel::experiments::run_and_report(std::vector<std::string>(argv + 1, argv + argc));
}
