#include "mspskel/arcs/center_arcs.h"

#include "mspskel/arcs/detail/center_arcs_impl.h"
