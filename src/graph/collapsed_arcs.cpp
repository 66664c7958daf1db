#include "mspskel/graph/collapsed_arcs.h"

#include "mspskel/graph/detail/collapsed_arcs_impl.h"
