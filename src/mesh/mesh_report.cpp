#include "mspskel/mesh/mesh_report.h"

#include "mspskel/mesh/detail/mesh_report_impl.h"
