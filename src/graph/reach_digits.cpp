#include "mspskel/graph/reach_digits.h"

#include "mspskel/graph/detail/reach_digits_impl.h"
