#include "mspskel/skeleton/check_skeleton.h"

#include "mspskel/skeleton/detail/check_skeleton_impl.h"
