#include "mspskel/graph/center_arcs.h"

#include "mspskel/graph/detail/center_arcs_impl.h"
