#include "mspskel/graph/complete_limbs.h"

#include "mspskel/graph/detail/complete_limbs_impl.h"
