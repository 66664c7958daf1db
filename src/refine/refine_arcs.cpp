#include "mspskel/refine/refine_arcs.h"

#include "mspskel/refine/detail/refine_arcs_impl.h"
