// A mesh of the user's, and what a run made of it.
#pragma once

#include <mutex>
#include <string>

#include "checked_extraction.h"
#include "mspskel/io/write_glb.h"
#include "mspskel/mesh/polygon_soup.h"

namespace mspskel::python {

struct Extraction {
  cli::CheckedExtraction made;
  CurveSkeleton skeleton;  // with the map of the vertices that the user gave
  std::string name;        // of the mesh
  cli::Json options;       // their values, by name
  cli::ProgramSeconds seconds;

  // The run's own certificate tells whether the skeleton fails. Whether it is proved takes a look at the
  // whole surface, which is taken when somebody first asks. Safe to call from several threads.
  const TopologyCertificate& full_certificate();
  // What JSON files and pages hold: what is the same on every run.
  cli::Json facts();
  // Surface and skeleton as the command line writes them to .glb.
  GlbScene scene() const;

 private:
  std::once_flag certified_;
};

}  // namespace mspskel::python
