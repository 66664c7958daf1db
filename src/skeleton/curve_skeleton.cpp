#include "mspskel/skeleton/curve_skeleton.h"

#include "mspskel/skeleton/detail/curve_skeleton_impl.h"
