#include "mspskel/graph/zip_arcs.h"

#include "mspskel/graph/detail/zip_arcs_impl.h"
