#include "mspskel/collapse/skeleton_complex.h"

#include "mspskel/collapse/detail/skeleton_complex_impl.h"
