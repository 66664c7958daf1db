#include "mspskel/refine/find_digits.h"

#include "mspskel/refine/detail/find_digits_impl.h"
