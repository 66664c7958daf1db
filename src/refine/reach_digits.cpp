#include "mspskel/refine/reach_digits.h"

#include "mspskel/refine/detail/reach_digits_impl.h"
