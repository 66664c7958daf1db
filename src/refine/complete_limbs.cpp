#include "mspskel/refine/complete_limbs.h"

#include "mspskel/refine/detail/complete_limbs_impl.h"
