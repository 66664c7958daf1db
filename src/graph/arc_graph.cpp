#include "mspskel/graph/arc_graph.h"

#include "mspskel/graph/detail/arc_graph_impl.h"
