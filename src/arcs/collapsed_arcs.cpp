#include "mspskel/arcs/collapsed_arcs.h"

#include "mspskel/arcs/detail/collapsed_arcs_impl.h"
