// Everything.
#pragma once

#include "mspskel/extract_skeleton.h"
#include "mspskel/mesh/default_mesh.h"
#include "mspskel/mesh/mesh_report.h"
#include "mspskel/skeleton/check_skeleton.h"
