#include "mspskel/graph/refine_arcs.h"

#include "mspskel/graph/detail/refine_arcs_impl.h"
