#include "mspskel/graph/branch_filter.h"

#include "mspskel/graph/detail/branch_filter_impl.h"
