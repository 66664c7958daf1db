#include "mspskel/limbs/limb_tips.h"

#include "mspskel/limbs/detail/limb_tips_impl.h"
