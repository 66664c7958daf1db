#include "mspskel/graph/coverage.h"

#include "mspskel/graph/detail/coverage_impl.h"
