#include <OpenMesh/Core/System/config.h>
#include <omp.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "commands.h"

namespace mspskel::cli {

std::string version_text() {
  std::ostringstream out;
  out << "mspskel " MSPSKEL_VERSION "\n"
      << "OpenMesh " << OM_GET_VER << "." << OM_GET_MAJ << "." << OM_GET_MIN << ", Eigen "
      << EIGEN_WORLD_VERSION << "." << EIGEN_MAJOR_VERSION << "." << EIGEN_MINOR_VERSION << ", GLM "
      << GLM_VERSION_MAJOR << "." << GLM_VERSION_MINOR << "." << GLM_VERSION_PATCH << "."
      << GLM_VERSION_REVISION << ", CLI11 " << CLI11_VERSION << ", nlohmann-json "
      << NLOHMANN_JSON_VERSION_MAJOR << "." << NLOHMANN_JSON_VERSION_MINOR << "."
      << NLOHMANN_JSON_VERSION_PATCH << ", OpenMP " << _OPENMP << ", " << MSPSKEL_CGAL << "\n"
      << MSPSKEL_COMPILER << ", " MSPSKEL_BUILD_TYPE "\n";
  return out.str();
}

}  // namespace mspskel::cli
