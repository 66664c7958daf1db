// Everything.
#pragma once

#include "mspskel/extract_skeleton.h"
#include "mspskel/graph/check_skeleton.h"
#include "mspskel/mesh/mesh_report.h"
