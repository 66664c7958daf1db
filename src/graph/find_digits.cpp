#include "mspskel/graph/find_digits.h"

#include "mspskel/graph/detail/find_digits_impl.h"
