#include "mspskel/graph/space_nodes.h"

#include "mspskel/graph/detail/space_nodes_impl.h"
