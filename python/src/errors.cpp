#include <exception>

#include "bindings.h"
#include "mspskel/base/error.h"

namespace mspskel::python {
namespace {

const char* class_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
      return "UsageError";
    case ErrorKind::kRead:
      return "ReadError";
    case ErrorKind::kMesh:
      return "MeshError";
    case ErrorKind::kWrite:
      return "WriteError";
    case ErrorKind::kNoSkeleton:
      return "NoSkeletonError";
    case ErrorKind::kCancelled:
      break;
  }
  return "Cancelled";
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    const nanobind::object type = nanobind::module_::import_("mspskel.errors").attr(class_of(error.kind()));
    PyErr_SetString(type.ptr(), error.what());
  }
}

}  // namespace

void bind_errors() { nanobind::register_exception_translator(translate); }

}  // namespace mspskel::python
