#include "mspskel/arcs/zip_arcs.h"

#include "mspskel/arcs/detail/zip_arcs_impl.h"
