#include "mspskel/arcs/limit_nodes.h"

#include "mspskel/arcs/detail/limit_nodes_impl.h"
