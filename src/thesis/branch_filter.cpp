#include "mspskel/thesis/branch_filter.h"

#include "mspskel/thesis/detail/branch_filter_impl.h"
