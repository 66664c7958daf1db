#include "mspskel/arcs/arc_graph.h"

#include "mspskel/arcs/detail/arc_graph_impl.h"
