#include "bindings.h"

NB_MODULE(_core, module) {
  using namespace mspskel::python;
  module.attr("version") = MSPSKEL_VERSION;
  bind_errors();
  bind_options(module);
  bind_skeleton_graph(module);
  bind_extraction(module);
  bind_shapes(module);
  bind_stages(module);
}
