#include "mspskel/limbs/coverage.h"

#include "mspskel/limbs/detail/coverage_impl.h"
