#include "mspskel/graph/limb_tips.h"

#include "mspskel/graph/detail/limb_tips_impl.h"
