// The parts of the module mspskel._core. Arrays that a method returns are views of memory that their object
// owns, and keep it alive; they are read-only.
#pragma once

#include <nanobind/nanobind.h>

namespace mspskel::python {

void bind_errors();
void bind_options(nanobind::module_& module);
void bind_skeleton_graph(nanobind::module_& module);
void bind_extraction(nanobind::module_& module);
void bind_shapes(nanobind::module_& module);
void bind_stages(nanobind::module_& module);

}  // namespace mspskel::python
