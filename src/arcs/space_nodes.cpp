#include "mspskel/arcs/space_nodes.h"

#include "mspskel/arcs/detail/space_nodes_impl.h"
