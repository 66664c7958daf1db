#include "mspskel/graph/limit_nodes.h"

#include "mspskel/graph/detail/limit_nodes_impl.h"
